// The shutter: when it is open about the time of its frame, and how much light comes from which moment.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/sampler.h"
#include "render/context/sample_dimensions.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using scene::ShutterCurve, scene::TrapezoidCurve;
using support::scene_of;

const std::vector<ShutterCurve> curves{
    {},
    {TrapezoidCurve{}},
    {TrapezoidCurve{0.2, 0.3}},
    {TrapezoidCurve{0, 0.6}},
    {TrapezoidCurve{0.4, 0}},
    {TrapezoidCurve{0.5, 0.5}},
    {TrapezoidCurve{0, 1}},
    {TrapezoidCurve{1, 0}},
    {TrapezoidCurve{0, 0}},
};

// The integral of a curve, by 4000 midpoints.
double weight(const ShutterCurve& curve, double from, double to) {
  constexpr int steps = 4000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += curve.density(from + (to - from) * (i + 0.5) / steps);
  return sum * (to - from) / steps;
}

TEST(ShutterCurve, IsADensityWhoseIntegralMomentsInvert) {
  for (const ShutterCurve& curve : curves) {
    EXPECT_NEAR(weight(curve, 0, 1), 1, 1e-6) << describe(curve);
    for (const double u : {0.0, 0.003, 0.1, 0.37, 0.5, 0.81, 0.99, 1 - 1e-9}) {
      const double moment = curve.moment(u);
      EXPECT_GE(moment, 0) << describe(curve) << u;
      EXPECT_LE(moment, 1) << describe(curve) << u;
      EXPECT_NEAR(weight(curve, 0, moment), u, 1e-5) << describe(curve) << u;
    }
  }
}

// Pearson's χ² of the times of a picture's paths over 40 parts of equal length, of which those of no weight
// get none. Times are stratified: what they are off by is far below what independent ones would be, and so
// the bound is that of independent ones at a significance of 0.001.
TEST(ShutterCurve, TimesArePathsOfItsDensity) {
  constexpr int parts = 40, pixels = 64, samples = 64;
  for (const ShutterCurve& curve : curves) {
    std::array<double, parts> drawn{};
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
      for (std::uint32_t sample = 0; sample < samples; ++sample) {
        const Sampler sampler(7, 0, pixel, 3, sample);
        const PathNumbers numbers{&sampler};
        const double moment = curve.moment(numbers.point(Decision::time)[0]);
        ++drawn[std::min(static_cast<std::size_t>(moment * parts), std::size_t{parts - 1})];
      }
    double chi_squared = 0;
    for (int k = 0; k < parts; ++k) {
      const double wanted = pixels * samples * weight(curve, k / double{parts}, (k + 1) / double{parts});
      const double off = drawn[static_cast<std::size_t>(k)] - wanted;
      ASSERT_GT(wanted, 0);
      chi_squared += off * off / wanted;
    }
    EXPECT_LT(chi_squared, 72.1) << describe(curve);  // 39 degrees of freedom
  }
}

// What flashes in a part of the time is as bright as the curve's weight there.
TEST(Shutter, AFlashHasTheWeightOfItsMoment) {
  for (const auto& [from, to] : {std::pair{0.0, 0.05}, {0.1, 0.15}, {0.45, 0.55}, {0.8, 0.9}})
    for (const ShutterCurve& curve : {curves[0], curves[2], curves[5]}) {
      // Open from -0.25 s to 0.75 s about the time of frame 3.
      const scene::Scene scene = scene_of(
          fmt::format("animation {{ fps: 1  frames: 3..3  shutter: (-90deg, 270deg)  shutter_curve: {} }}\n"
                      "let since = time - 2.75\nlet from = {}\nlet to = {}\n",
                      describe(curve), from, to) +
          R"(
render { resolution: (8, 8)  samples: 64 }
camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1 }
quad {
  center: (0, 0, 0)  u: (1, 0, 0)  v: (0, 1, 0)
  material: { base_color = 0  emission = if since > from and since < to then 1 else 0 }
}
)");
      support::expect_truth(support::measure(scene).whole(), weight(curve, from, to), 2e-4, 0.08,
                            fmt::format("{} from {} to {}", describe(curve), from, to));
    }
}

// An open shutter's time is that of its frame from when it opens to when it closes.
TEST(Shutter, IsOpenAboutTheTimeOfItsFrame) {
  struct Case {
    const char* shutter;
    double opens, seconds;
  };
  for (const Case& c : {Case{"180deg", 3, 0.25},
                        {"0.1s", 3, 0.1},
                        {"(-90deg, 90deg)", 2.875, 0.25},
                        {"(-180deg, 0deg)", 2.75, 0.25},
                        {"(-50ms, 0.1s)", 2.95, 0.15},
                        {"(-360deg, 0deg)", 2.5, 0.5},
                        {"(90deg, 0.3s)", 3.125, 0.175},
                        {"0deg", 3, 0},
                        {"(72deg, 72deg)", 3.1, 0}}) {
    const scene::Scene s =
        scene_of(fmt::format("animation {{ fps: 2  frames: 6..6  shutter: {} }}\n"
                             "camera perspective {{ from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }}\nsphere {{ "
                             "center: (time, 0, 0) }}",
                             c.shutter));
    EXPECT_NEAR(s.time, c.opens, 1e-12) << c.shutter;
    EXPECT_NEAR(scene::shutter_seconds(s.animation), c.seconds, 1e-12) << c.shutter;
    EXPECT_NEAR(std::get<scene::Sphere>(s.shapes[0].shape).center.x, c.opens, 1e-12) << c.shutter;
    ASSERT_EQ(s.motion.shapes.size(), c.seconds > 0 ? 1u : 0u) << c.shutter;
    if (c.seconds > 0) {
      EXPECT_NEAR(std::get<scene::Sphere>(scene::at(s.motion.shapes[0], 1).shape).center.x,
                  c.opens + c.seconds, 1e-12)
          << c.shutter;
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
