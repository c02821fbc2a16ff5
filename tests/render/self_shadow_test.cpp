// A convex body cannot shade itself: matte ground of reflectance 0.5 under a uniform sky of 1 is 0.5, from
// beads to planets. White planets in white air are invisible.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall {
namespace {

using support::expect_truth;
using support::measure;
using support::scene_of;

// Seen from eye height above its top, which is at the origin; {0} is its size.
const std::pair<std::string, std::string> shapes[] = {
    {"sphere", "sphere {{ center: (0, -{0}, 0)  radius: {0}"},
    {"box", "box {{ min: (-{0}, -{0}, -{0})  max: ({0}, 0, {0})"},
    {"cylinder's side", "cylinder {{ from: (-{0}, -{0}, 0)  to: ({0}, -{0}, 0)  radius: {0}"},
    {"cylinder's end", "cylinder {{ from: (0, -{0}, 0)  to: (0, 0, 0)  radius: {0}"},
    {"disk", "disk {{ center: (0, 0, 0)  normal: (0, 1, 0)  radius: {0}"},
    {"quad", "quad {{ center: (0, 0, 0)  u: (0, 0, {0})  v: ({0}, 0, 0)"},
    {"plane", "plane {{ point: ({0}, 0, 0)  normal: (0, 1, 0)"},
    {"mesh",
     "mesh {{ points: [(-{0}, 0, -{0}), ({0}, 0, -{0}), ({0}, 0, {0}), (-{0}, 0, {0})]  triangles: [(2, 1, "
     "0), "
     "(3, 2, 0)]"},
    {"curve", "curves {{ points: [(-{0}, -{0}, 0), ({0}, -{0}, 0)]  radius: {0}"},
};

scene::Scene seen_from_eye_height(double size, const std::string& things) {
  const double height = std::min(1.7, 0.3 * size);
  const double away = size > 100 ? 2 * height : 0.5 * height;  // from where small ones fill the picture
  return scene_of(fmt::format("render {{ resolution: (2, 2)  samples: 8 }}\n"
                              "light environment {{ radiance: 1 }}\n"
                              "camera perspective {{ from: (0, {0}, {1})  to: (0, 0, 0)  fov: 10deg }}\n"
                              "animation {{ fps: 1  frames: 0..1  shutter: 180deg }}\n"
                              "material ground() {{ base_color = 0.5 }}\n",
                              height, away) +
                  things);
}

void expect_half(const std::string& what, double size, const std::string& things) {
  expect_truth(measure(seen_from_eye_height(size, things)).whole(), 0.5, 1e-6, 0.02,
               fmt::format("{} of {} m", what, size));
}

constexpr double sizes[] = {1e-6, 1e-2, 1e3, 6.371e6, 1e7};

TEST(SelfShadow, NoneOnConvexShapes) {
  for (const auto& [name, shape] : shapes)
    for (const double size : sizes)
      expect_half(name, size, fmt::format(fmt::runtime(shape), size) + "  material: ground }");
}

TEST(SelfShadow, NoneWhenPlacedByTransforms) {
  for (const auto& [name, shape] : shapes)
    for (const double size : {1e-6, 6.371e6}) {
      const std::string one = fmt::format(fmt::runtime(shape), 1.0);
      expect_half(name + ", scaled", size,
                  one + fmt::format("  material: ground  transform: scale({}) }}", size));
      expect_half(name + ", in an object", size,
                  "object thing { group { transform: rotate_y(30deg)  " + one + " } } }" +
                      fmt::format("place thing {{ material: ground  transform: scale({}) }}", size));
      expect_half(
          name + ", moving", size,
          fmt::format(fmt::runtime(shape), size) +
              fmt::format("  material: ground  transform: keys(time, [0s, translate((0, 0, 0))], [1s, "
                          "translate(({}, 0, 0))]) }}",
                          0.01 * size));
    }
}

TEST(SelfShadow, WhitePlanetsInWhiteAirAreInvisible) {
  for (const double radius : {1e-3, 1.0, 6.371e6}) {
    const std::string planet = fmt::format(
        "sphere {{ center: (0, -{0}, 0)  radius: {0}  material: {{ base_color = 1 }} }}\n"
        "volume {{ in: sphere {{ center: (0, -{0}, 0)  radius: 1.02 * {0} }}  medium: {{ scattering = 20 / "
        "{0}  "
        "absorption = 0 }} }}",
        radius);
    expect_truth(measure(seen_from_eye_height(radius, planet)).whole(), 1, 1e-6, 0.03, planet);
  }
}

}  // namespace
}  // namespace tyndall
