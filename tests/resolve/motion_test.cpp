// What moves while the shutter is open, and what is settled when it opens.
#include "resolved.h"
#include "vm/machine.h"

namespace tyndall {
namespace {

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
  const auto half = scene::at(s.motion.shapes[0].keys, 0.5);
  const auto& sphere = std::get<scene::Sphere>(half.shape);
  EXPECT_NEAR(sphere.center.x, 0.75, 1e-12);
  EXPECT_NEAR(sphere.radius, 1.25, 1e-12);
  EXPECT_EQ(std::get<scene::Sphere>(s.shapes[0].shape).radius, 1);
}

// Also where a whole turn ends as it began.
TEST(Motion, TurnsHaveMany) {
  for (const char* turn : {"90deg", "720deg"}) {
    const scene::Scene s = moving("group { transform: rotate_y(" + std::string(turn) +
                                  " * time)  sphere { center: (1, 0, 0) } }");
    ASSERT_EQ(s.motion.shapes.size(), 1u);
    EXPECT_EQ(s.motion.shapes[0].keys.size(), 33u);
    for (int i = 0; i <= 64; ++i) {
      const Transform t = scene::at(s.motion.shapes[0].keys, i / 64.0).world_from_object;
      EXPECT_NEAR(length(t.vector({1, 0, 0})), 1, 0.005);
    }
  }
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
  EXPECT_EQ(s.motion.camera.size(), 2u);
  EXPECT_EQ(s.motion.lights.size(), 1u);
  ASSERT_EQ(s.motion.instances.size(), 1u);
  EXPECT_EQ(s.motion.instances[0].index, 0u);
  ASSERT_EQ(s.motion.volumes.size(), 1u);
  EXPECT_EQ(s.motion.volumes[0].index, 0u);
  ASSERT_EQ(s.prototypes.size(), 1u);
  ASSERT_EQ(s.prototypes[0].moving_shapes.size(), 1u);
  EXPECT_EQ(s.prototypes[0].moving_shapes[0].index, 0u);
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
      "animation { fps: 1  frames: 0..1 }\ncamera perspective { from: (0, time, 5)  to: (0, 0, 0)  fov: "
      "40deg }\n"
      "let grown = 1 + time\nvolume { in: sphere {}  medium: { density = grown  albedo = 0.5 } }\n");
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

}  // namespace
}  // namespace tyndall
