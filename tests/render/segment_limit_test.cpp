// Rays that want more segments than a ray may have: a finer step never gives fewer, a tolerance that is not
// kept is told with one that is.
#include "render/march/segment_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "base/numerics.h"
#include "render/march/ray_march.h"
#include "render/render.h"
#include "render/transmittance/shadow_rays.h"
#include "support/filled.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using support::scene_of;

TEST(SegmentAllotment, GivesWhatIsWantedOrTheLimitInProportion) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const int parts = 1 + static_cast<int>(300 * unit(random) * unit(random));
    const double scale = std::exp(30 * unit(random));
    std::vector<double> wanted;
    double sum = 0;
    for (int k = 0; k < parts; ++k) {
      wanted.push_back(wanted_segments(unit(random) * unit(random) * scale / parts, 1));
      sum += wanted.back();
    }
    SegmentAllotment allotment(sum, wanted.size());
    double given = 0;
    for (const double w : wanted) {
      const std::uint32_t n = allotment.next(w);
      ASSERT_GE(n, 1u);
      ASSERT_LE(n, w);
      const double share = sum > max_segments ? (w - 1) / (sum - parts) * (max_segments - parts) : w - 1;
      ASSERT_NEAR(n - 1.0, share, sum > max_segments ? 1.001 : 0);
      given += n;
    }
    ASSERT_EQ(given, std::min<double>(sum, max_segments)) << sum;
  }
}

TEST(SegmentAllotment, LeavesEachOfManyPartsOne) {
  SegmentAllotment allotment(1e6, 5000);
  for (int k = 0; k < 5000; ++k) ASSERT_EQ(allotment.next(200), 1u);
}

const std::string view = "camera orthographic { from: (0, 0, 10)  to: (0, 0, 0)  height: 1e-3 }\n";

// Waves between two distances along the view.
std::string waves(double lowest, double highest) {
  return support::filled(R"(
volume {
  in: box { min: (-1, -1, $LOWEST)  max: (1, 1, $HIGHEST) }
  medium: { density = 1 + 0.5 * sin(40 * p.z)  scattering = 0  absorption = 1 }
}
)",
                         {{"LOWEST", lowest}, {"HIGHEST", highest}});
}
const std::string one = waves(0, 1);
// Three that overlap, and one apart.
const std::string several = waves(0, 1) + waves(0.3, 0.7) + waves(0.5, 1.5) + waves(3, 3.1);

std::uint32_t segments_of_march(const scene::Scene& scene) {
  const compile::CompiledScene world = compile::compile(scene);
  ThreadContext thread;
  RayMarcher marcher;
  thread.skips_empty = false;
  March m;
  marcher.march(
      world, {{Vec3d{0, 0, 10} - world.origin, {0, 0, -1}, 100}, compile::RayKind::scattered, 1, &m}, thread);
  return m.count;
}
std::uint64_t segments_of_shadow_ray(const scene::Scene& scene) {
  const compile::CompiledScene world = compile::compile(scene);
  ThreadContext thread;
  thread.skips_empty = false;
  ShadowBatch batch;
  ShadowRay ray;
  ray.ray = {Vec3d{0, 0, 10} - world.origin, {0, 0, -1}, 100};
  ray.contribution = Rgb(1);
  batch.add(ray, {});
  batch.trace(world, Transmittance::march, {}, thread);
  return thread.statistics.segments;
}

TEST(Segments, AFinerStepNeverGivesFewer) {
  for (const std::string& volumes : {one, several}) {
    std::uint64_t before = 0, before_of_shadow = 0;
    for (double step = 0.3; step > 1e-9; step *= step > 2e-4 && step < 6e-4 ? 0.97 : 0.6) {
      scene::Scene scene = scene_of(view + volumes);
      scene.settings.step = scene::Step(step);
      const std::uint32_t count = segments_of_march(scene);
      EXPECT_GE(count, before) << step;
      EXPECT_LE(count, max_segments) << step;
      before = count;
      if (step * 2000 < 1) continue;  // part of a shadow ray may be ended by roulette
      const std::uint64_t of_shadow = segments_of_shadow_ray(scene);
      EXPECT_GE(of_shadow, before_of_shadow) << step;
      before_of_shadow = of_shadow;
    }
    EXPECT_EQ(before, max_segments);
  }
}

// 20 km of haze with a sheet of 10 m and depth 2, at a step of 0.1 m.
TEST(Segments, OfALongRayAreAsManyAsMayBeAndTold) {
  const scene::Scene scene = scene_of(
      "render { resolution: (4, 4)  samples: 16  step: 0.1 }\n"
      "camera orthographic { from: (0, 0, 15km)  to: (0, 0, 0)  height: 100m }\n"
      "light environment { radiance: 1 }\n"
      "volume { in: box { min: (-1km, -1km, -10km)  max: (1km, 1km, 10km) }  medium: {\n"
      "  density = 1e-5 * (1 + 0.5 * sin(p.z / 50)) + (if abs(p.z - 3m) < 5m then 0.2 else 0)\n"
      "  scattering = 0  absorption = 1 } }\n");
  const RenderResult result = render(compile::compile(scene), {});
  double mean = 0;
  for (int i = 0; i < 16; ++i) mean += static_cast<double>(result.film.mean(i % 4, i / 4).x) / 16;
  // Segments of 4.9 m take the sheet in two or three: the mean of e^-depth is off by a third at most.
  EXPECT_NEAR(mean, std::exp(-2.2), 0.05);
  const Shortfall& steps = result.statistics.widened_steps;
  EXPECT_EQ(steps.rays, 256u);
  EXPECT_DOUBLE_EQ(steps.asked, 0.1);
  EXPECT_NEAR(steps.reached, 20e3 / max_segments, 0.01);
}

// A sheet of 2 cm in cells of bounds of 12 cm, in which the tolerance takes more than a ray may have.
TEST(Segments, OfAThinSheetStandInItAndKeepTheToleranceThatIsTold) {
  scene::Scene scene = scene_of(
      "render { resolution: (8, 8)  samples: 8  step: auto(0.001%) }\n"
      "camera orthographic { from: (0.137, 0.211, 10)  to: (0.137, 0.211, 0)  height: 1e-6 }\n"
      "volume { in: box { min: (-1, -1, 0)  max: (1, 1, 1) }  medium: {\n"
      "  density = 59.84134206 * exp(-(p.z - 0.3217)^2 / (2 * 0.02 * 0.02))  albedo = 0 } }\n"
      "light environment { radiance: 1 }\n");
  const double exact = std::exp(-3.0);
  const RenderResult result = render(compile::compile(scene), {});
  double mean = 0;
  for (int i = 0; i < 64; ++i) mean += static_cast<double>(result.film.mean(i % 8, i / 8).x) / 64;
  EXPECT_NEAR(mean, exact, 0.01 * exact);
  const Shortfall& missed = result.statistics.missed_tolerances;
  EXPECT_EQ(missed.rays, 64u * 8);
  EXPECT_DOUBLE_EQ(missed.asked, 0.00001);
  EXPECT_GT(missed.reached, missed.asked);
  EXPECT_LT(missed.reached, 0.001);
  EXPECT_EQ(result.statistics.widened_steps.rays, 0u);
  // What is told is kept, and then there is nothing to tell.
  scene.settings.step = scene::Step::proven_within(missed.reached * 1.01);
  EXPECT_EQ(render(compile::compile(scene), {}).statistics.missed_tolerances.rays, 0u);
}

}  // namespace UNNAMED
}  // namespace tyndall::render
