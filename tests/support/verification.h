// The table of published truths against what the renderer gives, by every way that applies: the rows of
// docs/verification.md and of the law tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compile/compiled_scene.h"
#include "support/law_scenes.h"
#include "support/region_estimate.h"
#include "support/transmittance_measure.h"
#include "support/ways.h"

namespace tyndall::support {

struct VerificationRow {
  std::string table, row, way;
  double truth = 0;
  double allowance = 0;  // digits of the truth, and a bias stated beforehand
  std::function<Estimate()> run;
};

struct Verified {
  Estimate estimate;
  bool passed = false;
};

// Four standard errors from 16 scramblings, and an error small enough to tell anything.
inline Verified verify(const VerificationRow& row) {
  Verified out{row.run(), false};
  const double error = out.estimate.standard_error.y;
  out.passed = std::abs(out.estimate.mean.y - row.truth) <= 4 * error + row.allowance &&
               error <= 0.03 * std::abs(row.truth) + 1e-12;
  return out;
}

// 16 seeds of a scene.
inline Estimate estimate_scene(scene::Scene scene, const render::RenderOptions& options) {
  std::vector<render::Film> films;
  for (int seed = 1; seed <= 16; ++seed) {
    scene.settings.seed = static_cast<std::uint64_t>(seed);
    films.push_back(render::render(compile::compile(scene), options).film);
  }
  return region_estimate(films, 0, 0, scene.settings.width, scene.settings.height);
}

inline std::vector<VerificationRow> verification_rows() {
  std::vector<VerificationRow> rows;
  const auto add = [&rows](std::string table, std::string row, const Way& way, double truth, double allowance,
                           const SceneBuilder& builder) {
    rows.push_back({std::move(table), std::move(row), way.name, truth, allowance,
                    [scene = builder.scene, way] { return estimate_scene(scene, way.options()); }});
  };
  const std::vector<Way> all = ways();
  const auto of = [&all](std::initializer_list<const char*> names) {
    std::vector<Way> some;
    for (const char* name : names)
      for (const Way& way : all)
        if (way.name == name) some.push_back(way);
    return some;
  };
  const std::vector<Way> flights = of({"Product", "Stochastic", "Tracking"});

  // Slabs, in closed form and with 3x² in depth. The bias of the march, as stated in
  // tests/laws/slab_test.cpp.
  const Density squared = [](const Point& p) { return p.y * p.y * 3.f; };
  for (const Slab& slab_row : slab_rows)
    for (const SlabView view : {SlabView::reflection, SlabView::transmission})
      for (const Way& way : flights) {
        const double truth = view == SlabView::reflection ? slab_row.R : slab_row.T;
        SceneBuilder even = slab(slab_row, view);
        even.image(16, 16, 16);
        add("Slab, van de Hulst", describe(slab_row, view), way, truth, 5e-6, even);
        const bool tested = slab_row.tau <= 2 && slab_row.albedo < 1;
        if (!tested) continue;
        SceneBuilder uneven = slab(slab_row, view, squared);
        uneven.image(16, 16, 16).step(1.0 / 128);
        const double bias = way.unbiased ? 0 : 0.5 * std::pow(slab_row.tau * 3 / 128, 2) * truth;
        add("Slab of 3x² in depth", describe(slab_row, view), way, truth, 5e-6 + bias, uneven);
      }

  // Nothing comes through 60 mean free paths at these albedos, so a thick slab is a half space.
  struct HalfSpace {
    float albedo;
    double mu, R;
  };
  for (const HalfSpace& h : {HalfSpace{0.5f, 1, .115226},
                             {0.5f, .5, .160144},
                             {0.9f, 1, .414947},
                             {0.9f, .5, .507939},
                             {0.99f, 1, .752721},
                             {0.99f, .5, .815140}})
    for (const Way& way : flights) {
      SceneBuilder builder = slab({0, h.albedo, 100, h.R, 0}, SlabView::reflection);
      const double tangent = std::sqrt(1 - h.mu * h.mu) / h.mu;
      builder.orthographic({2 * tangent, 3, 0}, {0, 1, 0}, 1e-3, {0, 0, 1}).image(16, 16, 16);
      add("Half space, Chandrasekhar", "c " + std::to_string(h.albedo) + " mu " + std::to_string(h.mu), way,
          h.R, 1e-6 + 2e-5 * h.R, builder);
    }

  for (const WhiteSphere& row : white_sphere_rows)
    for (const Way& way : flights) {
      SceneBuilder builder = white_sphere(row);
      builder.image(16, 16, 64);
      add("Sphere in a white environment",
          "tau_r " + std::to_string(row.tau) + " c " + std::to_string(row.albedo), way,
          white_sphere_square(row), 5e-6, builder);
    }

  for (const Airlight& row : airlight_rows)
    for (std::size_t i = 0; i < 3; ++i)
      for (const Way& way : all) {
        SceneBuilder builder = airlight(row, airlight_g[i]);
        builder.image(16, 16, 64);
        add("Airlight",
            "sigma_t " + std::to_string(row.sigma_t) + " D " + std::to_string(row.D) + " g " +
                std::to_string(airlight_g[i]),
            way, row.radiance[i], 1e-8 * row.radiance[i], builder);
      }

  for (const SlabView view : {SlabView::reflection, SlabView::transmission})
    for (const Way& way : of({"Product", "BruteForce", "Stochastic", "Tracking"})) {
      const Slab row{0, 0.9f, 1, 0.03096352, 0.02634742};
      SceneBuilder builder = slab(row, view);
      builder.scene.lights.clear();
      builder.image(16, 16, 16).step(0.05).bounces(0).distant_light({0, -1, 0}, Rgb(1));
      const double truth = view == SlabView::reflection ? row.R : row.T;
      // Light at every step is a sum at jittered places of each step: no bias.
      add("Distant light on a slab, once scattered",
          view == SlabView::reflection ? "reflected" : "transmitted", way, truth, 1e-8, builder);
    }

  // Transmittance, with the bias of a march by Hoeffding's bound.
  struct Named {
    const char* name;
    render::Transmittance method;
    bool unbiased;
  };
  using render::Transmittance;
  for (const KnownDensity& known : known_densities())
    for (const Named& named : {Named{"march", Transmittance::march, false},
                               {"jackknife", Transmittance::jackknife, false},
                               {"ratio", Transmittance::ratio, true},
                               {"residual-ratio", Transmittance::residual_ratio, true},
                               {"series", Transmittance::series, true}}) {
      const double truth = std::exp(-known.tau), step = 0.1;
      const double bias =
          named.unbiased ? 0 : std::expm1(std::pow(step * known.total_variation, 2) / 8) * truth;
      rows.push_back({"Transmittance of known densities, step 0.1", known.name, named.name, truth,
                      bias + 1e-6 * truth, [known, named, step] {
                        const auto m = measure_transmittance(known, named.method, step, 1 << 15);
                        return Estimate{Vec3d(m.mean), Vec3d(m.standard_error)};
                      }});
    }

  // Emission in proportion to density: 1 - 1/e for any density of τ = 1.
  for (const Way& way : flights) {
    MediumColors fire;
    fire.albedo = Rgb(0);
    fire.emission = Rgb(1);
    const auto seen = [&](const Density& density) {
      SceneBuilder builder;
      builder.image(32, 32, 32).step(0.01).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6);
      const scene::MediumId medium = density ? builder.shader(fire, density) : builder.constant(fire);
      return builder.volume(scene::Box{{0, -1, -1}, {1, 1, 1}}, medium);
    };
    const double truth = 1 - std::exp(-1);
    add("Emission, 1 - 1/e", "constant", way, truth, 1e-6, seen({}));
    add("Emission, 1 - 1/e", "3x²", way, truth, way.unbiased ? 1e-6 : 5e-5,
        seen([](const Point& p) { return p.x * p.x * 3.f; }));
  }

  // White furnace: what does not absorb cannot be seen.
  const Density lumps = [](const Point& p) {
    return max(cos(p.x * 5.f) * cos(p.y * 4.f) * cos(p.z * 6.f) + 0.3f, 0);
  };
  for (const Way& way : of({"Product", "Mis", "Density", "Equiangular", "BruteForce", "Stochastic",
                            "Tracking", "TrackingDensity", "TrackingEquiangular"}))
    for (const bool uneven : {false, true}) {
      SceneBuilder builder;
      builder.image(16, 16, 32).step(0.2).perspective({0, 0, 4}, {0, 0, 0}, 30).environment(1);
      MediumColors white{Rgb(uneven ? 8.f : 3.f), Rgb(1), {}, hg(0.5f)};
      builder.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}},
                     uneven ? builder.shader(white, lumps) : builder.constant(white));
      add("White furnace", uneven ? "lumps, step 0.2" : "constant", way, 1, 1e-6, builder);
    }
  return rows;
}

}  // namespace tyndall::support
