// Statistics of motion: what is open is the mean of its moments, weighted by the shutter's curve.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "base/numerics.h"
#include "support/measure.h"
#include "support/scene_text.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using support::scene_of;

const char* const shutter_curves[] = {"box", "trapezoid(opening: 20%, closing: 50%)"};

std::string opened(const char* curve) {
  return fmt::format("animation {{ fps: 1  frames: 0..1  shutter: (-180deg, 180deg)  shutter_curve: {} }}\n",
                     curve);
}

// Lights that turn, drawn and met, in fog and on a floor.
const std::string spinning = R"(
render { resolution: (8, 8)  samples: 64  bounces: 3 }
camera perspective { from: (0, 1.5, 6)  to: (0, 0.5, 0)  fov: 40deg }
let turn = 300deg * now
light spot {
  position: (0, 1.5, 0)
  to: (3 * cos(turn), 0.5, 3 * sin(turn))
  angle: 25deg
  blend: 0.5
  power: 60
}
group {
  transform: rotate_y(2 * turn)
  light quad { center: (1.2, 1, 0)  u: (0, 0.3, 0)  v: (0, 0, 0.3)  radiance: 20 }
  light mesh { in: box { min: (-1, 0.1, 0.8)  max: (-0.8, 0.4, 1) }  radiance: 10 }
}
volume { in: box { min: (-3, 0, -3)  max: (3, 3, 3) }  medium: { density = 0.15  albedo = 0.8  phase = hg(0.4) } }
plane { point: (0, 0, 0)  normal: (0, 1, 0) }
)";

// The average over 64 stratified random times, 16 times over: its error is that of both, times and paths.
support::Estimate mean_of_random_times(const char* curve) {
  constexpr int times = 64;
  const scene::ShutterCurve weights =
      scene_of(opened(curve) + "let now = time\n" + spinning).animation.shutter_curve;
  std::vector<Vec3d> means;
  for (int seed = 1; seed <= support::seed_count; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    Vec3d mean;
    for (int k = 0; k < times; ++k) {
      const double u = (k + std::uniform_real_distribution<double>()(random)) / times;
      scene::Scene then = scene_of(fmt::format("let now = ({})\n", weights.moment(u) - 0.5) + spinning);
      then.settings.samples = 4;
      then.settings.seed = static_cast<std::uint64_t>(seed * times + k);
      const render::Film film = render::render(compile::compile(then), {}).film;
      for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
          mean += Vec3d(film.mean(x, y)) * (1.0 / (times * film.width() * film.height()));
    }
    means.push_back(mean);
  }
  support::Estimate out;
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0, squares = 0;
    for (const Vec3d& m : means) sum += m[c];
    out.mean[c] = sum / support::seed_count;
    for (const Vec3d& m : means) squares += sqr(m[c] - out.mean[c]);
    out.standard_error[c] = std::sqrt(squares / (support::seed_count * (support::seed_count - 1)));
  }
  return out;
}

TEST(SpinningLights, ShineAsTheAverageOfRandomTimes) {
  for (const char* curve : shutter_curves) {
    const scene::Scene blurred = scene_of(opened(curve) + "let now = time\n" + spinning);
    EXPECT_EQ(blurred.motion.lights.size(), 3u);
    support::expect_same(support::measure(blurred).whole(), mean_of_random_times(curve), 0, 0.03, curve);
  }
}

// A block of fog, half as wide as the view and 0.8 m deep, goes through the view from side to side: the mean
// transmittance is that of the mean of the share that it covers. Its middle goes from -2 to 2.
TEST(MovingVolumes, HaveTheMeanTransmittance) {
  const double sigma = 1.3, depth = 0.8;
  for (const char* curve : shutter_curves) {
    const std::string text = opened(curve) + R"(
render { resolution: (8, 8)  samples: 256 }
camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 2 }
let x = 4 * time
light environment { radiance: 1 }
)";
    const scene::ShutterCurve weights = scene_of(text).animation.shutter_curve;
    double covered = 0;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
      const double moment = (i + 0.5) / steps, at = 4 * moment - 2;
      const double lo = std::max(at - 0.5, -1.0), hi = std::min(at + 0.5, 1.0);
      covered += weights.density(moment) * std::max(0.0, hi - lo) / 2 / steps;
    }
    const double truth = 1 - covered * (1 - std::exp(-sigma * depth));
    const std::string medium = fmt::format("medium: {{ density = {}  albedo = 0 }} }}", sigma);
    const std::string block = "box { min: (-0.5, -2, -0.4)  max: (0.5, 2, 0.4) }";
    const std::pair<const char*, std::string> ways[] = {
        {"by its transform", "volume { in: " + block + "  transform: translate((x, 0, 0))  " + medium},
        {"by its shape", "volume { in: box { min: (x - 0.5, -2, -0.4)  max: (x + 0.5, 2, 0.4) }  " + medium},
        {"by its shader",
         fmt::format("volume {{ in: box {{ min: (-3, -2, -0.4)  max: (3, 2, 0.4) }}  step: 0.4  "
                     "medium: {{ density = {} * (if abs(p.x - x) < 0.5 then 1 else 0)  albedo = 0 }} }}",
                     sigma)},
    };
    for (const auto& [what, volume] : ways)
      for (const auto& [name, method] : support::all_methods()) {
        render::RenderOptions options;
        options.method = method;
        support::expect_truth(support::measure(scene_of(text + volume), options).whole(), truth, 1e-3, 0.01,
                              fmt::format("{} {} {}", what, name, curve));
      }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
