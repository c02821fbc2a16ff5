// Rays towards distant lights: they change the noise alone. Significance 0.0012 for each comparison of means,
// seeds 1 to 16 (support/measure.h).
#include "render/lights/distant_light_guiding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "optics/phase.h"
#include "render/march/ray_march.h"
#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using support::scene_of;

struct Case {
  std::string name, text;
};

// A slab that scatters forward, with a ball and a ground in it, under what is named. `settings` are
// parameters.
std::string fog(const std::string& lights, const std::string& medium, const std::string& settings) {
  return support::filled(R"(
render { resolution: (4, 4)  samples: 32  step: 0.1  $SETTINGS }
camera perspective { from: (0, 3, 5)  to: (0, 0.5, 0)  fov: 40deg }
$LIGHTS
medium fog() { $MEDIUM }
volume { in: box { min: (-4, 0, -4)  max: (4, 2, 4) }  medium: fog }
sphere { center: (0.3, 1, 0)  radius: 0.5 }
plane { point: (0, 0, 0)  normal: (0, 1, 0) }
)",
                         {{"SETTINGS", settings}, {"LIGHTS", lights}, {"MEDIUM", medium}});
}
const std::string sun = "light distant { direction: (-0.5, -1, -0.2)  irradiance: 3 }\n",
                  even = "density = 1.2  albedo = 0.95  phase = hg(0.85)";

std::vector<Case> cases() {
  return {
      {"a sun", fog(sun, even, "bounces: 8")},
      {"one bounce", fog(sun, even, "bounces: 1")},
      {"a wide disc, which rays meet, too",
       fog("light distant { direction: (-0.5, -1, -0.2)  irradiance: 3  angle: 25deg }\n", even,
           "bounces: 6")},
      {"two suns, a lamp and a sky", fog(R"(
light distant { direction: (-0.5, -1, -0.2)  irradiance: 3 }
light distant { direction: (1, -0.4, 0)  irradiance: (0, 1, 3)  angle: 9deg }
light sphere { center: (-1, 1.5, 1)  radius: 0.2  power: 30 }
light environment { radiance: 0.3 }
)",
                                         even, "bounces: 6")},
      {"colour and lobes", fog(sun,
                               "density = 1.2  absorption = (0.1, 0.02, 0)  scattering = (0.4, 1, 2)  phase "
                               "= mix(hg(0.9), hg(-0.3), 0.4)",
                               "bounces: 6")},
      {"a heterogeneous medium that emits",
       fog(sun, "density = 1 + sin(3 * p.x) * sin(2 * p.z)  albedo = 0.9  phase = hg(0.9)  emission = 0.05",
           "bounces: 6")},
      {"light samples", fog(sun, even, "bounces: 4  light_samples: 3")},
      {"orders of scattering",
       fog(sun, even, "bounces: 64  multiple_scattering: approximate(real: 2, orders: 4)")},
  };
}

TEST(GuidedRays, ChangeNoMean) {
  for (const Case& c : cases()) {
    const scene::Scene scene = scene_of(c.text);
    RenderOptions without;
    without.distant_guiding = false;
    support::expect_same(support::measure(scene).whole(), support::measure(scene, without).whole(), 0, 0.04,
                         c.name);
  }
}

// A ray through the fog, marched.
struct Marched {
  compile::CompiledScene world;
  March march;

  explicit Marched(const std::string& text) : world(compile::compile(scene_of(text))) {
    const compile::Ray ray{{0, -2, -5}, normalize(Vec3d(0.2, -0.5, -1)), 30, 0};
    ThreadContext thread;
    RayMarcher().march(world, {ray, compile::RayKind::camera, 1, &march}, thread);
  }
};
// The choice of a light and the phase function of the ray's first segment, and directions by both.
struct Scattered : Marched {
  using Marched::Marched;
  LightSelection lights{world, march.ray, 0, 10};
  PhaseMixture phase{world, march, 0};
  DistantLightGuide directions{world, lights, phase, 0};
};

// The density integrates to 1, and 100,000 directions fall into 20 by 20 cells of equal solid angle as it
// says: χ² below 4 sigmas over its mean, with a fixed seed.
TEST(GuidedRays, FollowTheirDensity) {
  const Scattered s(fog(sun + "light distant { direction: (1, -0.4, 0)  irradiance: 1 }\n",
                        "density = 1  albedo = 0.9  phase = mix(hg(0.7), hg(-0.4), 0.3)", "bounces: 2"));
  ASSERT_GT(s.directions.chance(), 0);
  constexpr int cells = 20, draws = 100000, fine = 20;
  std::vector<double> expected(cells * cells), found(cells * cells);
  double total = 0;
  for (int i = 0; i < cells * fine; ++i)
    for (int k = 0; k < cells * fine; ++k) {
      const double z = 2 * (i + 0.5) / (cells * fine) - 1, phi = 2 * pi * (k + 0.5) / (cells * fine);
      const double r = safe_sqrt(1 - z * z);
      const double mass = s.directions.pdf(Vec3f(Vec3d(r * std::cos(phi), r * std::sin(phi), z))) * 4 * pi /
                          (cells * fine * cells * fine);
      expected[static_cast<std::size_t>(i / fine * cells + k / fine)] += mass;
      total += mass;
    }
  EXPECT_NEAR(total, 1, 1e-3);
  for (std::uint32_t n = 0; n < draws; ++n) {
    const Sampler sampler(3, 0, 0, 0, n);
    const auto u = [&](std::uint64_t k) { return sampler.independent(k, 0); };
    const Vec3f w = s.directions.sample(u(0), u(1), u(2), u(3), u(4));
    const double phi = std::atan2(w.y, w.x) + (w.y < 0 ? 2 * pi : 0);
    const int i = std::min(static_cast<int>((w.z + 1.0) / 2 * cells), cells - 1),
              k = std::min(static_cast<int>(phi / (2 * pi) * cells), cells - 1);
    ++found[static_cast<std::size_t>(i * cells + k)];
  }
  double chi_squared = 0;
  int counted = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] * draws < 5) continue;
    ++counted;
    chi_squared += sqr(found[i] - expected[i] * draws) / (expected[i] * draws);
  }
  EXPECT_GT(counted, 200);
  EXPECT_LT(chi_squared, counted + 4 * std::sqrt(2.0 * counted));
}

// Only what the scene requires: none where light is scattered evenly or no light is distant.
TEST(GuidedRays, AreSentWhereTheyPay) {
  EXPECT_EQ(Scattered(fog(sun, "density = 1  albedo = 0.9", "bounces: 2")).directions.chance(), 0);
  EXPECT_EQ(
      Scattered(fog(sun, "density = 1  albedo = 0.9  phase = rayleigh", "bounces: 2")).directions.chance(),
      0);
  EXPECT_EQ(Scattered(fog("light environment { radiance: 1 }\n", even, "bounces: 2")).directions.chance(), 0);
  EXPECT_EQ(Scattered(fog("light point { position: (0, 5, 0)  power: 10 }\n", even, "bounces: 2"))
                .directions.chance(),
            0);
  EXPECT_GT(Scattered(fog(sun, even, "bounces: 2")).directions.chance(), 0.1f);
}

}  // namespace UNNAMED
}  // namespace tyndall::render
