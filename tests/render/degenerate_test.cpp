// Geometry without extent, and things in the same place: pictures are those of the scenes without the flaw.
#include <gtest/gtest.h>

#include <string>

#include "compile/compiled_scene.h"
#include "render/render.h"
#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using support::expect_same;
using support::measure;
using support::scene_of;

const std::string frame = R"(
render { resolution: (8, 8)  samples: 32  bounces: 3 }
camera perspective { from: (0, 1, 5)  to: (0, 0, 0)  fov: 40deg }
light sphere { center: (1, 3, 2)  radius: 0.3  power: 300 }
light environment { radiance: 0.3 }
)";

Film film_of(const std::string& things) {
  RenderResult result = render(compile::compile(scene_of(frame + things)), {});
  EXPECT_EQ(result.statistics.bad_samples, 0u);
  return std::move(result.film);
}

// To rounding, by the same random numbers.
void expect_equal(const std::string& a, const std::string& b) {
  const Film first = film_of(a), second = film_of(b);
  for (int y = 0; y < first.height(); ++y)
    for (int x = 0; x < first.width(); ++x) {
      const float p = luminance(first.mean(x, y)), q = luminance(second.mean(x, y));
      EXPECT_GT(q, 0);
      EXPECT_NEAR(p, q, 1e-4f * q);
    }
}

// A point, a line, and three points on a line.
TEST(Degenerate, TrianglesWithoutAreaAreNotThere) {
  const std::string sound = R"(
let faces = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
)",
                    flawed = R"(
let faces = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0), (0, 0, 0), (1, 2, 1), (0, 0, 3)]
)",
                    solid = R"(
mesh { points: [(-1, -1, -1), (1, -1, -1), (0, -1, 1), (0, 1, 0)]  triangles: faces }
)",
                    fog = R"(
volume {
  in: mesh { points: [(-1, -1, -1), (1, -1, -1), (0, -1, 1), (0, 1, 0)]  triangles: faces }
  medium: { density = 2  albedo = 0.9 }
}
)";
  expect_equal(flawed + solid, sound + solid);
  expect_equal(flawed + fog, sound + fog);
}

// Of two surfaces in one place the earlier is seen, and no light leaks in between.
TEST(Coincident, SurfacesAreOne) {
  const std::string quad =
      "quad { center: (0, 0, 0)  u: (1, 0, 0)  v: (0, 0, -1)  material: { base_color = 0.5 } }";
  expect_equal(quad + quad, quad);
  const std::string ball = "sphere { radius: 0.8  material: { base_color = 0.5 } }";
  expect_equal(ball + ball, ball);
}

std::string fog_in(const std::string& lowest, const std::string& highest) {
  return support::filled(
      "volume { in: box { min: $MIN  max: $MAX }  medium: { density = 0.7  albedo = 0.9 } }\n",
      {{"MIN", lowest}, {"MAX", highest}});
}

// Volumes side by side are one: nothing is lost or counted twice at the face between them.
TEST(Coincident, VolumesThatTouchAreOne) {
  const support::Estimate parts = measure(scene_of(frame + fog_in("(-1, -1, -1)", "(0, 1, 1)") +
                                                   fog_in("(0, -1, -1)", "(1, 1, 1)")))
                                      .whole(),
                          whole = measure(scene_of(frame + fog_in("(-1, -1, -1)", "(1, 1, 1)"))).whole();
  expect_same(parts, whole, 0, 0.01, "two halves against a whole");
}

// A volume that begins and ends on surfaces, as fog that stands on the ground between two walls does.
TEST(Coincident, BoundariesOnSurfacesLeakNothing) {
  const std::string room =
      "plane { point: (0, -1, 0)  normal: (0, 1, 0) }\n"
      "box { min: (-1.4, -1, -1)  max: (-1, 1, 1) }\n"
      "box { min: (1, -1, -1)  max: (1.4, 1, 1) }\n";
  const support::Estimate touching =
                              measure(scene_of(frame + room + fog_in("(-1, -1, -1)", "(1, 1, 1)"))).whole(),
                          within = measure(scene_of(frame + room + fog_in("(-1.1, -1.1, -1)", "(1.1, 1, 1)")))
                                       .whole();
  expect_same(touching, within, 0, 0.01, "fog up to the walls against fog that reaches into them");
}

}  // namespace UNNAMED
}  // namespace tyndall::render
