// What moves while the shutter is open, and what is settled when it opens.
#include <cmath>

#include "base/numerics.h"
#include "resolved.h"
#include "vm/run/machine.h"

namespace tyndall {
namespace UNNAMED {

// The scene of a text without errors.
scene::Scene resolved(const std::string& text) {
  Resolved r = resolve_text(text);
  EXPECT_FALSE(r.diagnostics.has_errors()) << r.messages();
  return std::move(r.scene);
}

// With the shutter open from 0 s to 0.5 s.
scene::Scene moving(const std::string& things) {
  return resolved(
      "animation { fps: 1  frames: 0..1  shutter: 180deg }\n"
      "camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }\n" +
      things);
}

TEST(Motion, EvenWaysHaveTwoKeys) {
  const scene::Scene s = moving("sphere { center: (3 * time, 1, 0)  radius: 1 + time }");
  ASSERT_EQ(s.motion.shapes.size(), 1u);
  ASSERT_EQ(s.motion.shapes[0].keys.size(), 2u);
  const auto half = scene::at(s.motion.shapes[0], 0.5);
  const auto& sphere = std::get<scene::Sphere>(half.shape);
  EXPECT_NEAR(sphere.center.x, 0.75, 1e-12);
  EXPECT_NEAR(sphere.radius, 1.25, 1e-12);
  EXPECT_EQ(std::get<scene::Sphere>(s.shapes[0].shape).radius, 1);
}

// The scene of a text that has `time` at one moment, seconds after the shutter opened.
scene::Scene at_moment(std::string text, double seconds) {
  const std::string now = "(" + std::to_string(seconds) + ")";
  for (std::size_t at = text.find("time"); at != std::string::npos; at = text.find("time", at + now.size()))
    text.replace(at, 4, now);
  return moving(text);
}

// Everything turns; in one text so that it is clear that each kind of thing does.
std::string turning(int turns) {
  return fmt::format("let turns = {}\n", turns) + R"(
let turn = rotate((1, 2, 0.5), 360deg * turns * time)
sphere { center: (1, 0, 0)  transform: turn }
group { transform: turn  group { transform: translate((0, 2, 0))  box { min: (-1, -1, -1)  max: (1, 1, 1) } } }
group { transform: translate((3 * time, 0, 0)) * turn * scale((-1, 2, 0.5))  sphere {} }
sphere { transform: translate((1e5, 0, 0)) * turn * translate((-1e5, 0, 0))  center: (1e5, 0, 0) }
object bar { box { min: (0, 0, 0)  max: (1, 1, 1) }  sphere { transform: turn } }
place bar { transform: turn * translate((1, 0, 0)) }
volume { in: sphere {}  transform: turn * translate((2, 0, 0))  medium: { density = 1  albedo = 0.5 } }
light mesh { in: box { min: (0, 0, 0)  max: (1, 1, 1) }  power: 20  transform: turn }
)";
}

template <class S>
S shape_of(const scene::LightInstance& instance) {
  return std::get<S>(std::get<scene::AreaLight>(instance.light).shape);
}

// Where the far corners of what a transform moves are.
double distance_between(const Transform& a, const Transform& b, const Vec3d& near) {
  double most = 0;
  for (const Vec3d& d : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{}})
    most = std::max(most, length(a.point(near + d) - b.point(near + d)));
  return most;
}

// What turns evenly about any axis, moved along or not, mirrored or not, is exact between a few keys: no turn
// is missed and nothing shrinks.
TEST(Motion, TurnsAreExactHoweverMany) {
  for (const int turns : {1, 3, 16, 32, 100}) {
    const std::string text = turning(turns);
    const scene::Scene s = moving(text);
    ASSERT_EQ(s.motion.shapes.size(), 4u);
    ASSERT_EQ(s.motion.instances.size(), 1u);
    ASSERT_EQ(s.motion.volumes.size(), 1u);
    ASSERT_EQ(s.motion.lights.size(), 1u);
    ASSERT_EQ(s.prototypes.at(0).moving_shapes.size(), 1u);
    for (const auto& shape : s.motion.shapes) {
      EXPECT_LE(shape.keys.size(), 30u + 30u * static_cast<unsigned>(turns));
      EXPECT_GE(shape.keys.size(), static_cast<unsigned>(turns));  // half a second: two a turn
    }
    for (const double fraction : {0.013, 0.1, 0.27, 0.5, 0.77, 0.999}) {
      const scene::Scene now = at_moment(text, 0.5 * fraction);
      const double enough = 1e-9, far_away = 1e-5;
      for (const auto& shape : s.motion.shapes) {
        const bool far = shape.index == 3;
        EXPECT_LE(distance_between(scene::at(shape, fraction).world_from_object,
                                   now.shapes[shape.index].world_from_object, {far ? 1e5 : 0, 0, 0}),
                  far ? far_away : enough)
            << turns << ' ' << shape.index;
      }
      EXPECT_LE(distance_between(scene::at(s.motion.instances[0], fraction).world_from_object,
                                 now.instances[0].world_from_object, {}),
                enough);
      const scene::Volume volume = scene::at(s.motion.volumes[0], fraction);
      EXPECT_LE(distance_between(volume.world_from_shape, now.volumes[0].world_from_shape, {}), enough);
      EXPECT_LE(distance_between(volume.world_from_medium, now.volumes[0].world_from_medium, {}), enough);
      EXPECT_LE(
          distance_between(
              *std::get<scene::AreaLight>(scene::at(s.motion.lights[0], fraction).light).world_from_shape,
              *std::get<scene::AreaLight>(now.lights[0].light).world_from_shape, {}),
          enough);
    }
  }
}

// Ways of numbers and points have as many keys as hold the error that the manual states.
TEST(Motion, NumbersGoTheirWaysToAFourThousandth) {
  const std::string text =
      R"(
light point { position: rotate_y((3, 1, 0), 1000deg * time)  power: 10 + 5 * sin(20 * time) }
light quad {
  center: (0, 2, 0)
  u: rotate_y((1, 0, 0), 700deg * time)
  v: rotate_y((0, 0, 1), 700deg * time)
  power: 3
}
sphere { center: (1e3 + 2 * time * time, 0, 0)  radius: 1 + 0.5 * sin(30 * time) }
sphere { center: (floor(8 * time), 0, 4)  radius: 1 }
)";
  const scene::Scene s = moving(text);
  ASSERT_EQ(s.motion.lights.size(), 2u);
  ASSERT_EQ(s.motion.shapes.size(), 2u);
  for (int i = 1; i < 40; ++i) {
    const double fraction = i / 40.3;
    const scene::Scene now = at_moment(text, 0.5 * fraction);
    const auto point = std::get<scene::PointLight>(scene::at(s.motion.lights[0], fraction).light),
               real = std::get<scene::PointLight>(now.lights[0].light);
    EXPECT_LE(length(point.position - real.position), 1.8 * 6 / 4000);
    EXPECT_NEAR(point.power->x, real.power->x, 10.0 / 4000 + 1e-5);
    const auto quad = shape_of<scene::Quad>(scene::at(s.motion.lights[1], fraction)),
               real_quad = shape_of<scene::Quad>(now.lights[1]);
    EXPECT_LE(length(quad.u - real_quad.u), 1.8 * 2 / 4000);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto sphere = std::get<scene::Sphere>(scene::at(s.motion.shapes[k], fraction).shape),
                 real_sphere = std::get<scene::Sphere>(now.shapes[k].shape);
      EXPECT_NEAR(sphere.center.x, real_sphere.center.x, 1.0 / 4000);
      EXPECT_NEAR(sphere.radius, real_sphere.radius, 1.2 / 4000);
    }
  }
}

// As many keys as hold a tenth of a pixel, however large the picture: of what goes about in front of the
// camera, of what the camera looks from and to. Where keys need be no closer they are not.
TEST(Motion, WaysHoldATenthOfAPixel) {
  std::size_t fewest = 0;
  for (const int height : {100, 1000, 4000}) {
    const std::string text = fmt::format("render {{ resolution: ({0}, {0}) }}\n", height) + R"(
animation { fps: 1  frames: 0..1  shutter: 180deg }
camera perspective { from: (sin(3 * time), 0, 9)  to: (0, 0.2 * sin(7 * time), 0)  fov: 40deg }
sphere { center: rotate_z((3, 0, 0), 500deg * time)  radius: 0.5 }
sphere { transform: translate((sin(9 * time), 0, -time * time)) }
object ball { sphere {} }
place ball { transform: translate((0, sin(8 * time), 0)) }
light quad { center: rotate_z((2, 0, 0), 300deg * time)  u: (0.1, 0, 0)  v: (0, 0.1, 0)  power: 1 }
)";
    const auto rotated = [](double radius, double degrees) {
      return Vec3d{std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0} * radius;
    };
    const scene::Scene s = resolved(text);
    ASSERT_EQ(s.motion.shapes.size(), 2u);
    ASSERT_EQ(s.motion.lights.size(), 1u);
    ASSERT_EQ(s.motion.instances.size(), 1u);
    EXPECT_GT(s.motion.shapes[1].keys.size(), fewest);
    fewest = s.motion.shapes[1].keys.size();
    // At a distance of 9 m, less the 1 m that the balls are nearer.
    const double tenth = 0.1 * 2 * std::tan(20 * pi / 180) * 8 / height;
    for (int i = 1; i < 60; ++i) {
      const double fraction = i / 60.7, seconds = 0.5 * fraction;
      const auto ball = scene::at(s.motion.shapes[1], fraction).world_from_object,
                 placed = scene::at(s.motion.instances[0], fraction).world_from_object;
      EXPECT_LE(length(ball.t - Vec3d{std::sin(9 * seconds), 0, -seconds * seconds}), tenth) << height;
      EXPECT_LE(length(placed.t - Vec3d{0, std::sin(8 * seconds), 0}), tenth) << height;
      const auto by_center = std::get<scene::Sphere>(scene::at(s.motion.shapes[0], fraction).shape).center;
      EXPECT_LE(length(by_center - rotated(3, 500 * seconds)), 1.8 * tenth) << height;
      const auto lamp = shape_of<scene::Quad>(scene::at(s.motion.lights[0], fraction));
      EXPECT_LE(length(lamp.center - rotated(2, 300 * seconds)), 1.8 * tenth) << height;
      const auto camera = std::get<scene::PerspectiveCamera>(scene::at(s.motion.camera, fraction));
      const double seen = 0.1 * 2 * std::tan(20 * pi / 180) * 9 / height;
      EXPECT_LE(length(camera.from - Vec3d{std::sin(3 * seconds), 0, 9}), seen) << height;
      EXPECT_LE(length(camera.to - Vec3d{0, 0.2 * std::sin(7 * seconds), 0}), seen) << height;
    }
  }
}

// A camera that goes with a thing sees it as steadily as its way is long.
TEST(Motion, ACameraFollowsToAShareOfWhatItSees) {
  const scene::Scene s = resolved(R"(
animation { fps: 1  frames: 0..1  shutter: 180deg }
let at = 1e4 * (sin(4 * time), cos(4 * time), 0)
camera perspective { from: at + (0, 0, 5)  to: at  fov: 40deg }
)");
  ASSERT_FALSE(s.motion.camera.empty());
  for (int i = 1; i < 40; ++i) {
    const double seconds = 0.5 * i / 40.3;
    const auto camera = std::get<scene::PerspectiveCamera>(scene::at(s.motion.camera, i / 40.3));
    const Vec3d real = Vec3d{std::sin(4 * seconds), std::cos(4 * seconds), 0} * 1e4;
    EXPECT_LE(length(camera.to - real), 5.0 / 4000);
  }
}

TEST(Motion, WaysWithoutEndAreTold) {
  Resolved r = resolve_text(
      "animation { fps: 1  frames: 0..1  shutter: 180deg }\n"
      "camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }\n"
      "sphere { center: (sin(1e6 * time), 0, 0) }\n");
  EXPECT_TRUE(r.diagnostics.has_errors());
  EXPECT_NE(r.messages().find("turns too often or moves too unevenly while the shutter is open"),
            std::string::npos)
      << r.messages();
  EXPECT_NE(r.messages().find(":3:"), std::string::npos) << r.messages();
}

// The limit that the manual states: a thing has up to 2000 turns, a camera that goes in chords 20.
TEST(Motion, TurnsAreExactUpToTheLimitAndToldBeyond) {
  const auto told = [](double turns_of_camera, double turns_of_ball) {
    Resolved r = resolve_text(
        fmt::format("let orbit = 360deg * {}\nlet turn = 360deg * {}\n", turns_of_camera, turns_of_ball) + R"(
animation { fps: 1  frames: 0..1  shutter: 360deg }
camera perspective { from: (5 * sin(orbit * time), 0, 5 * cos(orbit * time))  to: (0, 0, 0)  fov: 40deg }
sphere { center: (1, 0, 0)  radius: 0.2  transform: rotate_y(turn * time) }
)");
    const bool is_told = r.messages().find("turns too often") != std::string::npos;
    EXPECT_EQ(r.diagnostics.has_errors(), is_told) << r.messages();
    return is_told;
  };
  EXPECT_FALSE(told(0, 1.5));
  EXPECT_FALSE(told(0, 100));
  EXPECT_FALSE(told(0, 2000));
  EXPECT_TRUE(told(0, 20000));
  EXPECT_FALSE(told(20, 0));
  EXPECT_TRUE(told(2000, 0));
}

TEST(Motion, WhatStandsStillHasNone) {
  const scene::Scene s = moving("let unused = time\nsphere { radius: 1 + 0 * unused }\nsphere { radius: 2 }");
  EXPECT_TRUE(s.motion.shapes.empty() && s.motion.camera.empty());
}

TEST(Motion, EverythingMayMove) {
  const scene::Scene s = resolved(
      "animation { fps: 1  frames: 0..1  shutter: 180deg }\n"
      "camera perspective { from: (0, time, 5)  to: (0, 0, 0)  fov: 40deg }\n"
      "light point { position: (0, 3, 0)  power: 10 + time }\n"
      "object bar { box { min: (0, 0, 0)  max: (1, 1 + time, 1) }  sphere {}\n"
      "  volume { in: sphere {}  medium: { density = 1  albedo = 0.5 } } }\n"
      "place bar { transform: translate((time, 0, 0)) }\nplace bar {}\n");
  EXPECT_EQ(s.motion.camera.keys.size(), 2u);
  EXPECT_EQ(s.motion.lights.size(), 1u);
  ASSERT_EQ(s.motion.instances.size(), 1u);
  EXPECT_EQ(s.motion.instances[0].index, 0u);
  ASSERT_EQ(s.motion.volumes.size(), 1u);
  EXPECT_EQ(s.motion.volumes[0].index, 0u);
  ASSERT_EQ(s.prototypes.size(), 1u);
  ASSERT_EQ(s.prototypes[0].moving_shapes.size(), 1u);
  EXPECT_EQ(s.prototypes[0].moving_shapes[0].index, 0u);
}

// Arguments of objects that are equal at one moment and differ at another: what is shared when the shutter
// opens is.
TEST(Motion, ArgumentsOfObjectsMayDependOnTime) {
  const scene::Scene s = moving(
      "object o(x) { sphere { radius: 1 + x } }\n"
      "place o(x: time) {}\nplace o(x: time) {}\nplace o(x: time + 0) {}\nplace o(x: [time][0]) {}\n"
      "object leaf(q) { sphere { radius: 1 + q } }\n"
      "object branch(a) { for i in 0..<3 { place leaf(q: a * i) {} } }\n"
      "place branch(a: time) {}\nplace branch(a: 2 * time) {}\n"
      "object tree(seed, sway) { sphere { center: (seed, sway, 0) } }\n"
      "for i in 0..<20 { place tree(seed: mod(i, 4), sway: 0.1 * sin(2 * time)) {} }\n");
  EXPECT_EQ(s.instances.size(), 26u);
  std::size_t moving_prototypes = 0;
  for (const scene::Prototype& p : s.prototypes) moving_prototypes += !p.moving_shapes.empty();
  EXPECT_GT(moving_prototypes, 4u);
}

// Which things there are is read when the shutter opens.
TEST(Motion, StructureIsSettledWhenTheShutterOpens) {
  const scene::Scene s = moving(
      "if time < 0.2 { sphere { center: (time, 0, 0) } } else { box { min: (0, 0, 0)  max: (1, 1, 1) } }\n"
      "for i in 0..<2 + 8 * time { sphere { center: (i, time, 3) } }\n"
      "for x in [1, 2 + time] { sphere { center: (x, 0, 4) } }\n");
  ASSERT_EQ(s.shapes.size(), 5u);
  EXPECT_TRUE(std::holds_alternative<scene::Sphere>(s.shapes[0].shape));
  EXPECT_EQ(s.motion.shapes.size(), 4u);  // all but the first of the last loop
}

TEST(Motion, AClosedShutterStopsIt) {
  const scene::Scene s = resolved(
      R"(
animation { fps: 1  frames: 0..1 }
camera perspective { from: (0, time, 5)  to: (0, 0, 0)  fov: 40deg }
let grown = 1 + time
volume { in: sphere {}  medium: { density = grown  albedo = 0.5 } }
)");
  EXPECT_TRUE(s.motion.camera.empty());
  EXPECT_FALSE(s.media[0].full.reads(vm::Input::time));  // a number
}

// In a body it is the ray's own time.
TEST(Motion, BodiesSeeFunctionsOfTime) {
  const scene::Scene s = moving(
      "let grown = 1 + time\nlet more = 2 * grown\nmedium fog(amount) { density = amount  albedo = 0.5 }\n"
      "volume { in: sphere {}  medium: { density = more  albedo = 0.5 } }\n"
      "volume { in: sphere { center: (3, 0, 0) }  medium: fog(amount: grown) }\n"
      "volume { in: sphere { center: (6, 0, 0) }  medium: fog(amount: 1) }\n");
  ASSERT_EQ(s.media.size(), 3u);  // the last two are equal when the shutter opens, not later
  for (const float time : {0.0f, 0.25f}) {
    const float expected[] = {2 + 2 * time, 1 + time, 1};
    for (std::size_t m = 0; m < 3; ++m) {
      const vm::Program& program = s.media[m].full;
      vm::BatchInputs inputs;
      inputs[vm::Input::time] = &time;
      std::vector<float> values(program.outputs.size());
      std::vector<float*> rows;
      for (float& v : values) rows.push_back(&v);
      vm::run_reference(program, inputs, 1, rows);
      EXPECT_FLOAT_EQ(values[s.media[m].sigma_t[0]], expected[m]) << m;
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
