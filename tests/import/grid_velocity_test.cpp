// Grids that are carried along by another grid of their file while the shutter is open.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "fixtures.h"
#include "grid_scenes.h"
#include "support/filled.h"
#include "support/measure.h"
#include "support/test_folder.h"
#include "support/ways.h"
#include "vm/run/machine.h"

namespace tyndall::import {
namespace UNNAMED {

FixtureGrid flow_of(double first_component) {
  FixtureGrid flow;
  flow.name = "v";
  flow.type = GridType::vec3s;
  flow.value = [=](int, int, int) { return first_component; };  // (v, v + 1, v + 2)
  return flow;
}

// What the medium's extinction is at a place and time.
float extinction_at(const scene::Medium& medium, const std::array<float, 3>& p, float time) {
  vm::BatchInputs inputs;
  inputs[vm::Input::p_x] = &p[0];
  inputs[vm::Input::p_y] = &p[1];
  inputs[vm::Input::p_z] = &p[2];
  inputs[vm::Input::time] = &time;
  std::vector<float> outputs(medium.extinction.outputs.size());
  std::vector<float*> rows;
  for (float& output : outputs) rows.push_back(&output);
  vm::Machine().run(medium.extinction, inputs, 1, rows);
  return outputs[medium.extinction_sigma_t[0]];
}

const std::string open_shutter = "animation { fps: 10  frames: 4..4  shutter: 360deg }\n";

TEST(GridVelocity, CarriesWhatWasStoredWhenTheShutterOpened) {
  FixtureGrid density;
  density.value = [](int x, int, int) { return 100 + x; };
  write_vdb((test_folder() / "flow.vdb").string(), {density, flow_of(2)});
  const scene::Scene scene = clean(open_shutter + R"(
let smoke = grid("flow.vdb", velocity: "v")
volume { medium: { density = smoke(p)  albedo = 0.5 } })");
  for (const float time : {0.4f, 0.45f, 0.5f})
    EXPECT_NEAR(extinction_at(scene.media.at(0), {8, 4, 10}, time), 108 - 2 * (time - 0.4f), 1e-2);
  // The volume holds all that comes by: a tenth of a second at (2, 3, 4), where nothing flows away from 0.
  const auto& box = std::get<scene::Box>(scene.volumes.at(0).shape);
  const Vec3d low = scene.volumes[0].world_from_shape.point(box.min),
              high = scene.volumes[0].world_from_shape.point(box.max);
  EXPECT_NEAR(low.x, -4, 1e-6);
  EXPECT_NEAR(high.x, 21.2, 1e-3);
  EXPECT_NEAR(high.y, 10.3, 1e-3);
  EXPECT_NEAR(high.z, 18.4, 1e-3);
}

TEST(GridVelocity, CostsNothingWhileTheShutterIsClosed) {
  FixtureGrid density;
  write_vdb((test_folder() / "closed.vdb").string(), {density, flow_of(2)});
  const std::string volume = "volume { medium: { density = max(0, smoke(p))  albedo = 0.5 } }";
  for (const std::string animation : {"", "animation { fps: 10  frames: 4..4 }\n"}) {
    const scene::Scene with = clean(animation + R"(let smoke = grid("closed.vdb", velocity: "v") )" + volume);
    const scene::Scene without = clean(animation + R"(let smoke = grid("closed.vdb") )" + volume);
    EXPECT_EQ(vm::print(with.media.at(0).full), vm::print(without.media.at(0).full));
    EXPECT_EQ(with.media[0].full.tables.voxels.size(), 1u);
  }
}

// In scene code it moves what reads it.
TEST(GridVelocity, MovesThingsToo) {
  FixtureGrid density;
  density.value = [](int x, int, int) { return 100 + x; };
  write_vdb((test_folder() / "moves.vdb").string(), {density, flow_of(2)});
  const scene::Scene scene = clean(open_shutter + R"(
let smoke = grid("moves.vdb", velocity: "v")
sphere { transform: translate((smoke((8, 4, 10)) - 108, 0, 0)) })");
  ASSERT_EQ(scene.motion.shapes.size(), 1u);
  EXPECT_NEAR(scene.motion.shapes[0].keys.front().world_from_object.t.x, 0, 1e-3);
  EXPECT_NEAR(scene.motion.shapes[0].keys.back().world_from_object.t.x, -0.2, 1e-3);
}

TEST(GridVelocity, CutsWhatIsFarBeyondTheOthers) {
  FixtureGrid density, flow = flow_of(0);
  flow.value = [](int x, int y, int z) { return x == 3 && y == 4 && z == 8 ? 5e4 : 1; };
  write_vdb((test_folder() / "fast.vdb").string(), {density, flow});
  const std::string volume =
      " volume { in: bounds(smoke)  medium: { density = max(0, smoke(p))  albedo = 0.5 } }";
  const Resolved told =
      resolved(camera + open_shutter + R"(let smoke = grid("fast.vdb", velocity: "v"))" + volume);
  EXPECT_FALSE(told.diagnostics.has_errors()) << told.messages();
  EXPECT_NE(told.messages().find("grid 'v' has 1 velocity far beyond the others, up to 8.66e+04 m/s"),
            std::string::npos)
      << told.messages();
  const auto fastest = [](const scene::Scene& scene) {
    float most = 0;
    for (const VoxelsPointer& voxels : scene.media.at(0).full.tables.voxels)
      if (voxels->name.find(" v.") != std::string::npos)
        most = std::max(most, voxels->levels.back().ranges[0].hi);
    return most;
  };
  // (1, 2, 3) is usual, and eight times that is not.
  EXPECT_LT(fastest(told.scene), 40);
  EXPECT_GT(fastest(told.scene), 3);
  // What is asked for is not told.
  const scene::Scene limited =
      clean(open_shutter + R"(let smoke = grid("fast.vdb", velocity: "v", max_speed: 100))" + volume);
  EXPECT_NEAR(fastest(limited), 100 / std::sqrt(3.0), 0.02);
  const scene::Scene all =
      clean(open_shutter + R"(let smoke = grid("fast.vdb", velocity: "v", max_speed: 1e6))" + volume);
  EXPECT_NEAR(fastest(all), 50002, 2);
}

TEST(GridVelocity, TellsWhatIsWrong) {
  FixtureGrid density;
  write_vdb((test_folder() / "wrong.vdb").string(), {density, flow_of(2)});
  expect_message(R"(let d = grid("wrong.vdb", velocity: "u"))", "'wrong.vdb' has no grid 'u'");
  expect_message(R"(let d = grid("wrong.vdb", velocity: "density"))", "velocities are vecs");
  expect_message(R"(let d = grid("wrong.vdb", velocity: ""))", "'velocity' is the name of a grid");
  expect_message(R"(let d = grid("wrong.vdb", max_speed: 4))", "'max_speed' limits velocities");
  expect_message(R"(let d = grid("wrong.vdb", velocity: "v", max_speed: 0))", "'max_speed' must be > 0");
}

// A ball in a wind that blows the same everywhere blurs as one that is moved by a transform.
TEST(GridVelocity, RendersLikeATransform) {
  FixtureGrid ball, wind = flow_of(-1);  // (-1, 0, 1)
  const double voxel = 0.05;
  ball.local_from_index = Transform::scale({voxel, voxel, voxel});
  ball.first = {-14, -14, -14};
  ball.last = {14, 14, 14};
  ball.value = [=](int x, int y, int z) {
    return 8 * std::max(0.0, 1 - (x * x + y * y + z * z) * voxel * voxel / 0.36);
  };
  wind.local_from_index = Transform::scale({0.5, 0.5, 0.5});
  wind.first = {-6, -6, -6};
  wind.last = {6, 6, 6};
  write_vdb((test_folder() / "wind.vdb").string(), {ball, wind});
  for (const char* shutter : {"360deg", "(-270deg, 90deg)"}) {
    const scene::Scene carried = clean(support::filled(R"(
animation { fps: 1  frames: 0..0  shutter: $SHUTTER }
let ball = grid("wind.vdb", velocity: "v")
volume {
  in: bounds(ball)
  medium: { density = ball(p)  albedo = (0.9, 0.7, 0.3)  phase = hg(0.4) }
}
)",
                                                       {{"SHUTTER", shutter}}));
    const scene::Scene moved = clean(support::filled(R"(
animation { fps: 1  frames: 0..0  shutter: $SHUTTER }
let ball = grid("wind.vdb")
volume {
  in: bounds(ball)
  medium: { density = ball(p)  albedo = (0.9, 0.7, 0.3)  phase = hg(0.4) }
  transform: translate((-1, 0, 1) * time)
}
)",
                                                     {{"SHUTTER", shutter}}));
    const support::Measurement b = support::measure(moved);
    for (const auto& [name, method] : support::all_methods()) {
      // One method will do for another shutter.
      if (shutter != std::string_view("360deg") && method != render::Method::decoupled) continue;
      render::RenderOptions options;
      options.method = method;
      const support::Measurement a = support::measure(carried, options);
      for (int half = 0; half < 2; ++half)
        support::expect_same(a.region(4 * half, 0, 4 * half + 4, 8), b.region(4 * half, 0, 4 * half + 4, 8),
                             2e-3, 0.02, fmt::format("{} {}", name, shutter));
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::import
