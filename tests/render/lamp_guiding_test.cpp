// Rays towards lamps: they change the noise alone. Significance 0.0012 for each comparison of means, seeds 1
// to 16 (support/measure.h).
#include "render/lights/lamp_guiding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "base/sampler.h"
#include "render/lights/lit_spots.h"
#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using support::scene_of;

struct Case {
  std::string name, text;
};

// Fog over a ground, with what is named in it. `settings` are parameters.
std::string fog(const std::string& things, const std::string& medium, const std::string& settings) {
  return support::filled(R"(
render { resolution: (4, 4)  samples: 32  step: 0.2  $SETTINGS }
camera perspective { from: (0, 1.2, 5)  to: (0, 1, 0)  fov: 40deg }
$THINGS
medium fog() { $MEDIUM }
volume { in: box { min: (-3, 0, -3)  max: (3, 2.5, 3) }  medium: fog }
plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.6 } }
)",
                         {{"SETTINGS", settings}, {"THINGS", things}, {"MEDIUM", medium}});
}
const std::string even = "density = 0.5  albedo = 0.9  phase = hg(0.4)",
                  varying =
                      "density = 0.5 + 0.4 * sin(4 * p.x) * sin(3 * p.z)  albedo = 0.9  phase = hg(0.6)",
                  lamp = "light sphere { center: (0.2, 1, 0)  radius: 0.15  power: 20 }\n";

std::vector<Case> cases() {
  return {
      {"a lamp", fog(lamp, even, "bounces: 5")},
      {"one bounce", fog(lamp, even, "bounces: 1")},
      {"a wide lamp",
       fog("light sphere { center: (0.2, 1, 0)  radius: 0.7  power: 20 }\n", even, "bounces: 4")},
      {"a varying medium that emits", fog(lamp, varying + "  emission = 0.05", "bounces: 4")},
      {"lobes of several colours", fog(lamp,
                                       "density = 0.5  absorption = (0.1, 0.02, 0)  scattering = (0.4, 1, 2) "
                                       " phase = mix(hg(0.8), hg(-0.3), 0.4)",
                                       "bounces: 4")},
      {"light samples", fog(lamp, even, "bounces: 3  light_samples: 3")},
      {"orders of scattering",
       fog(lamp, even, "bounces: 64  multiple_scattering: approximate(real: 2, orders: 4)")},
      {"a lamp that touches a surface",
       fog("light sphere { center: (0.2, 0.1, 0)  radius: 0.1  power: 20 }\n", even, "bounces: 4")},
      {"a lamp behind a wall",
       fog(lamp + "box { min: (-0.4, 0, 0.5)  max: (0.8, 2, 0.6) }\n", even, "bounces: 4")},
      {"a lamp in a shade of glass",
       fog("light sphere { center: (0.2, 1, 0)  radius: 0.2  power: 20 }\nsphere { center: (0.2, 1, 0)  "
           "radius: 0.4  "
           "material: { base_color = 1  transmission = 1  ior = 1.5  roughness = 0.4 } }\n",
           even, "bounces: 6")},
      {"gloss, lacquer and holes", fog(lamp + R"(
sphere { center: (-0.6, 0.8, 0.3)  radius: 0.4  material: { base_color = 0.8  metallic = 1  roughness = 0.3 } }
sphere { center: (0.9, 0.7, 0.2)  radius: 0.3  material: { base_color = 0.5  coat = 1 } }
quad { center: (0.2, 0.6, 0.4)  u: (0.4, 0, 0)  v: (0, 0.3, 0)  material: { base_color = 0.5  opacity = 0.4 } }
)",
                                       even, "bounces: 4")},
      {"a spot, a quad, a sun and a sky", fog(R"(
light spot { position: (-0.5, 2, 0)  to: (0, 0, 0)  angle: 25deg  intensity: 10 }
light quad { center: (0.8, 1.4, 0)  u: (0.15, 0, 0)  v: (0, 0.15, 0.1)  power: 10 }
light distant { direction: (-0.5, -1, -0.2)  irradiance: 1  angle: 9deg }
light environment { radiance: 0.1 }
)",
                                              "density = 0.5  albedo = 0.9  phase = hg(0.8)", "bounces: 4")},
      {"a lamp that moves while the shutter is open",
       fog("light sphere { center: (-0.5 + time, 1, 0)  radius: 0.15  power: 20 }\nanimation { fps: 1  "
           "frames: 0..1  shutter: 180deg }\n",
           even, "bounces: 4")},
      {"a glowing ball, and things in placed objects", fog(R"(
sphere { center: (0.2, 1, 0)  radius: 0.1  material: { base_color = 0  emission = 100 } }
object post { cylinder { from: (0, 0, 0)  to: (0, 1, 0)  radius: 0.1 } }
place post { transform: translate((-0.3, 0, 0.3)) }
)",
                                                           even, "bounces: 4")},
      {"many lamps", fog("for i in 0..20 { light sphere { center: (-2 + 0.2 * i, 1 + 0.3 * sin(i), 0)  "
                         "radius: 0.03  power: 1.5 } }\n",
                         even, "bounces: 4")},
  };
}

// The mean of a picture.
Vec3d mean_of(const Film& film) {
  Vec3d sum;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) sum += Vec3d(film.mean(x, y));
  return sum / static_cast<double>(film.width() * film.height());
}

// Both ways share the numbers of what they have in common, so the difference of two pictures of one seed
// tells more than the pictures do: it is 0 to 4 standard errors over the seeds, which are below 6 % of the
// mean.
void expect_same_means(const support::Measurement& a, const support::Measurement& b,
                       const std::string& name) {
  const auto n = static_cast<double>(a.films.size());
  Vec3d sum, squares, mean;
  for (std::size_t i = 0; i < a.films.size(); ++i) {
    const Vec3d difference = mean_of(a.films[i]) - mean_of(b.films[i]);
    sum += difference;
    squares += difference * difference;
    mean += mean_of(b.films[i]) / n;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double error = std::sqrt((squares[c] - sqr(sum[c]) / n) / (n * (n - 1)));
    EXPECT_LE(std::abs(sum[c] / n), support::sigmas * error) << name << ", channel " << c;
    EXPECT_LE(error, 0.06 * mean[c]) << name << ": too noisy to tell";
  }
}

TEST(LampRays, ChangeNoMean) {
  for (const Case& c : cases()) {
    const scene::Scene scene = scene_of(c.text);
    RenderOptions without;
    without.lamp_guiding = false;
    expect_same_means(support::measure(scene), support::measure(scene, without), c.name);
  }
}

// The density integrates to 1, and 100,000 directions fall into cells of equal solid angle as it says: χ²
// below 4 sigmas over its mean, with a fixed seed.
void expect_follows_density(const LampGuide& guide, const std::string& name) {
  ASSERT_FALSE(guide.empty());
  constexpr int cells = 24, draws = 100000, fine = 60;
  std::vector<double> expected(cells * cells), found(cells * cells);
  double total = 0;
  for (int i = 0; i < cells * fine; ++i)
    for (int k = 0; k < cells * fine; ++k) {
      const double z = 2 * (i + 0.5) / (cells * fine) - 1, phi = 2 * pi * (k + 0.5) / (cells * fine);
      const double r = safe_sqrt(1 - z * z);
      const double mass =
          guide.pdf({r * std::cos(phi), r * std::sin(phi), z}) * 4 * pi / (1.0 * cells * fine * cells * fine);
      expected[static_cast<std::size_t>(i / fine * cells + k / fine)] += mass;
      total += mass;
    }
  EXPECT_NEAR(total, 1, 2e-3) << name;
  for (std::uint32_t n = 0; n < draws; ++n) {
    const Sampler sampler(3, 0, 0, 0, n);
    const auto u = [&](std::uint64_t k) { return sampler.independent(k, 0); };
    const Vec3d w = guide.sample(u(0), u(1), u(2));
    EXPECT_NEAR(length(w), 1, 1e-12) << name;
    const double phi = std::atan2(w.y, w.x) + (w.y < 0 ? 2 * pi : 0);
    const int i = std::min(static_cast<int>((w.z + 1) / 2 * cells), cells - 1),
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
  EXPECT_GT(counted, 400) << name;
  EXPECT_LT(chi_squared, counted + 4 * std::sqrt(2.0 * counted)) << name;
}

TEST(LampRays, FollowTheirDensity) {
  const compile::CompiledScene world = compile::compile(
      scene_of(fog(lamp + "light point { position: (-1, 0.5, 1)  power: 5 }\n", even, "bounces: 2")));
  const compile::Ray at{Vec3d{1.2, 1.9, 0.4} - world.origin, {0, 0, 1}, infinity, 0};
  expect_follows_density(LampGuide(world, nullptr, at, {}), "lamps");
  const LitSpots spots({{at.origin + Vec3d{1, 0.5, -0.2}, 0.5, 1}, {at.origin + Vec3d{-2, 1, -2}, 0.9, 3}});
  expect_follows_density(LampGuide(world, &spots, at, {}), "lamps and spots");
}

// What a lamp lights most is in small spheres, and every point is in one.
TEST(LitSpots, AreSmallWhereLightIsBright) {
  std::vector<LitPoint> points;
  for (int i = 0; i < 400; ++i) {
    const double r = i < 300 ? 0.002 * i : i - 299, angle = 2.4 * i;
    points.push_back({{r * std::cos(angle), 0, r * std::sin(angle)}, 0.01, i < 300 ? 1.0 : 0.1});
  }
  const std::vector<LitPoint> all = points;
  const std::vector<LitSpot> spots = gathered(points, LitSpots::most_spots);
  EXPECT_EQ(spots.size(), LitSpots::most_spots);
  double power = 0, small = 0;
  for (const LitSpot& s : spots) {
    power += s.power;
    if (s.radius < 1) small += s.power;  // of a hundred metres
    EXPECT_LT(s.power, 310 / 4.0);
  }
  EXPECT_NEAR(power, 310, 1e-9);
  EXPECT_GT(small, 290);  // of the 300 that fall within 0.6 m
  for (const LitPoint& p : all)
    EXPECT_TRUE(std::any_of(spots.begin(), spots.end(), [&](const LitSpot& s) {
      return length(p.position - s.center) + p.radius <= s.radius * (1 + 1e-12);
    }));
  EXPECT_TRUE(gathered({}, 16).empty());
}

// The power of the spots is what surfaces scatter of the lamp's: half a lamp's light falls on an endless
// plane. A closed room gets all.
TEST(LitSpots, HaveThePowerOfWhatIsLit) {
  const std::string camera =
      "camera perspective { from: (0, 1.2, 2)  to: (0, 1, 0) }\nlight sphere { center: (0.1, 1, 0)  radius: "
      "0.05  power: 30 }\n";
  const auto power = [](const std::string& text) {
    const auto spots = LitSpots::of(compile::compile(scene_of(text)));
    double sum = 0;
    for (const LitSpot& s : spots->spots()) sum += s.power;
    return sum;
  };
  const std::string plane = "plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.5 } }\n";
  EXPECT_NEAR(power(camera + plane), 7.5, 0.2);
  EXPECT_NEAR(power(camera + "sphere { radius: 5  material: { base_color = 0.5 } }\n"), 15, 0.2);
  EXPECT_EQ(LitSpots::of(compile::compile(scene_of(camera))), nullptr);
}

// Only what the scene requires.
TEST(LampRays, AreSentWhereThereAreLampsInMedia) {
  const auto guides = [](const std::string& text) {
    return guides_to_lamps(compile::compile(scene_of(text)));
  };
  EXPECT_TRUE(guides(fog(lamp, even, "")));
  EXPECT_FALSE(guides(fog("light sphere { center: (0, 1, 0)  radius: 3  power: 9 }\n", even, "")));
  EXPECT_FALSE(guides(fog("light distant { direction: (0, -1, 0)  irradiance: 1 }\n", even, "")));
  EXPECT_FALSE(guides(fog("light environment { radiance: 1 }\n", even, "")));
  EXPECT_FALSE(guides("camera perspective { from: (0, 1, 5)  to: (0, 1, 0) }\nsphere {}\n" + lamp));
}

}  // namespace UNNAMED
}  // namespace tyndall::render
