// The march itself: what one stored march holds, and what its offset averages to.
#include "render/march/ray_march.h"

#include <gtest/gtest.h>

#include "support/law_scenes.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

compile::Ray ray_of(const compile::CompiledScene& world, const KnownDensity& known) {
  return {known.from - world.origin, normalize(known.to - known.from), 1e9};
}

double optical_depth(const render::March& march) { return -std::log(march.transmittance[0][march.count]); }

// A jittered march has E[τ̂] = τ exactly: over 4096 seeds to 4 standard errors (and float's rounding), and no
// march is off by more than a step times the density's total variation.
TEST(March, OpticalDepthIsUnbiasedOverItsJitter) {
  for (const KnownDensity& known : known_densities())
    for (const double step : {0.3, 0.05}) {
      SceneBuilder builder = known_density(known);
      builder.step(step);
      const compile::CompiledScene world = compile::compile(builder.scene);
      render::ThreadContext thread;
      render::RayMarcher marcher;
      render::March march;
      double sum = 0, squares = 0, largest = 0;
      constexpr std::uint32_t seeds = 4096;
      for (std::uint32_t k = 0; k < seeds; ++k) {
        marcher.march(world, {ray_of(world, known), compile::RayKind::camera, k * 0x9e3779b9u, &march},
                      thread);
        const double error = optical_depth(march) - known.tau;
        sum += error;
        squares += error * error;
        largest = std::max(largest, std::abs(error));
      }
      const double standard_error = std::sqrt(squares / seeds / seeds);
      EXPECT_NEAR(sum / seeds, 0, 4 * standard_error + 1e-6 * known.tau) << known.name << ", step " << step;
      EXPECT_LE(largest, step * known.total_variation + 1e-6) << known.name << ", step " << step;
    }
}

// Edges increase, transmittance never rises, and it multiplies: T(a, c) = T(a, b) T(b, c) within one stored
// march.
TEST(March, TransmittanceFallsAndMultiplies) {
  for (const KnownDensity& known : known_densities()) {
    SceneBuilder builder = known_density(known);
    builder.step(0.05);
    const compile::CompiledScene world = compile::compile(builder.scene);
    render::ThreadContext thread;
    render::RayMarcher marcher;
    render::March march;
    marcher.march(world, {ray_of(world, known), compile::RayKind::camera, 3, &march}, thread);
    ASSERT_GT(march.count, 10u) << known.name;
    double product = 1;
    for (std::uint32_t i = 0; i < march.count; ++i) {
      if (i > 0) {
        EXPECT_LE(march.t0[i - 1] + march.dt[i - 1], march.t0[i] * (1 + 1e-15)) << known.name;
      }
      EXPECT_GT(march.dt[i], 0) << known.name;
      EXPECT_LE(march.transmittance[0][i + 1], march.transmittance[0][i]) << known.name;
      // Segment by segment against the exponential of its own constant extinction.
      product *= std::exp(-double{march.sigma_t[0][i]} * march.dt[i]);
      EXPECT_NEAR(march.transmittance[0][i + 1], product, 1e-12) << known.name;
      const double middle = march.t0[i] + 0.5 * march.dt[i];
      EXPECT_EQ(march.segment_at(middle), i) << known.name;
      const double expected =
          march.transmittance[0][i] * std::exp(-0.5 * double{march.sigma_t[0][i]} * march.dt[i]);
      EXPECT_NEAR(march.transmittance_at(i, middle).x, expected, 2e-7 * expected) << known.name;
    }
  }
}

}  // namespace
}  // namespace tyndall
