// Rays towards distant lights: they change the noise alone. Significance 0.0012 for each comparison of means,
// seeds 1 to 16 (support/measure.h).
#include "render/sunward.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "optics/phase.h"
#include "render/worker.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace {

using support::scene_of;

struct Case {
  std::string name, text;
};

// A slab that scatters forward, with a ball and a ground in it, under what is named.
std::string fog(const std::string& lights, const std::string& medium, const std::string& settings) {
  return "render { resolution: (4, 4)  samples: 32  step: 0.1  bounces: " + settings +
         " }\ncamera perspective { from: (0, 3, 5)  to: (0, 0.5, 0)  fov: 40deg }\n"
         "volume { in: box { min: (-4, 0, -4)  max: (4, 2, 4) }  medium: { " +
         medium +
         " } }\nsphere { center: (0.3, 1, 0)  radius: 0.5 }\nplane { point: (0, 0, 0)  normal: (0, 1, 0) "
         "}\n" +
         lights;
}
const std::string sun = "light distant { direction: (-0.5, -1, -0.2)  irradiance: 3 }\n",
                  even = "density = 1.2  albedo = 0.95  phase = hg(0.85)";

std::vector<Case> cases() {
  return {
      {"a sun", fog(sun, even, "8")},
      {"one bounce", fog(sun, even, "1")},
      {"a wide disc, which rays meet, too",
       fog("light distant { direction: (-0.5, -1, -0.2)  irradiance: 3  angle: 25deg }\n", even, "6")},
      {"two suns, a lamp and a sky",
       fog(sun + "light distant { direction: (1, -0.4, 0)  irradiance: (0, 1, 3)  angle: "
                 "9deg }\nlight sphere { center: (-1, 1.5, 1)  radius: 0.2  power: 30 }\n"
                 "light environment { radiance: 0.3 }\n",
           even, "6")},
      {"colour and lobes", fog(sun,
                               "density = 1.2  absorption = (0.1, 0.02, 0)  scattering = (0.4, 1, 2)  phase "
                               "= mix(hg(0.9), hg(-0.3), 0.4)",
                               "6")},
      {"an uneven medium that shines",
       fog(sun, "density = 1 + sin(3 * p.x) * sin(2 * p.z)  albedo = 0.9  phase = hg(0.9)  emission = 0.05",
           "6")},
      {"light samples", fog(sun, even, "4  light_samples: 3")},
      {"orders of scattering", fog(sun, even, "64  multiple_scattering: approximate(real: 2, orders: 4)")},
  };
}

TEST(SunwardRays, ChangeNoMean) {
  for (const Case& c : cases()) {
    const scene::Scene scene = scene_of(c.text);
    RenderOptions without;
    without.sunward = false;
    support::expect_same(support::measure(scene).whole(), support::measure(scene, without).whole(), 0, 0.04,
                         c.name);
  }
}

// A light choice and a phase function of a ray through the fog.
struct Scattered {
  compile::CompiledScene world;
  Worker worker;
  March march;
  LightChoice lights;
  PhaseMixture phase;
  SunwardDirections directions;

  explicit Scattered(const std::string& text) : world(compile::compile(scene_of(text))) {
    const compile::Ray ray{{0, -2, -5}, normalize(Vec3d(0.2, -0.5, -1)), 30, 0};
    render::march(world, ray, compile::RayKind::camera, 1, worker, march);
    lights.set(world, ray.origin, ray.direction, 0, 10, 0);
    phase.set(world, march, 0);
    directions.set(world, lights, phase, 0);
  }
};

// The density integrates to 1, and 100,000 directions fall into 20 by 20 cells of equal solid angle as it
// says: χ² below 4 sigmas over its mean, with a fixed seed.
TEST(SunwardRays, FollowTheirDensity) {
  const Scattered s(fog(sun + "light distant { direction: (1, -0.4, 0)  irradiance: 1 }\n",
                        "density = 1  albedo = 0.9  phase = mix(hg(0.7), hg(-0.4), 0.3)", "2"));
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
TEST(SunwardRays, AreSentWhereTheyPay) {
  EXPECT_EQ(Scattered(fog(sun, "density = 1  albedo = 0.9", "2")).directions.chance(), 0);
  EXPECT_EQ(Scattered(fog(sun, "density = 1  albedo = 0.9  phase = rayleigh", "2")).directions.chance(), 0);
  EXPECT_EQ(Scattered(fog("light environment { radiance: 1 }\n", even, "2")).directions.chance(), 0);
  EXPECT_EQ(Scattered(fog("light point { position: (0, 5, 0)  power: 10 }\n", even, "2")).directions.chance(),
            0);
  EXPECT_GT(Scattered(fog(sun, even, "2")).directions.chance(), 0.1f);
}

}  // namespace
}  // namespace tyndall::render
