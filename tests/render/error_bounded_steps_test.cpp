// The tolerance of automatic steps is kept: by the worst densities that the bounds allow, and by known ones.
#include "render/march/error_bounded_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compile/compiled_scene.h"
#include "render/march/ray_march.h"
#include "support/law_scenes.h"

namespace tyndall::render {
namespace UNNAMED {

std::vector<CertifiedCell> random_cells(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<CertifiedCell> cells;
  double t = 0;
  const double density = std::exp(6 * unit(random) - 3);
  const int count = 1 + static_cast<int>(60 * unit(random));
  for (int i = 0; i < count; ++i) {
    if (unit(random) < 0.1) t += unit(random);  // a gap
    const double length = 0.02 + 0.2 * unit(random);
    const float low = static_cast<float>(density * unit(random) * (unit(random) < 0.5 ? 0 : 1));
    const float high = low + static_cast<float>(density * unit(random) * (unit(random) < 0.3 ? 0 : 1));
    cells.push_back({t, t + length, low, high, high - low});
    t += length;
  }
  return cells;
}

// Whatever lies within the bounds: each segment takes its lowest or its highest value, as often one as the
// other. Nothing with that range varies more.
TEST(CertifiedSteps, KeepTheToleranceAtTheirWorst) {
  CertifiedScratch scratch;
  double closest = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const std::vector<CertifiedCell> cells = random_cells(seed);
    for (const double tolerance : {0.001, 0.01, 0.1}) {
      std::vector<CertifiedInterval> marched;
      certified_intervals(cells, tolerance, 1, 0.5, scratch, marched);
      double mean = 1, exact = 1, t = cells[0].t0;
      std::size_t cell = 0;
      for (const CertifiedInterval& s : marched) {
        ASSERT_LE(t, s.t0);
        const double dt = (s.t1 - s.t0) / s.count;
        ASSERT_TRUE(dt <= 0.5 + 1e-12);
        for (std::uint32_t k = 0; k < s.count; ++k) {
          const double a = s.t0 + k * dt, b = a + dt;
          while (cells[cell].t1 <= a) ++cell;
          float low = cells[cell].minorant, high = cells[cell].majorant;
          for (std::size_t c = cell; c < cells.size() && cells[c].t0 < b - 1e-9; ++c) {
            low = std::min(low, cells[c].minorant);
            high = std::max(high, cells[c].majorant);
          }
          exact *= std::exp(-dt * (double{low} + double{high}) / 2);
          const double at_low = std::exp(-dt * low), at_high = std::exp(-dt * high);
          mean *= (at_low + at_high) / 2;
          ASSERT_GE(mean, exact * (1 - 1e-9));
          ASSERT_LE(mean - exact, tolerance * (1 + 1e-9)) << "seed " << seed << " at " << b;
          closest = std::max(closest, (mean - exact) / tolerance);
        }
        t = s.t1;
      }
      // Everything is covered.
      double covered = 0, all = 0;
      for (const CertifiedInterval& s : marched) covered += s.t1 - s.t0;
      for (const CertifiedCell& c : cells) all += c.t1 - c.t0;
      ASSERT_NEAR(covered, all, 1e-9);
    }
  }
  EXPECT_GT(closest, 0.3);  // and the tolerance is used
}

// Marches of densities whose depth is known, with many jitters: the mean transmittance is right to the
// tolerance, and never too low.
TEST(CertifiedSteps, KeepTheToleranceOnKnownDensities) {
  for (const support::KnownDensity& known : support::known_densities()) {
    std::uint32_t coarser = 1;
    for (const double tolerance : {0.02, 0.002}) {
      support::SceneBuilder builder = support::known_density(known);
      builder.image(360, 360, 1);
      builder.scene.settings.step = scene::Step::proven_within(tolerance);
      const compile::CompiledScene world = compile::compile(builder.scene);
      ThreadContext thread;
      RayMarcher marcher;
      March m;
      const Vec3d from = known.from - world.origin, along = normalize(known.to - known.from);
      double sum = 0, squares = 0;
      constexpr int marches = 2000;
      for (std::uint32_t seed = 0; seed < marches; ++seed) {
        marcher.march(world, {{from, along, 200}, compile::RayKind::scattered, seed * 2654435761u, &m},
                      thread);
        const double t = static_cast<double>(m.end_transmittance().x);
        sum += t;
        squares += t * t;
      }
      const double mean = sum / marches, exact = std::exp(-known.tau);
      const double error = std::sqrt(std::max(0.0, squares / marches - mean * mean) / marches);
      EXPECT_GE(mean - exact, -4 * error - 1e-6) << known.name;
      EXPECT_LE(mean - exact, tolerance + 4 * error) << known.name;
      EXPECT_LE(m.count, 1000u) << known.name << " at " << tolerance;
      EXPECT_GE(m.count, coarser) << known.name;  // a finer tolerance takes no fewer
      coarser = m.count;
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
