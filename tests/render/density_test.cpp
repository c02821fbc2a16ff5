// Sampling distances by density: the distribution is the stated one, channel by channel.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "render/distance/density_sampling.h"
#include "render/march/ray_march.h"
#include "support/scene_builder.h"

namespace tyndall::render {
namespace UNNAMED {

// Two overlapping volumes of different colours, one of them heterogeneous, and a gap between them and a
// third.
compile::CompiledScene world() {
  support::SceneBuilder b;
  b.step(0.3).orthographic({0, 0, 0}, {0, 0, -1}, 1);
  b.volume(scene::Box{{-1, -1, -3}, {1, 1, -1}},
           b.shader({Rgb(2, 0.5f, 0), Rgb(0.9f, 0.5f, 0)},
                    [](const support::Point& p) { return p.z * 0.5f + 2.0f; }));
  b.volume(scene::Box{{-1, -1, -4}, {1, 1, -2}},
           b.constant({.sigma_t = Rgb(0.1f, 1, 3), .albedo = Rgb(1, 0.5f, 0.8f)}));
  b.volume(scene::Box{{-1, -1, -7}, {1, 1, -6}}, b.constant({.sigma_t = Rgb(0.2f, 0.2f, 0.2f)}));
  return compile::compile(b.scene);
}

// The density integrates to one, and 200,000 samples fall into 60 cells as it says: χ² at a significance of
// 1e-6 (119 for 59 degrees of freedom) with a fixed seed.
TEST(DensityDistribution, SamplesFollowTheDensity) {
  const compile::CompiledScene w = world();
  for (const Rgb throughput : {Rgb(1, 1, 1), Rgb(1, 0, 0), Rgb(0.01f, 0.2f, 5)}) {
    ThreadContext thread;
    RayMarcher marcher;
    March m;
    marcher.march(w, {{{0, 0, 0}, {0, 0, -1}, 100}, compile::RayKind::camera, 77, &m}, thread);
    const DensityDistribution density(m, throughput);
    ASSERT_TRUE(density.available());
    constexpr int cells = 60, draws = 200000, fine = 2000;
    std::vector<double> expected(cells), found(cells);
    const double lo = 1, hi = 7, width = (hi - lo) / cells;
    double total = 0;
    for (int i = 0; i < cells; ++i) {
      for (int k = 0; k < fine; ++k) {
        const double t = lo + (i + (k + 0.5) / fine) * width;
        if (t > 4 && t < 6) continue;  // the gap
        expected[i] += density.pdf(m.place_at(t)) * width / fine;
      }
      total += expected[i];
    }
    EXPECT_NEAR(total, 1, 1e-4);
    for (std::uint32_t s = 0; s < draws; ++s) {
      const Sampler sampler(4, 0, 1, 2, s);
      const double t = density.sample(sampler.independent(1, 0)).t;
      ++found[static_cast<std::size_t>(std::min((t - lo) / width, cells - 1.0))];
    }
    double chi_squared = 0;
    for (int i = 0; i < cells; ++i) {
      if (expected[i] * draws < 5) continue;
      chi_squared +=
          (found[i] - expected[i] * draws) * (found[i] - expected[i] * draws) / (expected[i] * draws);
    }
    EXPECT_LT(chi_squared, 119) << "throughput " << throughput.x << " " << throughput.y << " "
                                << throughput.z;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
