// Laws of motion while the shutter is open.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "base/numerics.h"
#include "support/measure.h"
#include "support/scene_text.h"
#include "support/ways.h"

namespace tyndall::render {
namespace UNNAMED {

using support::scene_of;

// The shutter is open for half a second.
const std::string open_shutter = "animation { fps: 1  frames: 0..1  shutter: 180deg }\n";
const std::string settings = "render { resolution: (8, 8)  samples: 32  bounces: 2 }\n";
const std::string view = "camera perspective { from: (0, 0.5, 5)  to: (0, 0.3, 0)  fov: 40deg }\n";

// Fog, a lamp and a ball, all moved by `at`.
const std::string things = R"(
volume {
  in: sphere { radius: 2 }
  medium: { density = 0.4 * smoothstep(2, 0.5, length(p)) * (1.2 + sin(4 * p.x))  albedo = 0.8 }
  step: 0.1
  transform: translate(at)
}
light sphere { center: (0.8, 1.3, 0.2) + at  radius: 0.2  power: 40 }
sphere { center: (-0.4, 0, 0) + at  radius: 0.5 }
)";
const std::string still = "let at = (0, 0, 0)\n";

Film film_of(const scene::Scene& scene, const RenderOptions& options = {}) {
  return render(compile::compile(scene), options).film;
}

void expect_equal(const Film& a, const Film& b, double relative) {
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(a.mean(x, y)[c], b.mean(x, y)[c], relative * std::abs(b.mean(x, y)[c])) << x << ' ' << y;
}

// A feature that a scene does not use costs nothing: not a bit changes.
TEST(Motion, AnOpenShutterChangesNoStillScene) {
  const scene::Scene open = scene_of(open_shutter + settings + view + still + things);
  const scene::Scene closed = scene_of(settings + view + still + things);
  EXPECT_FALSE(compile::compile(open).features.motion);
  expect_equal(film_of(open), film_of(closed), 0);
}

TEST(Motion, AClosedShutterIsAMoment) {
  const std::string later = "animation { fps: 1  frames: 3..3 }\n";
  scene::Scene moves = scene_of(later + settings + view + "let at = (0.1, 0.05, 0) * time\n" + things);
  moves.frame = 0;  // a frame has random numbers of its own
  const scene::Scene unmoved = scene_of(settings + view + "let at = (0.1, 0.05, 0) * 3\n" + things);
  EXPECT_FALSE(compile::compile(moves).features.motion);
  expect_equal(film_of(moves), film_of(unmoved), 0);
}

// Nothing changes when all goes the same way, but for the rounding of places: single decisions of a few of
// 2048 paths.
TEST(Motion, GoingAlongIsStandingStill) {
  const std::string along = R"(
let at = (3, -1, 2) * time
camera perspective { from: (0, 0.5, 5) + at  to: (0, 0.3, 0) + at  fov: 40deg }
)";
  const scene::Scene together = scene_of(open_shutter + settings + along + things);
  const scene::Scene apart = scene_of(settings + view + still + things);
  EXPECT_TRUE(compile::compile(together).features.motion);
  support::expect_same(support::measure(together).whole(), support::measure(apart).whole(), 0, 0.02,
                       "together");
  // What lamps light is looked for at the middle of the shutter, so rays towards it differ.
  RenderOptions unguided;
  unguided.lamp_guiding = false;
  const Film a = film_of(together, unguided), b = film_of(apart, unguided);
  int differ = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      differ += std::abs(a.mean(x, y)[0] - b.mean(x, y)[0]) > 1e-4 * b.mean(x, y)[0];
  EXPECT_LE(differ, 3);
}

// f(p - v t) is f moved by v t: the same at every ray's time, with the same random numbers.
TEST(Motion, MovingTheDensityMovesTheVolume) {
  const auto cloud = [](const std::string& moved) {
    return scene_of(open_shutter + settings + view + moved + R"(
light distant { direction: (-1, -1, -1)  irradiance: 2 }
medium lumps() {
  let q = p - density_at
  density = 4 * smoothstep(1, 0.3, length(q)) * (1.3 + sin(7 * q.x) * sin(5 * q.y))
  albedo = 0.9
}
volume {
  in: sphere { center: box_at  radius: 1 }
  medium: lumps
  step: 0.05
  transform: translate(volume_at)
}
)");
  };
  const scene::Scene by_shader = cloud(R"(
let density_at = (1.5, 0.5, 0) * time
let box_at = density_at
let volume_at = (0, 0, 0)
)"),
                     by_place = cloud(R"(
let density_at = (0, 0, 0)
let box_at = (0, 0, 0)
let volume_at = (1.5, 0.5, 0) * time
)");
  EXPECT_TRUE(by_shader.media[0].full.reads(vm::Input::time));
  EXPECT_FALSE(by_place.media[0].full.reads(vm::Input::time));
  const support::Estimate a = support::measure(by_shader).whole(), b = support::measure(by_place).whole();
  support::expect_same(a, b, 0, 0.02, "shader and transform");
  // Far closer than their noise: the same samples but for rounding.
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a.mean[c], b.mean[c], 2e-3 * b.mean[c]);
}

// What is open is the mean of its moments.
TEST(Motion, ABlurIsTheMeanOfMoments) {
  const auto scene_at = [&](const std::string& moment, int samples) {
    scene::Scene scene = scene_of(moment + settings + view + R"(
let at = (1, 0.5, -0.5) * now
group {
  transform: rotate_z(200deg * now) * translate((0.5, 0, 0))
  box { min: (-0.6, -0.2, -0.2)  max: (0.6, 0.2, 0.2) }
}
)" + things);
    scene.settings.samples = samples;
    return scene;
  };
  const support::Estimate blurred =
      support::measure(scene_at(open_shutter + "let now = time\n", 128)).whole();
  constexpr int moments = 24;
  support::Estimate mean;
  Vec3d variance;
  for (int k = 0; k < moments; ++k) {
    const support::Estimate e =
        support::measure(scene_at(fmt::format("let now = {}\n", 0.5 * (k + 0.5) / moments), 16)).whole();
    for (std::size_t c = 0; c < 3; ++c) {
      mean.mean[c] += e.mean[c] / moments;
      variance[c] += sqr(e.standard_error[c] / moments);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) mean.standard_error[c] = std::sqrt(variance[c]);
  // The middles of 24 intervals: what a smooth course keeps from its mean is below 1/24².
  support::expect_same(blurred, mean, 0.002 * mean.mean[0], 0.03, "blur");
}

// Lights that move, sampled and hit at the same time of a path; every way to draw a distance agrees.
TEST(Motion, LightsAreMetWhereTheyAreDrawn) {
  const scene::Scene scene = scene_of(open_shutter + settings + view + R"(
let at = (2, 0, 0) * time
light quad { center: (-1, 1.5 - time, 0)  u: (0.3, 0, 0)  v: (0, 0, 0.3)  power: 20 }
light mesh {
  in: box { min: (-0.2, -1, 0.5)  max: (0.2, -0.8, 0.9) }
  power: 20
  transform: translate((0, time, 0))
}
)" + things);
  RenderOptions density;
  density.distance = Distance::density;
  const support::Estimate wanted = support::measure(scene, density).whole();
  for (const auto& [name, distance] : support::all_distances()) {
    if (distance == density.distance) continue;
    RenderOptions options;
    options.distance = distance;
    support::expect_same(support::measure(scene, options).whole(), wanted, 0, 0.06, name);
  }
  for (const auto& [name, method] : support::all_methods()) {
    if (method == density.method) continue;
    RenderOptions options;
    options.method = method;
    support::expect_same(support::measure(scene, options).whole(), wanted, 0, 0.08, name);
  }
}

// A fan that turns so many whole times is the even ring that a quarter of its turns would make, however many.
TEST(Motion, ManyTurnsMakeAnEvenRing) {
  for (const int turns : {1, 16, 32}) {
    const scene::Scene scene = scene_of(fmt::format("let turns = {}\n", turns) + R"(
animation { fps: 1  frames: 0..1  shutter: 360deg }
render { resolution: (16, 16)  samples: 128 }
camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 4 }
quad {
  center: (1, 0, 0)  u: (0.3, 0, 0)  v: (0, 0.1, 0)
  material: { base_color = 0  emission = 1 }
  transform: rotate_z(360deg * turns * time)
}
)");
    const support::Measurement m = support::measure(scene);
    const double mean = 0.6 * 0.2 / 16;
    support::expect_truth(m.whole(), mean, 0, 0.02, "ring");
    for (const int x : {0, 8})
      for (const int y : {0, 8})
        support::expect_truth(m.region(x, y, x + 8, y + 8), mean, 0, 0.05, "quarter of the ring");
    // The corners of the view's middle cross and its diagonals: a bow tie would be bright in one pair alone.
    support::expect_same(m.region(12, 6, 14, 10), m.region(6, 12, 10, 14), 0, 0.2, "right and below");
  }
}

// A ball that turns about its own middle is one that stands still.
TEST(Motion, TurningDoesNotShrink) {
  const auto ball = [](const std::string& turn) {
    return film_of(scene_of(settings + view + fmt::format("let turn = {}\n", turn) + R"(
animation { fps: 1  frames: 0..1  shutter: 360deg }
sphere { radius: 0.8  transform: turn  material: { base_color = 0  emission = 1 } }
)"));
  };
  const Film standing = ball("rotate_y(0deg)");
  for (const char* turn : {"rotate_y(2000deg * time)", "rotate_x(5760deg * time) * scale((-1, 1, 1))"}) {
    const Film turning = ball(turn);
    int differ = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) differ += std::abs(turning.mean(x, y)[0] - standing.mean(x, y)[0]) > 1e-6;
    EXPECT_LE(differ, 1) << turn;
  }
}

// A thousand kilometres a second, a hundred turns, a shape that is flat for a moment.
TEST(Motion, IsSafeAtItsExtremes) {
  for (const char* thing :
       {"sphere { center: (1e6 * (time - 0.25), 0, 0) }",
        "group { transform: rotate_y(36000deg * time)  box { min: (-1, -1, -1)  max: (1, 1, 1) } }",
        "sphere { transform: scale((1, 1.01 - 4 * time, 1)) }",
        R"(
volume {
  in: sphere {}
  medium: { density = 1 + sin(1e4 * time)  albedo = 0.5 }
  transform: rotate_z(7000deg * time)
}
)"}) {
    const scene::Scene scene =
        scene_of(open_shutter + settings + view + thing + "\nlight environment { radiance: 1 }\n");
    const RenderResult result = render(compile::compile(scene), {});
    EXPECT_EQ(result.statistics.bad_samples, 0u) << thing;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        EXPECT_GE(result.film.mean(x, y)[0], 0) << thing;
        EXPECT_LE(result.film.mean(x, y)[0], 1.5) << thing;
      }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
