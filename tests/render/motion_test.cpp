// Laws of motion while the shutter is open.
#include <gtest/gtest.h>

#include <string>

#include "base/numerics.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace {

using support::scene_of;

// The shutter is open for half a second.
const std::string open_shutter = "animation { fps: 1  frames: 0..1  shutter: 180deg }\n";
const std::string settings = "render { resolution: (8, 8)  samples: 32  bounces: 2 }\n";
const std::string view = "camera perspective { from: (0, 0.5, 5)  to: (0, 0.3, 0)  fov: 40deg }\n";

// Fog, a lamp and a ball; the places have `+ AT` added.
std::string things(const std::string& at) {
  return "volume { in: sphere { radius: 2 }  medium: { density = 0.4 * smoothstep(2, 0.5, length(p)) * (1.2 "
         "+ sin(4 * p.x))  "
         "albedo = 0.8 }  step: 0.1  transform: translate((0, 0, 0) + " +
         at +
         ") }\n"
         "light sphere { center: (0.8, 1.3, 0.2) + " +
         at +
         "  radius: 0.2  power: 40 }\n"
         "sphere { center: (-0.4, 0, 0) + " +
         at + "  radius: 0.5 }\n";
}

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
  const scene::Scene open = scene_of(open_shutter + settings + view + things("(0, 0, 0)"));
  const scene::Scene closed = scene_of(settings + view + things("(0, 0, 0)"));
  EXPECT_FALSE(compile::compile(open).features.motion);
  expect_equal(film_of(open), film_of(closed), 0);
}

TEST(Motion, AClosedShutterIsAMoment) {
  const std::string later = "animation { fps: 1  frames: 3..3 }\n";
  scene::Scene moves = scene_of(later + settings + view + things("(0.1, 0.05, 0) * time"));
  moves.frame = 0;  // a frame has random numbers of its own
  const scene::Scene still = scene_of(settings + view + things("(0.1, 0.05, 0) * 3"));
  EXPECT_FALSE(compile::compile(moves).features.motion);
  expect_equal(film_of(moves), film_of(still), 0);
}

// Nothing changes when all goes the same way, but for the rounding of places: single decisions of a few of
// 2048 paths.
TEST(Motion, GoingAlongIsStandingStill) {
  const std::string way = "(3, -1, 2) * time";
  const scene::Scene together =
      scene_of(open_shutter + settings + "camera perspective { from: (0, 0.5, 5) + " + way +
               "  to: (0, 0.3, 0) + " + way + "  fov: 40deg }\n" + things(way));
  const scene::Scene still = scene_of(settings + view + things("(0, 0, 0)"));
  EXPECT_TRUE(compile::compile(together).features.motion);
  support::expect_same(support::measure(together).whole(), support::measure(still).whole(), 0, 0.02,
                       "together");
  const Film a = film_of(together), b = film_of(still);
  int differ = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      differ += std::abs(a.mean(x, y)[0] - b.mean(x, y)[0]) > 1e-4 * b.mean(x, y)[0];
  EXPECT_LE(differ, 3);
}

// f(p - v t) is f moved by v t: the same at every ray's time, with the same random numbers.
TEST(Motion, MovingTheDensityMovesTheVolume) {
  const auto cloud = [](const std::string& density_at, const std::string& box_at,
                        const std::string& volume_at) {
    return scene_of(open_shutter + settings + view +
                    "light distant { direction: (-1, -1, -1)  irradiance: 2 }\n"
                    "let way = (1.5, 0.5, 0) * time\n"
                    "volume { in: sphere { center: (0, 0, 0) + " +
                    box_at + "  radius: 1 }  step: 0.05  transform: translate(" + volume_at +
                    ")  medium: { let q = p - " + density_at +
                    "  density = 4 * smoothstep(1, 0.3, length(q)) * (1.3 + sin(7 * q.x) * sin(5 * q.y))  "
                    "albedo = 0.9 } }\n");
  };
  const scene::Scene by_shader = cloud("way", "way", "(0, 0, 0)"),
                     by_place = cloud("(0, 0, 0)", "(0, 0, 0)", "way");
  EXPECT_TRUE(by_shader.media[0].full.reads(vm::Input::time));
  EXPECT_FALSE(by_place.media[0].full.reads(vm::Input::time));
  const support::Estimate a = support::measure(by_shader).whole(), b = support::measure(by_place).whole();
  support::expect_same(a, b, 0, 0.02, "shader and transform");
  // Far closer than their noise: the same samples but for rounding.
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a.mean[c], b.mean[c], 2e-3 * b.mean[c]);
}

// What is open is the mean of its moments.
TEST(Motion, ABlurIsTheMeanOfMoments) {
  const std::string body =
      "group { transform: rotate_z(200deg * time) * translate((0.5, 0, 0))  box { min: (-0.6, -0.2, -0.2)  "
      "max: (0.6, 0.2, 0.2) } }\n";
  const auto scene_at = [&](const std::string& animation, const std::string& time, int samples) {
    std::string text = animation + settings + view + things("(1, 0.5, -0.5) * time") + body;
    for (std::size_t at = text.find("time"); at != std::string::npos;
         at = text.find("time", at + time.size()))
      text.replace(at, 4, time);
    scene::Scene scene = scene_of(text);
    scene.settings.samples = samples;
    return scene;
  };
  const support::Estimate blurred = support::measure(scene_at(open_shutter, "time", 128)).whole();
  constexpr int moments = 24;
  support::Estimate mean;
  Vec3d variance;
  for (int k = 0; k < moments; ++k) {
    const support::Estimate e =
        support::measure(scene_at("", "(" + std::to_string(0.5 * (k + 0.5) / moments) + ")", 16)).whole();
    for (std::size_t c = 0; c < 3; ++c) {
      mean.mean[c] += e.mean[c] / moments;
      variance[c] += sqr(e.standard_error[c] / moments);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) mean.standard_error[c] = std::sqrt(variance[c]);
  // The middles of 24 stretches: what a smooth course keeps from its mean is below 1/24².
  support::expect_same(blurred, mean, 0.002 * mean.mean[0], 0.03, "blur");
}

// Lights that move, drawn and met at the same time of a path; every way to draw a distance agrees.
TEST(Motion, LightsAreMetWhereTheyAreDrawn) {
  const scene::Scene scene =
      scene_of(open_shutter + settings + view + things("(2, 0, 0) * time") +
               "light quad { center: (-1, 1.5 - time, 0)  u: (0.3, 0, 0)  v: (0, 0, 0.3)  power: 20 }\n"
               "light mesh { in: box { min: (-0.2, -1, 0.5)  max: (0.2, -0.8, 0.9) }  power: 20  "
               "transform: translate((0, time, 0)) }\n");
  RenderOptions density;
  density.distance = Distance::density;
  const support::Estimate wanted = support::measure(scene, density).whole();
  for (const Distance distance : {Distance::mis, Distance::equiangular, Distance::product}) {
    RenderOptions options;
    options.distance = distance;
    support::expect_same(support::measure(scene, options).whole(), wanted, 0, 0.06,
                         "distance " + std::to_string(static_cast<int>(distance)));
  }
  for (const Method method : {Method::stochastic, Method::tracking}) {
    RenderOptions options;
    options.method = method;
    support::expect_same(support::measure(scene, options).whole(), wanted, 0, 0.08,
                         "method " + std::to_string(static_cast<int>(method)));
  }
}

// A fan that turns so many whole times is the even ring that a quarter of its turns would make, however many.
TEST(Motion, ManyTurnsMakeAnEvenRing) {
  for (const int turns : {1, 16, 32}) {
    const scene::Scene scene = scene_of(
        "animation { fps: 1  frames: 0..1  shutter: 360deg }\nrender { resolution: (16, 16)  samples: 128 }\n"
        "camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 4 }\n"
        "quad { center: (1, 0, 0)  u: (0.3, 0, 0)  v: (0, 0.1, 0)  material: { base_color = 0  emission = 1 "
        "}  "
        "transform: rotate_z(360deg * " +
        std::to_string(turns) + " * time) }\n");
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
  const auto ball = [](const std::string& transform) {
    return film_of(scene_of("animation { fps: 1  frames: 0..1  shutter: 360deg }\n" + settings + view +
                            "sphere { transform: " + transform +
                            "  radius: 0.8  material: { base_color = 0  emission = 1 } }\n"));
  };
  const Film still = ball("rotate_y(0deg)");
  for (const char* turn : {"rotate_y(2000deg * time)", "rotate_x(5760deg * time) * scale((-1, 1, 1))"}) {
    const Film turning = ball(turn);
    int differ = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) differ += std::abs(turning.mean(x, y)[0] - still.mean(x, y)[0]) > 1e-6;
    EXPECT_LE(differ, 1) << turn;
  }
}

// A thousand kilometres a second, a hundred turns, a shape that is flat for a moment.
TEST(Motion, IsSafeAtItsExtremes) {
  for (const char* thing :
       {"sphere { center: (1e6 * (time - 0.25), 0, 0) }",
        "group { transform: rotate_y(36000deg * time)  box { min: (-1, -1, -1)  max: (1, 1, 1) } }",
        "sphere { transform: scale((1, 1.01 - 4 * time, 1)) }",
        "volume { in: sphere {}  medium: { density = 1 + sin(1e4 * time)  albedo = 0.5 }  transform: "
        "rotate_z(7000deg * time) }"}) {
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

}  // namespace
}  // namespace tyndall::render
