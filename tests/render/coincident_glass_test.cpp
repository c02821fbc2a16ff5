// Boundaries in one place: clear glass in a uniform sky of 1 is invisible however its bodies lie in each
// other, and each of many sheets in one plane takes its share.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall {
namespace UNNAMED {

using support::expect_truth;
using support::filled;
using support::measure;
using support::scene_of;

const std::string white_room = R"(
render { resolution: (8, 8)  samples: 4 }
light environment { radiance: 1 }
material glass() { base_color = 1  transmission = 1 }
material water() { base_color = 1  transmission = 1  ior = 1.33 }
medium milk() { scattering = 2  absorption = 0 }
object ball { sphere { material: glass } }
object panes {
  box { min: (-1, -1, -1)  max: (1, -0.9, 1) }
  box { min: (-1, -1, -1)  max: (-0.9, 1, 1) }
  box { min: (0.9, -1, -1)  max: (1, 1, 1) }
  box { min: (-1, -1, -1)  max: (1, 1, -0.9) }
  box { min: (-1, -1, 0.9)  max: (1, 1, 1) }
}
)";
const std::string tank = "place panes { material: glass }\n";
const std::string box = "box { min: (-1, -1, -1)  max: (1, 1, 1)  material: glass }\n";

// The statement moved.
std::string moved(const std::string& statement, const std::string& transform) {
  return filled(R"(
group {
  transform: $TRANSFORM
  $STATEMENT
}
)",
                {{"TRANSFORM", transform}, {"STATEMENT", statement}});
}
std::string in_object(const std::string& statements) {
  return filled(R"(
object thing {
  $STATEMENTS
}
place thing {}
)",
                {{"STATEMENTS", statements}});
}

scene::Scene room_with(const std::string& things, double size) {
  const std::string camera =
      "camera orthographic { from: $SIZE * (1, 2, 10)  to: (0, 0, 0)  height: 2.6 * $SIZE }\n";
  return scene_of(white_room + filled(camera, {{"SIZE", size}}) + things);
}

// Where nothing but glass is, every single path brings 1.
void expect_invisible(const std::string& things, double size = 1) {
  const auto result = render::render(compile::compile(room_with(things, size)), {});
  for (int y = 0; y < result.film.height(); ++y)
    for (int x = 0; x < result.film.width(); ++x)
      EXPECT_NEAR(result.film.mean(x, y).x, 1, 1e-4) << x << ", " << y << ": " << things;
}

TEST(CoincidentGlass, BodiesInOnePlace) {
  for (const char* transform :
       {"translate((0, 0, 0))", "rotate_y(30deg)", "rotate((1, 2, 3), 40deg) * scale((1, 0.7, 1.2))"}) {
    const std::string one = moved(box, transform);
    expect_invisible(one + one);
    expect_invisible(one + one + one);
  }
  expect_invisible("sphere { material: glass } sphere { material: glass }");
  expect_invisible("sphere { material: glass } sphere { material: water }");
  expect_invisible("sphere { material: water  priority: 1 } sphere { material: glass }");
  expect_invisible(R"(
cylinder { from: (0, -1, 0)  to: (0, 1, 0)  radius: 0.8  material: glass }
cylinder { from: (0, -1, 0)  to: (0, 1, 0)  radius: 0.8  material: water }
)");
}

// The same place by other numbers: equal but for rounding.
TEST(CoincidentGlass, BodiesInOnePlaceToRounding) {
  expect_invisible(
      moved(box, "rotate_y(30deg)") +
      moved(box, "rotate_y(10deg) * rotate_y(20deg) * translate((0.1, 0, 0)) * translate((-0.1, 0, 0))"));
  expect_invisible(R"(
sphere { material: glass }
sphere {
  center: (3, 3, 3)
  radius: 3
  material: water
  transform: scale(1 / 3) * translate((-3, -3, -3))
}
)");
  const std::string cube = R"(
mesh {
  points: [
    (-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)
  ]
  triangles: [
    (0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7), (0, 1, 5), (0, 5, 4), (3, 7, 6), (3, 6, 2), (0, 4, 7),
    (0, 7, 3), (1, 2, 6), (1, 6, 5)
  ]
  material: glass
}
)";
  expect_invisible(moved(cube, "rotate_x(20deg)") + moved(box, "rotate_x(20deg)"));
}

// Faces in one plane, corners that overlap, water up to the walls.
TEST(CoincidentGlass, TanksOfPanes) {
  expect_invisible(tank);
  expect_invisible(tank + "box { min: (-0.9, -0.9, -0.9)  max: (0.9, 0.5, 0.9)  material: water }");
  expect_invisible(tank + "box { min: (-1, -1, -1)  max: (1, 0.5, 1)  material: water  priority: -1 }");
  for (const double size : {1e-6, 1e6})
    expect_invisible(
        filled("place panes { material: glass  transform: rotate((1, 1, 0), 20deg) * scale($SIZE) }",
               {{"SIZE", size}}),
        size);
}

// Crossed for themselves they would hide the face's refraction, and radiance would be off by n².
TEST(CoincidentGlass, ThinPanesInAFace) {
  for (const char* pane :
       {"quad { center: (0, 0, 1)  u: (0.5, 0, 0)  v: (0, 0.5, 0)  material: glass }",
        "quad { center: (0, 0, 1)  u: (1, 0, 0)  v: (0, 1, 0)  material: water }",
        "quad { center: (0, 0, -1)  u: (0.5, 0, 0)  v: (0, 0.5, 0)  material: glass }",
        "disk { center: (0, 1, 0)  normal: (0, 1, 0)  radius: 0.7  material: glass }",
        "mesh { points: [(-1, -1, 1), (1, -1, 1), (0, 1, 1)]  triangles: [(0, 1, 2)]  material: glass }"}) {
    expect_invisible(box + pane);
    expect_invisible(pane + ("\n" + box));
  }
  expect_invisible(box + R"(
box { min: (-1, -1, 1)  max: (1, 1, 3)  material: glass }
quad { center: (0, 0, 1)  u: (0.5, 0, 0)  v: (0, 0.5, 0)  material: glass }
)");
}

TEST(CoincidentGlass, ObjectsPlacedTwice) {
  expect_invisible("place ball {} place ball {}");
  expect_invisible("place ball {} sphere { material: water }");
  expect_invisible(tank + tank);
  expect_invisible(
      "object two { place ball {} place ball { transform: translate((0.5, 0, 0)) } }\n"
      "place two {} place two { transform: rotate_y(180deg) }");
}

TEST(CoincidentGlass, WhileTheyMove) {
  const std::string one =
      moved(box, "keys(time, [0s, translate((0, 0, 0))], [1s, translate((5, 0, 0)) * rotate_y(90deg)])");
  expect_invisible("animation { fps: 24  frames: 0..1  shutter: 360deg }\n" + one + one);
}

TEST(CoincidentGlass, MilkOfTheSizeOfItsGlass) {
  const auto expect_white = [](const std::string& things) {
    expect_truth(measure(room_with(things, 1)).whole(), 1, 1e-6, 0.02, things);
  };
  expect_white(R"(
sphere { material: glass  priority: 1 }
volume { in: sphere {}  medium: milk  material: water  priority: 2 }
)");
  expect_white(R"(
sphere { material: glass  priority: 2 }
volume { in: sphere {}  medium: milk  material: water  priority: 1 }
)");
  expect_white(R"(
volume { in: sphere {}  medium: milk  material: water }
volume { in: sphere {}  medium: milk  material: water }
)");
}

// Priorities count inside of placed objects: a ball hidden by a higher body around it cannot be seen, so the
// picture is that of the body alone, path by path.
TEST(GlassPriorities, CountInPlacedObjects) {
  const std::string frame = R"(
render { resolution: (12, 12)  samples: 4 }
camera perspective { from: (0, 0.5, 4)  to: (0, 0, 0)  fov: 35deg }
light environment { radiance: 0.2 }
light sphere { center: (1, 3, 1)  radius: 0.5  power: 600 }
plane { point: (0, -1.5, 0)  normal: (0, 1, 0)  material: { base_color = 0.4 } }
material glass() { base_color = (1, 0.8, 0.6)  transmission = 1 }
material diamond() { base_color = 1  transmission = 1  ior = 2.4 }
)";
  const auto picture = [&](const std::string& things) {
    return render::render(compile::compile(scene_of(frame + things)), {}).film;
  };
  const std::string outer = "sphere { material: glass  priority: 1 }\n",
                    inner = "sphere { center: (0.1, 0, 0)  radius: 0.5  material: diamond }\n",
                    // So that there are two bodies in every picture.
      aside = "sphere { center: (0, 9, 0)  radius: 0.1  material: glass }\n";
  const render::Film alone = picture(outer + aside);
  const auto expect_alone = [&](const std::string& things) {
    const render::Film film = picture(things);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(film.mean(x, y)[c], alone.mean(x, y)[c], 1e-4f * alone.mean(x, y)[c]) << things;
  };
  expect_alone(outer + inner);
  expect_alone(outer + in_object(inner));
  expect_alone(in_object(outer) + inner);
  expect_alone(moved(in_object(outer + inner), "translate((1, 0, 0)) * translate((-1, 0, 0))"));
  expect_alone(filled("object core { $INNER }\n", {{"INNER", inner}}) + in_object(outer + "place core {}\n"));
  // The one that is placed later hides one of the same priority.
  expect_alone(
      R"(
object thing { sphere { center: (0.1, 0, 0)  radius: 0.5  material: diamond }  sphere {} }
place thing { material: glass }
)");
}

// A body of the higher priority in one of its own material is not there either.
TEST(GlassPriorities, BodiesOfOneMaterialAreOne) {
  const std::string frame = R"(
render { resolution: (12, 12)  samples: 4 }
camera perspective { from: (0, 0.5, 4)  to: (0, 0, 0)  fov: 35deg }
light environment { radiance: 0.2 }
light sphere { center: (1, 3, 1)  radius: 0.5  power: 600 }
material glass() { base_color = (1, 0.8, 0.6)  transmission = 1 }
)";
  const auto picture = [&](const std::string& things) {
    return render::render(compile::compile(scene_of(frame + things)), {}).film;
  };
  const render::Film whole = picture("box { min: (-1, -1, -1)  max: (1, 1, 1)  material: glass }"),
                     halves = picture(
                         R"(
box { min: (-1, -1, -1)  max: (0, 1, 1)  material: glass  priority: 1 }
box { min: (0, -1, -1)  max: (1, 1, 1)  material: glass }
sphere { radius: 0.7  material: glass  priority: 2 }
)");
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(halves.mean(x, y)[c], whole.mean(x, y)[c], 1e-4f * whole.mean(x, y)[c]);
}

// What is opaque stops light before the glass that touches it, whichever stands first: glass on a table is as
// glass sunk into it, path by path.
TEST(CoincidentGlass, StandsOnATableWithoutAirUnderIt) {
  const std::string frame = R"(
render { resolution: (12, 12)  samples: 4 }
camera perspective { from: (0.5, 2.5, 4)  to: (0, 0.5, 0)  fov: 30deg }
light environment { radiance: 0.2 }
light sphere { center: (1, 4, 1)  radius: 0.5  power: 600 }
material glass() { base_color = (1, 0.8, 0.6)  transmission = 1 }
)";
  const auto picture = [&](const std::string& things) {
    return render::render(compile::compile(scene_of(frame + things)), {}).film;
  };
  const std::string table = "plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.6 } }\n";
  const auto block = [](double bottom) {
    return filled("box { min: (-1, $BOTTOM, -1)  max: (1, 1.2, 1)  material: glass }\n",
                  {{"BOTTOM", bottom}});
  };
  const render::Film sunk = picture(table + block(-0.1));
  const auto tilted = [](const std::string& statement) {
    return moved(statement, "rotate_x(10deg) * rotate_x(20deg) * rotate_x(-30deg)");
  };
  for (const std::string& things :
       {table + block(0), block(0) + table, tilted(block(0)) + table, tilted(table) + block(0),
        table + in_object(block(0)), table + block(0) + block(0)}) {
    const render::Film standing = picture(things);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(standing.mean(x, y)[c], sunk.mean(x, y)[c], 1e-4f * sunk.mean(x, y)[c]) << things;
  }
}

// All light is under a sheet that stops it: none comes through the glass above it, however near it lies.
TEST(CoincidentGlass, LeaksNothingThroughWhatLiesBehind) {
  for (const double gap : {-1e-6, -1e-15, 0.0, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-9, 1e-3})
    for (const int degrees : {0, 50}) {
      const std::string text = filled(R"(
let gap = $GAP
let turn = $DEGREESdeg
render { resolution: (8, 8)  samples: 16 }
camera orthographic { from: (1, 5, 2)  to: (0, 0, 0)  height: 2 }
group {
  transform: rotate((1, 2, 3), turn)
  light sphere { center: (0, -4, 0)  radius: 1  power: 100 }
  sphere { center: (0, -4, 0)  radius: 4  material: { base_color = 1  transmission = 1 } }
  sphere { center: (0, -4, 0)  radius: 4 - gap }
  box { min: (-4, 0, -4)  max: (4, 1, 4)  material: { base_color = 1  transmission = 1 } }
}
)",
                                      {{"GAP", gap}, {"DEGREES", degrees}});
      const auto result = render::render(compile::compile(scene_of(text)), {});
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_EQ(result.film.mean(x, y).x, 0) << gap;
    }
}

// Two fogs that overlap, looked through: the medium of the higher priority is there alone.
TEST(VolumePriorities, BetweenPlainVolumes) {
  const auto depth_of = [](const std::string& outer, const std::string& inner, bool placed) {
    const std::string volumes = filled(R"(
volume { in: box { min: (-1, -1, -1)  max: (1, 1, 1) }  medium: { density = 0.5  albedo = 0 }  $OUTER }
volume { in: box { min: (-1, -1, -0.5)  max: (1, 1, 0.5) }  medium: { density = 2  albedo = 0 }  $INNER }
)",
                                       {{"OUTER", outer}, {"INNER", inner}});
    const std::string frame = R"(
render { resolution: (2, 2)  samples: 4 }
light environment { radiance: 1 }
camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1 }
)";
    const auto result =
        render::render(compile::compile(scene_of(frame + (placed ? in_object(volumes) : volumes))), {});
    return -std::log(result.film.mean(0, 0).x);
  };
  struct Row {
    std::string outer, inner;
    double depth;
  };
  const Row rows[] = {{"", "", 3},
                      {"priority: 1", "priority: 1", 3},
                      {"priority: 1", "", 3},
                      {"priority: 1", "priority: 2", 2.5},
                      {"priority: 1", "priority: -2", 1}};
  for (const Row& row : rows)
    for (const bool placed : {false, true})
      EXPECT_NEAR(depth_of(row.outer, row.inner, placed), row.depth, 1e-5) << row.outer << " | " << row.inner;
}

}  // namespace UNNAMED
}  // namespace tyndall
