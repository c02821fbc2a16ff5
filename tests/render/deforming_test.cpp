// Laws of what moves point by point while the shutter is open, and of skies that turn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/numerics.h"
#include "base/plane.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using support::scene_of;

const std::string open_shutter = "animation { fps: 1  frames: 0..1  shutter: 360deg }\n";
const std::string settings = "render { resolution: (8, 8)  samples: 64 }\n";
const std::string from_above = "camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 2 }\n";
const std::string glow = "  material: { base_color = 0  emission = 1 }\n";

// Points that go where a transform takes those that stand: the same picture, with the same random numbers,
// but for single decisions.
TEST(Deforming, PointsThatMoveTogetherAreAThingThatMoves) {
  struct Case {
    const char* way;    // of a point q
    const char* place;  // the same as a transform
  };
  const std::string things = R"(
let now = time
def there(q) = WAY
mesh {
  points: [there((-0.6, -0.5, 0)), there((0.5, -0.4, 0.1)), there((0.1, 0.6, -0.2)), there((-0.4, 0.4, 0.3)),
           there((0.7, 0.1, 0.4)), there((-0.1, -0.8, -0.4))]
  triangles: [(0, 1, 2), (2, 3, 0), (1, 4, 2), (0, 5, 1), (3, 4, 5), (5, 4, 0)]
  transform: PLACE
}
curves {
  points: [[there((-0.9, 0.7, 0.5)), there((-0.2, 0.9, 0.6)), there((0.3, 0.5, 0.5)), there((0.9, 0.8, 0.5))],
           [there((-0.9, -0.7, 0.5)), there((0.9, -0.6, 0.5))]]
  radius: [0.1, 0.03]
  transform: PLACE
}
light distant { direction: (-0.3, -0.4, -1)  irradiance: 3 }
light environment { radiance: 0.2 }
)";
  const auto scene_with = [&](const std::string& way, const std::string& place) {
    std::string text = open_shutter + settings + from_above + things;
    for (const auto& [word, with] : {std::pair<std::string, std::string>{"WAY", way}, {"PLACE", place}})
      for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word))
        text.replace(at, word.size(), with);
    return scene_of(text);
  };
  for (const Case& c : {Case{"q + (0.7, -0.3, 0.2) * now", "translate((0.7, -0.3, 0.2) * time)"},
                        {"rotate_z(q, 120deg * now)", "rotate_z(120deg * time)"},
                        {"rotate_x(q, 80deg * now) + (0, 0.3 * now * now, 0)",
                         "translate((0, 0.3 * time * time, 0)) * rotate_x(80deg * time)"}}) {
    const scene::Scene by_points = scene_with(c.way, "translate((0, 0, 0))"),
                       by_place = scene_with("q", c.place);
    EXPECT_FALSE(by_points.meshes.at(0)->later.empty());
    EXPECT_FALSE(by_points.strand_sets.at(0).later.empty());
    EXPECT_TRUE(by_points.motion.shapes.empty());
    EXPECT_TRUE(by_place.meshes.at(0)->later.empty());
    EXPECT_EQ(by_place.motion.shapes.size(), 2u);
    const support::Estimate a = support::measure(by_points).whole(), b = support::measure(by_place).whole();
    support::expect_same(a, b, 0, 0.02, c.way);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a.mean[k], b.mean[k], 4e-3 * b.mean[k]) << c.way;
  }
}

// Shapes that are made into meshes from what changes with time, likewise.
TEST(Deforming, GeneratedShapesThatChangeAreThingsThatMove) {
  const std::string things = R"(
let now = MOVED
def waves(uv) = 0.2 * sin(7 * uv.x) - 0.7 + 0.3 * now
lathe { profile: [(0, 0.3 * now), (0.4, 0.3 * now), (0.2, 0.5 + 0.3 * now)]  segments: 12  transform: PLACE }
prism { outline: [(0.5, -0.2), (0.9, -0.2), (0.7, 0.3)]  height: 0.3  transform: translate((0, 0.3 * now, 0)) * PLACE }
heightfield { size: (1, 1)  height: waves  resolution: 4  transform: PLACE }
sweep { path: [(-0.6, 0.3 * now, 0), (-0.9, 0.4 + 0.3 * now, 0), (-0.5, 0.7 + 0.3 * now, 0)]  radius: [0.1, 0.02]  segments: 8  transform: PLACE }
light distant { direction: (-0.3, -0.4, -1)  irradiance: 3 }
light environment { radiance: 0.2 }
)";
  const auto scene_with = [&](const std::string& moved, const std::string& place) {
    std::string text = open_shutter + settings + from_above + things;
    for (const auto& [word, with] : {std::pair<std::string, std::string>{"MOVED", moved}, {"PLACE", place}})
      for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word))
        text.replace(at, word.size(), with);
    return scene_of(text);
  };
  const scene::Scene by_numbers = scene_with("time", "translate((0, 0, 0))"),
                     by_place = scene_with("0", "translate((0, 0.3 * time, 0))");
  ASSERT_EQ(by_numbers.meshes.size(), 4u);
  for (const std::size_t i : {0, 2, 3}) EXPECT_EQ(by_numbers.meshes[i]->later.size(), 1u) << i;
  EXPECT_EQ(by_place.motion.shapes.size(), 4u);
  support::expect_same(support::measure(by_numbers).whole(), support::measure(by_place).whole(), 0, 0.02,
                       "moved");
}

// As many poses as the way needs: none, one, and more the more it bends.
TEST(Deforming, HasAsManyPosesAsItsWayNeeds) {
  const auto poses = [](const std::string& y) {
    const scene::Scene s = scene_of(open_shutter + settings + from_above +
                                    fmt::format(R"(
let y = {}
mesh {{ points: [(0, 0, 0), (1, 0, 0), (0, 1 + y, 0)]  triangles: [(0, 1, 2)] }}
curves {{ points: [(0, 0, 0), (1, y, 0)]  radius: [0.01, 0.01] }}
curves {{ points: [(0, 0, 0), (1, 1, 0)]  radius: [0.2 + 0.1 * y, 0.01] }}
mesh {{ points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)]  triangles: [(0, 1, 2)]
       normals: [(0, 0, 1), (0, y, 1), (0, 0, 1)] }}
)",
                                                y));
    return std::array{s.meshes[0]->later.size(), s.strand_sets[0].later.size(), s.strand_sets[1].later.size(),
                      s.meshes[1]->later.size()};
  };
  using Counts = std::array<std::size_t, 4>;
  EXPECT_EQ(poses("0"), (Counts{0, 0, 0, 0}));
  EXPECT_EQ(poses("time")[0], 1u);
  EXPECT_EQ(poses("time")[1], 1u);
  EXPECT_EQ(poses("time")[2], 1u);
  const Counts gentle = poses("0.3 * time * time"), wild = poses("sin(6 * time)");
  for (std::size_t k = 0; k < gentle.size(); ++k) {
    EXPECT_GE(gentle[k], 1u) << k;
    EXPECT_GE(wild[k], 2 * gentle[k]) << k;
  }
}

// A strand across the view whose radius grows evenly from nothing covers half of what it covers at last.
TEST(Deforming, RadiiGrow) {
  const scene::Scene scene =
      scene_of(open_shutter + settings + from_above +
               "curves { points: [(-2, 0, 0), (0, 0, 0), (2, 0, 0)]  radius: 0.4 * time" + glow + "}\n");
  support::expect_truth(support::measure(scene).whole(), 0.2, 2e-3, 0.02, "growing strand");
}

// A closed mesh whose points move is a box that grows: mean transmittance over the time of depths from 0 to
// d is (1 - exp(-σ d)) / (σ d), by the shape's numbers, by a transform and by points.
TEST(Deforming, VolumesThatGrowHaveTheMeanTransmittance) {
  const double sigma = 1.7, depth = 1.5;
  const double mean = (1 - std::exp(-sigma * depth)) / (sigma * depth);
  const std::string corners = R"(mesh {
    points: [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0), (-2, -2, z), (2, -2, z), (2, 2, z), (-2, 2, z)]
    triangles: [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5),
                (2, 3, 7), (2, 7, 6), (3, 0, 4), (3, 4, 7)]
  })";
  for (const std::string& in :
       {std::string("in: box { min: (-2, -2, 0)  max: (2, 2, z) }"), "in: " + corners,
        std::string("in: box { min: (-2, -2, 0)  max: (2, 2, 1) }  transform: scale((1, 1, z))")}) {
    const scene::Scene scene = scene_of(
        open_shutter + settings + from_above + fmt::format("let z = 1e-4 + {} * time\n", depth) +
        "volume { " + in +
        fmt::format("  medium: {{ density = {}  albedo = 0 }} }}\nlight environment {{ radiance: 1 }}\n",
                    sigma));
    support::expect_truth(support::measure(scene).whole(), mean, 2e-3, 0.02, in);
  }
}

// Bright in one place, dim elsewhere, none below.
scene::EnvironmentLight sky() {
  constexpr int width = 32, height = 16;
  scene::EnvironmentLight light;
  light.radiance.color = Rgb(1);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> texels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        texels.push_back(y < height / 3                      ? 0
                         : y == height / 2 + 2 && x / 2 == 5 ? 40 + 10 * static_cast<float>(c)
                                                             : 0.2f + 0.01f * static_cast<float>(x));
    light.radiance.picture[c] = make_plane("sky", width, height, std::move(texels));
  }
  return light;
}

// A ball on which the sky shines, alone or under thin fog.
scene::Scene under(const scene::EnvironmentLight& first) {
  scene::Scene scene = scene_of(settings + R"(
camera perspective { from: (0, 1, 5)  to: (0, 0, 0)  fov: 34deg }
sphere {}
volume { in: box { min: (-2, -1, -2)  max: (2, 2, 2) }  medium: { density = 0.2  albedo = 0.9 } }
)");
  scene.lights.push_back({first, {}});
  return scene;
}

// By its own angle, by the groups around it, and by its colour: what is open is the mean of moments.
TEST(Deforming, ASkyThatTurnsIsTheMeanOfItsMoments) {
  const auto at = [](int way, double fraction) {
    scene::EnvironmentLight light = sky();
    if (way == 0) light.rotation.radians = 2.5 * fraction;
    if (way == 1) light.world_from_sky = Transform::rotate({1, 0, 0.3}, 1.2 * fraction);
    if (way == 2) light.radiance.color = Rgb(0, 1, 2) + Rgb(1, 0, -2) * static_cast<float>(fraction);
    return light;
  };
  for (int way = 0; way < 3; ++way) {
    scene::Scene open = under(at(way, 0));
    open.animation.fps = 1;
    open.animation.shutter.closes.radians = 2 * pi;
    open.settings.samples = 128;
    scene::Moving<scene::LightInstance> moving{0, {{at(way, 0), {}}, {at(way, 1), {}}}, {0, 1}, {}};
    scene::set_turnings(moving, {Vec3d{}});
    open.motion.lights.push_back(moving);
    const support::Estimate blurred = support::measure(open).whole();
    constexpr int moments = 16;
    support::Estimate mean;
    Vec3d variance;
    for (int k = 0; k < moments; ++k) {
      scene::Scene then = under(at(way, (k + 0.5) / moments));
      then.settings.samples = 16;
      const support::Estimate e = support::measure(then).whole();
      for (std::size_t c = 0; c < 3; ++c) {
        mean.mean[c] += e.mean[c] / moments;
        variance[c] += sqr(e.standard_error[c] / moments);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) mean.standard_error[c] = std::sqrt(variance[c]);
    support::expect_same(blurred, mean, 0.003 * mean.mean[0], 0.03, fmt::format("way {}", way));
  }
}

// A sky that turns once all round in an empty scene is the same everywhere along the horizon.
TEST(Deforming, ASkyThatTurnsAllRoundIsEvenAllRound) {
  scene::Scene scene = scene_of(
      "render { resolution: (16, 8)  samples: 256 }\n"
      "camera spherical { from: (0, 0, 0)  to: (0, 0, -1) }\n");
  scene.animation.fps = 1;
  scene.animation.shutter.closes.radians = 2 * pi;
  scene.lights.push_back({sky(), {}});
  scene::Moving<scene::LightInstance> moving{0, {{sky(), {}}, {sky(), {}}}, {0, 1}, {}};
  std::get<scene::EnvironmentLight>(moving.keys[1].light).rotation.radians = 2 * pi;
  scene.motion.lights.push_back(moving);
  const support::Measurement m = support::measure(scene);
  for (const int row : {2, 3, 5}) {
    const support::Estimate whole = m.region(0, row, 16, row + 1);
    for (int x = 0; x < 16; x += 4)
      support::expect_same(m.region(x, row, x + 4, row + 1), whole, 1e-4, 0.1, fmt::format("{} {}", row, x));
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
