// Transmittance through known densities along one ray, by each estimator: means, errors and what they cost.
#pragma once

#include <cmath>
#include <vector>

#include "base/sampler.h"
#include "render/transmittance/shadow_rays.h"
#include "support/law_scenes.h"

namespace tyndall::support {

// Known densities, and three that are hard on a march: `spike` is all of its optical depth in a 1/64 m.
inline std::vector<KnownDensity> transmittance_densities() {
  std::vector<KnownDensity> list = known_densities();
  const scene::Box box{{0, -1, -1}, {1, 1, 1}};
  list.push_back({"waves",
                  [](const Point& p) { return (cos(p.x * static_cast<float>(14 * pi)) + 1.f) * 3.f; },
                  box,
                  {-1, 0, 0},
                  {0, 0, 0},
                  3,
                  84});
  list.push_back({"layers",
                  [](const Point& p) { return less(fract(p.x * 4.f), 0.25f) * 8.f; },
                  box,
                  {-1, 0, 0},
                  {0, 0, 0},
                  2,
                  64});
  list.push_back({"spike",
                  [](const Point& p) { return less(abs(p.x - 0.5f), 1 / 128.f) * 256.f; },
                  box,
                  {-1, 0, 0},
                  {0, 0, 0},
                  4,
                  512});
  return list;
}

struct TransmittanceMeasure {
  double mean = 0, standard_error = 0, rmse = 0;  // of one estimate; rmse against e^-tau
  double evaluations = 0;                         // an estimate
};

// `count` independent estimates; the ray starts 2 m before what it looks at and runs for 100 m.
inline TransmittanceMeasure measure_transmittance(const KnownDensity& known, render::Transmittance method,
                                                  double step, int count, std::uint32_t seed = 1) {
  SceneBuilder builder = known_density(known);
  builder.step(step);
  const compile::CompiledScene world = compile::compile(builder.scene);
  render::ThreadContext thread;
  render::ShadowBatch shadows;
  const compile::Ray ray{known.from - world.origin, normalize(known.to - known.from), 100};
  double sum = 0, squares = 0, errors = 0;
  constexpr int together = 64;
  for (int done = 0; done < count; done += together) {
    for (int k = 0; k < together; ++k)
      shadows.add({ray, compile::no_index, Rgb(1),
                   static_cast<std::uint32_t>(hash_bits(seed, static_cast<std::uint64_t>(done + k)))},
                  {});
    for (const render::ShadowRay& r : shadows.trace(world, method, {}, thread)) {
      const double t = r.contribution.y;
      sum += t;
      squares += t * t;
      errors += sqr(t - std::exp(-known.tau));
    }
    shadows.clear();
  }
  const double n = count, mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1)), std::sqrt(errors / n),
          static_cast<double>(thread.statistics.segments) / n};
}

}  // namespace tyndall::support
