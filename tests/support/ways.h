// The renderer's ways through a medium, for tests that loop over them.
#pragma once

#include <string>
#include <vector>

#include "render/render.h"

namespace tyndall::support {

struct Way {
  std::string name;
  render::Method method{};
  render::Distance distance{};
  render::Transmittance transmittance{};
  bool unbiased = false;  // whatever the step

  render::RenderOptions options() const {
    render::RenderOptions o;
    o.method = method;
    o.distance = distance;
    o.transmittance = transmittance;
    return o;
  }
};

inline std::vector<Way> ways() {
  using render::Distance, render::Method, render::Transmittance;
  return {
      {"Product", Method::decoupled, Distance::product, Transmittance::march, false},
      {"Mis", Method::decoupled, Distance::mis, Transmittance::march, false},
      {"Density", Method::decoupled, Distance::density, Transmittance::march, false},
      {"Equiangular", Method::decoupled, Distance::equiangular, Transmittance::march, false},
      {"Jackknife", Method::decoupled, Distance::product, Transmittance::jackknife, false},
      {"BruteForce", Method::brute_force, Distance::density, Transmittance::march, false},
      {"Stochastic", Method::stochastic, Distance::density, Transmittance::march, false},
      {"Tracking", Method::tracking, Distance::mis, Transmittance::series, true},
      {"TrackingDensity", Method::tracking, Distance::density, Transmittance::series, true},
      {"TrackingEquiangular", Method::tracking, Distance::equiangular, Transmittance::series, true},
  };
}

}  // namespace tyndall::support
