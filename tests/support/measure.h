// Means with honest errors, and their comparison with truths.
//
// A standard error comes from 16 renders with independent seeds (scramblings), never from the variance of the
// samples of one. A comparison accepts 4 of these errors, which is a two-sided significance of 0.0012
// (Student's t with 15 degrees of freedom) for each; seeds are 1 to 16.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compile/compiled_scene.h"
#include "reference/reference.h"
#include "render/render.h"
#include "support/region_estimate.h"

namespace tyndall::support {

inline constexpr int seed_count = 16;
inline constexpr double sigmas = 4;

// The pictures of all seeds.
struct Measurement {
  int width = 0, height = 0;
  std::vector<render::Film> films;

  // Over the pixels of [x0, x1) × [y0, y1).
  Estimate region(int x0, int y0, int x1, int y1) const { return region_estimate(films, x0, y0, x1, y1); }
  Estimate whole() const { return region(0, 0, width, height); }
};

// Renders the scene once a seed. No sample may be bad.
inline Measurement measure(scene::Scene scene, const render::RenderOptions& options = {}) {
  Measurement measurement;
  measurement.width = scene.settings.resolution.width;
  measurement.height = scene.settings.resolution.height;
  for (int seed = 1; seed <= seed_count; ++seed) {
    scene.settings.seed = static_cast<std::uint64_t>(seed);
    const compile::CompiledScene world = compile::compile(scene);
    render::RenderResult result = render::render(world, options);
    EXPECT_EQ(result.statistics.bad_samples, 0u);
    measurement.films.push_back(std::move(result.film));
  }
  return measurement;
}

// The reference's mean, with the error of its independent samples. Its majorant must hold.
inline Estimate measure_reference(const scene::Scene& scene, double majorant, int samples,
                                  std::uint64_t seed = 1) {
  reference::ReferenceSettings settings;
  settings.majorant = majorant;
  settings.samples = samples;
  settings.bounces = scene.settings.bounces;
  settings.seed = seed;
  const reference::ReferenceResult result = reference::reference_render(scene, settings);
  EXPECT_EQ(result.majorant_violations, 0u);
  const auto whole = result.whole();
  return {whole.mean, whole.standard_error};
}

// |mean - truth| <= 4 SE + allowance in every channel. `allowance` is what the truth's own digits and a bias
// bound stated beforehand permit; `power` is the largest standard error, relative to the truth, with which
// the comparison still says something.
inline void expect_truth(const Estimate& estimate, const Vec3d& truth, double allowance, double power,
                         const std::string& what) {
  for (std::size_t c = 0; c < 3; ++c) {
    const double error = estimate.standard_error[c];
    EXPECT_LE(std::abs(estimate.mean[c] - truth[c]), sigmas * error + allowance)
        << what << ", channel " << c << ": " << estimate.mean[c] << " ± " << error << " for " << truth[c];
    EXPECT_LE(error, power * std::abs(truth[c])) << what << ", channel " << c << ": too noisy to tell";
  }
}
inline void expect_truth(const Estimate& estimate, double truth, double allowance, double power,
                         const std::string& what) {
  expect_truth(estimate, Vec3d(truth), allowance, power, what);
}

// Two estimates of one thing, to 4 standard errors of their difference and an allowance.
inline void expect_same(const Estimate& a, const Estimate& b, double allowance, double power,
                        const std::string& what) {
  for (std::size_t c = 0; c < 3; ++c) {
    const double error = std::hypot(a.standard_error[c], b.standard_error[c]);
    EXPECT_LE(std::abs(a.mean[c] - b.mean[c]), sigmas * error + allowance)
        << what << ", channel " << c << ": " << a.mean[c] << " against " << b.mean[c] << " ± " << error;
    EXPECT_LE(error, power * std::abs(b.mean[c])) << what << ", channel " << c << ": too noisy to tell";
  }
}

}  // namespace tyndall::support
