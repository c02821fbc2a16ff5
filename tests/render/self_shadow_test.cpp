// A convex body cannot shade itself: matte ground of reflectance 0.5 under a uniform sky of 1 is 0.5, from
// beads to planets. White planets in white air are invisible.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall {
namespace UNNAMED {

using support::expect_truth;
using support::filled;
using support::measure;
using support::scene_of;

// Seen from eye height above its top, which is at the origin.
const std::pair<std::string, std::string> shapes[] = {
    {"sphere", "sphere { center: (0, -$SIZE, 0)  radius: $SIZE  $MORE }"},
    {"box", "box { min: (-$SIZE, -$SIZE, -$SIZE)  max: ($SIZE, 0, $SIZE)  $MORE }"},
    {"cylinder's side",
     "cylinder { from: (-$SIZE, -$SIZE, 0)  to: ($SIZE, -$SIZE, 0)  radius: $SIZE  $MORE }"},
    {"cylinder's end", "cylinder { from: (0, -$SIZE, 0)  to: (0, 0, 0)  radius: $SIZE  $MORE }"},
    {"part of a cone's side",
     "cone { from: (-$SIZE, -$SIZE, 0)  to: ($SIZE, -$SIZE, 0)  radius: $SIZE  tip_radius: $SIZE  $MORE }"},
    {"cone's base", "cone { from: (0, 0, 0)  to: (0, -$SIZE, 0)  radius: $SIZE  $MORE }"},
    {"torus' outside",
     "torus { center: (0, -1.5 * $SIZE, 0)  normal: (1, 0, 0)  radius: $SIZE  tube: 0.5 * $SIZE  $MORE }"},
    {"floor of a cut",
     "difference { box { min: (-$SIZE, -$SIZE, -$SIZE)  max: ($SIZE, $SIZE, $SIZE) }  box { min: (-2 * $SIZE, "
     "-$SIZE, -2 * $SIZE)  max: (2 * $SIZE, $SIZE, 2 * $SIZE)  transform: translate((0, $SIZE, 0)) }  $MORE }"},
    {"disk", "disk { center: (0, 0, 0)  normal: (0, 1, 0)  radius: $SIZE  $MORE }"},
    {"quad", "quad { center: (0, 0, 0)  u: (0, 0, $SIZE)  v: ($SIZE, 0, 0)  $MORE }"},
    {"plane", "plane { point: ($SIZE, 0, 0)  normal: (0, 1, 0)  $MORE }"},
    {"mesh", R"(
mesh {
  points: [(-$SIZE, 0, -$SIZE), ($SIZE, 0, -$SIZE), ($SIZE, 0, $SIZE), (-$SIZE, 0, $SIZE)]
  triangles: [(2, 1, 0), (3, 2, 0)]
  $MORE
}
)"},
    {"curve", "curves { points: [(-$SIZE, -$SIZE, 0), ($SIZE, -$SIZE, 0)]  radius: $SIZE  $MORE }"},
};

scene::Scene seen_from_eye_height(double size, const std::string& things) {
  const double height = std::min(1.7, 0.3 * size);
  const double away = size > 100 ? 2 * height : 0.5 * height;  // from where small ones fill the picture
  return scene_of(filled(R"(
render { resolution: (2, 2)  samples: 8 }
light environment { radiance: 1 }
camera perspective { from: (0, $HEIGHT, $AWAY)  to: (0, 0, 0)  fov: 10deg }
animation { fps: 1  frames: 0..1  shutter: 180deg }
material ground() { base_color = 0.5 }
$THINGS
)",
                         {{"HEIGHT", height}, {"AWAY", away}, {"THINGS", things}}));
}

void expect_half(const std::string& what, double size, const std::string& things) {
  expect_truth(measure(seen_from_eye_height(size, things)).whole(), 0.5, 1e-6, 0.02,
               fmt::format("{} of {} m", what, size));
}

constexpr double sizes[] = {1e-6, 1e-2, 1e3, 6.371e6, 1e7};

TEST(SelfShadow, NoneOnConvexShapes) {
  for (const auto& [name, shape] : shapes)
    for (const double size : sizes)
      expect_half(name, size, filled(shape, {{"SIZE", size}, {"MORE", "material: ground"}}));
}

TEST(SelfShadow, NoneWhenPlacedByTransforms) {
  for (const auto& [name, shape] : shapes)
    for (const double size : {1e-6, 6.371e6}) {
      const std::string scaled = filled("material: ground  transform: scale($SIZE)", {{"SIZE", size}});
      expect_half(name + ", scaled", size, filled(shape, {{"SIZE", 1}, {"MORE", scaled}}));
      expect_half(name + ", in an object", size,
                  filled(R"(
object thing {
  group { transform: rotate_y(30deg)  $SHAPE }
}
place thing { $MORE }
)",
                         {{"SHAPE", filled(shape, {{"SIZE", 1}, {"MORE", ""}})}, {"MORE", scaled}}));
      const std::string moving = filled(
          "material: ground  transform: keys(time, [0s, translate((0, 0, 0))], [1s, translate(($FAR, 0, "
          "0))])",
          {{"FAR", 0.01 * size}});
      expect_half(name + ", moving", size, filled(shape, {{"SIZE", size}, {"MORE", moving}}));
    }
}

TEST(SelfShadow, WhitePlanetsInWhiteAirAreInvisible) {
  for (const double radius : {1e-3, 1.0, 6.371e6}) {
    const std::string planet = filled(R"(
sphere { center: (0, -$RADIUS, 0)  radius: $RADIUS  material: { base_color = 1 } }
volume {
  in: sphere { center: (0, -$RADIUS, 0)  radius: 1.02 * $RADIUS }
  medium: { scattering = 20 / $RADIUS  absorption = 0 }
}
)",
                                      {{"RADIUS", radius}});
    expect_truth(measure(seen_from_eye_height(radius, planet)).whole(), 1, 1e-6, 0.03, planet);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
