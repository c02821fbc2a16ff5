// Grids in scenes: what they give, what is told, and that a grid filled from a shader renders like the
// shader.
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

namespace fs = std::filesystem;

// What a `let result` is, as the messages of a wrong use show it: "found 0.5" is of no use here, so it is the
// radius of a sphere.
double number_of(const std::string& text, const std::string& expression) {
  const scene::Scene scene =
      clean(support::filled("$TEXT sphere { radius: $RADIUS }", {{"TEXT", text}, {"RADIUS", expression}}));
  if (scene.shapes.empty()) return -1;
  return std::get<scene::Sphere>(scene.shapes.at(0).shape).radius;
}

TEST(GridScenes, LookUpNumbersAndVecs) {
  FixtureGrid density, flow;
  density.value = [](int x, int y, int z) { return 100 + x + 0.5 * y - 0.25 * z; };
  density.local_from_index = Transform::translate({1, 0, 0}) * Transform::scale({0.5, 0.5, 0.5});
  flow.name = "v";
  flow.type = GridType::vec3s;
  flow.value = density.value;
  write_vdb((test_folder() / "two.vdb").string(), {density, flow});
  const std::string lets = R"(let d = grid("two.vdb") let _v = grid("two.vdb", "v"))";
  // Voxel (2, 3, 6) stands at (2, 1.5, 3); between voxels it is linear, as the values are.
  EXPECT_NEAR(number_of(lets, "d((2, 1.5, 3))"), 102, 2e-3);
  EXPECT_NEAR(number_of(lets, "d((2.25, 1.5, 3))"), 102.5, 2e-3);
  EXPECT_NEAR(number_of(lets, "d((2.2, 1.6, 3.3)) + 0 * _v((0, 0, 0)).x"), 102.35, 2e-3);
  EXPECT_NEAR(number_of(lets + " let n = grid(\"two.vdb\", filter: nearest)",
                        "n((2.2, 1.6, 3.1)) + 0 * d((0, 0, 0))"),
              102, 2e-3);
  EXPECT_NEAR(
      number_of(lets + " let c = grid(\"two.vdb\", filter: cubic)", "c((2.2, 1.6, 3.3)) + 0 * d((0, 0, 0))"),
      102.35, 2e-3);
  EXPECT_NEAR(number_of(lets, "_v((4, 3, 7)).z + 0 * d((0, 0, 0))"), 105.75, 2e-3);
  // Outside there is nothing.
  EXPECT_EQ(number_of(lets, "1 + d((200, 0, 0))"), 1);
}

TEST(GridScenes, TellWhatIsWrong) {
  FixtureGrid density, points;
  points.type = GridType::points;
  points.name = "points";
  write_vdb((test_folder() / "some.vdb").string(), {density, points});
  std::ofstream(test_folder() / "text.vdb") << "these are no grids at all, only words";
  expect_message(R"(let d = grid("none.vdb"))", "no file of grids 'none.vdb'");
  expect_message(R"(let d = grid("some.vdb", "dnsity"))", "'some.vdb' has no grid 'dnsity'");
  expect_message(R"(let d = grid("some.vdb", "dnsity"))", "it has: density (float), points (");
  expect_message(R"(let d = grid("some.vdb", "points"))", "which cannot be looked up");
  expect_message(R"(let d = grid("text.vdb"))", "it is no OpenVDB file");
  expect_message(R"(let d = grid("../outside.vdb"))", "is outside of the scene's folder");
  expect_message(R"(let d = grid("."))", "it is not a file");
  expect_message(R"(let d = grid("some.vdb", filter: "round"))", "there is no filter 'round'");
  expect_message(R"(let d = grid("some.vdb") let x = d(1))", "the place in a grid wants a vec");
  expect_message(R"(let d = grid("some.vdb") let x = d((0, 0, 0), 1))", "'d' is a grid: it takes one place");
  expect_message(R"(let x = bounds(5))", "bounds are those of a grid, found a number");
  expect_message(R"(let d = grid("some.vdb") volume { in: d  medium: { density = 1 albedo = 0.5 } })",
                 "write in: bounds(smoke)");
  expect_message(R"(let d = grid("some.##.vdb"))", "the name has # for the digits of a frame");
  expect_message(R"(let d = grid("some.vdb", frame: 3))", "has # in its name");
  expect_message(R"(let d = grid("some.##.vdb", frame: 0.5))", "'frame' wants a whole number, found 0.5");
}

// What nothing uses is not read: its file may even be broken behind its directory.
TEST(GridScenes, ReadWhatIsUsed) {
  const std::string path = (test_folder() / "broken.vdb").string();
  write_vdb(path, {FixtureGrid{}});
  const auto whole = fs::file_size(path);
  std::string bytes(whole, ' ');
  std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(whole));
  bytes.replace(whole - 1500, 1400, 1400, '\xff');
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(whole));
  const Resolved quiet = resolved(camera + R"(let smoke = grid("broken.vdb")
medium _plume() { density = smoke(p)  albedo = 0.9 })");
  EXPECT_FALSE(quiet.diagnostics.has_errors()) << quiet.messages();
  expect_message(R"(let smoke = grid("broken.vdb")
volume { in: sphere { radius: 1 }  medium: { density = smoke(p)  albedo = 0.9 } })",
                 "broken.vdb': ");
}

TEST(GridScenes, TakeTheFileOfTheFrame) {
  for (const int frame : {7, 8}) {
    FixtureGrid density;
    density.value = [&](int, int, int) { return frame; };
    write_vdb((test_folder() / fmt::format("smoke.{:04}.vdb", frame)).string(), {density});
  }
  const std::string scene = R"(
animation { fps: 24  frames: 7..8 }
let smoke = grid("smoke.####.vdb", "density", frame: frame)
sphere { radius: smoke((0, 4, 8)) })";
  resolve::Options options;
  for (const int frame : {7, 8}) {
    options.frame = frame;
    const Resolved r = resolved(camera + scene, options);
    EXPECT_TRUE(r.diagnostics.all().empty()) << r.messages();
    EXPECT_NEAR(std::get<scene::Sphere>(r.scene.shapes.at(0).shape).radius, frame, 1e-3);
  }
  options.frame = 9;
  const Resolved r = resolved(camera + scene, options);
  EXPECT_NE(r.messages().find("no file of grids 'smoke.0009.vdb'"), std::string::npos) << r.messages();
}

// The box of what is not background, turned as the grid is.
TEST(GridScenes, HaveBounds) {
  FixtureGrid density;
  density.value = [](int, int, int) { return 1; };
  density.local_from_index = Transform::rotate({0, 0, 1}, 0.5) * Transform::scale({0.1, 0.1, 0.1});
  write_vdb((test_folder() / "turned.vdb").string(), {density});
  const scene::Scene scene = clean(R"(let smoke = grid("turned.vdb")
volume { in: bounds(smoke)  transform: translate((-0.8, -0.5, -1))  medium: { density = smoke(p)  albedo = 0.9 } })");
  ASSERT_EQ(scene.volumes.size(), 1u);
  const auto& box = std::get<scene::Box>(scene.volumes[0].shape);
  const Vec3d low = scene.volumes[0].world_from_shape.point(box.min);
  const Vec3d wanted =
      Transform::translate({-0.8, -0.5, -1}).point(density.local_from_index.point({-4, -1, 4}));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(low[k], wanted[k], 1e-9);
  EXPECT_EQ(box.max - box.min, (Vec3d{25, 11, 14}));
  ASSERT_EQ(scene.media[0].extinction.tables.voxels.size(), 1u);
}

// A volume without a shape is where the grids of its medium are.
TEST(GridScenes, GiveVolumesTheirShape) {
  FixtureGrid density, heat;
  heat.name = "heat";
  heat.first = {-10, -10, -10};
  heat.last = {0, 0, 0};
  write_vdb((test_folder() / "shape.vdb").string(), {density, heat});
  const std::string lets = R"(let d = grid("shape.vdb") let _heat = grid("shape.vdb", "heat"))";
  const auto box_of = [&](const std::string& medium) {
    const scene::Scene scene = clean(lets + " volume { medium: { albedo = 0.5 " + medium + " } }");
    EXPECT_EQ(scene.volumes.size(), 1u);
    if (scene.volumes.empty()) return scene::Box{};
    auto box = std::get<scene::Box>(scene.volumes[0].shape);
    box.min = scene.volumes[0].world_from_shape.point(box.min);
    box.max = scene.volumes[0].world_from_shape.point(box.max);
    return box;
  };
  EXPECT_EQ(box_of("density = max(0, d(p))").min, (Vec3d{-4, -1, 4}));
  EXPECT_EQ(box_of("density = max(0, d(p))").max, (Vec3d{21, 10, 18}));
  EXPECT_EQ(box_of("density = max(0, d(p) + _heat(p))").min, (Vec3d{-11, -11, -11}));
  EXPECT_EQ(box_of("density = max(0, d(p) + _heat(p))").max, (Vec3d{21, 10, 18}));
  expect_message(lets + " volume { medium: { density = d(2 * p) + _heat(p)  albedo = 0.5 } }",
                 "'volume' needs 'in'");
  expect_message(
      lets + " volume { medium: { density = 1 + 0 * d((0, 0, 0)) * _heat((0, 0, 0))  albedo = 0.5 } }",
      "'volume' needs 'in'");
}

// Smoke that was stored when the shutter opened, carried on by the velocity that was stored with it.
TEST(GridScenes, AreCarriedByTheirVelocity) {
  FixtureGrid density, flow;
  density.value = [](int x, int, int) { return 100 + x; };
  flow.name = "v";
  flow.type = GridType::vec3s;
  flow.value = [](int, int, int) { return 2; };  // (2, 3, 4)
  write_vdb((test_folder() / "flow.vdb").string(), {density, flow});
  const scene::Scene scene = clean(R"(
animation { fps: 10  frames: 4..4  shutter: 360deg }
let smoke = grid("flow.vdb")
let flow = grid("flow.vdb", "v")
medium moving() { density = smoke(p - flow(p) * (time - frame / 10))  albedo = 0.5 }
volume { in: bounds(smoke)  medium: moving })");
  const scene::Medium& medium = scene.media.at(0);
  for (const float time : {0.4f, 0.45f, 0.5f}) {
    const float x = 8, y = 4, z = 10;
    vm::BatchInputs inputs;
    inputs[vm::Input::p_x] = &x;
    inputs[vm::Input::p_y] = &y;
    inputs[vm::Input::p_z] = &z;
    inputs[vm::Input::time] = &time;
    std::vector<float> outputs(medium.extinction.outputs.size());
    std::vector<float*> rows;
    for (float& output : outputs) rows.push_back(&output);
    vm::Machine().run(medium.extinction, inputs, 1, rows);
    EXPECT_NEAR(outputs[medium.extinction_sigma_t[0]], 108 - 2 * (time - 0.4f), 1e-2);
  }
}

// The density of a ball as a shader and as a grid of it: same pictures.
TEST(GridScenes, RenderLikeTheShaderThatFilledThem) {
  const auto density_at = [](const Vec3d& p) {
    const double r = std::min(1.0, length(p));
    return 6 * (1 - r * r) * (1 + 0.5 * std::sin(7 * p.x) * std::cos(5 * p.y));
  };
  for (const bool turned : {false, true}) {
    FixtureGrid grid;
    const double voxel = 0.04;
    grid.local_from_index = (turned ? Transform::rotate({1, 2, 3}, 0.7) : Transform{}) *
                            Transform::translate({0.01, -0.02, 0.013}) *
                            Transform::scale({voxel, voxel, voxel});
    grid.first = {-27, -27, -27};
    grid.last = {27, 27, 27};
    grid.value = [&](int x, int y, int z) {
      return density_at(grid.local_from_index.point(
          {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
    };
    write_vdb((test_folder() / "ball.vdb").string(), {grid});
    const std::string shader = R"(
volume {
  in: sphere { radius: 1.02 }
  medium: {
    let r = min(1, length(p))
    density = 6 * (1 - r * r) * (1 + 0.5 * sin(7 * p.x) * cos(5 * p.y))
    albedo = (0.9, 0.7, 0.3)
    phase = hg(0.4)
  }
})";
    const std::string stored = R"(
let ball = grid("ball.vdb")
volume { in: bounds(ball)  medium: { density = ball(p)  albedo = (0.9, 0.7, 0.3)  phase = hg(0.4) } })";
    const scene::Scene of_grid = clean(stored), of_shader = clean(shader);
    const support::Measurement b = support::measure(of_shader);
    for (const auto& [name, method] : support::all_methods()) {
      render::RenderOptions options;
      options.method = method;
      const support::Measurement a = support::measure(of_grid, options);
      // Linear interpolation of it is off by voxel^2 / 8 times its curvature, 1 % of it at most.
      for (int half = 0; half < 2; ++half)
        support::expect_same(a.region(4 * half, 0, 4 * half + 4, 8), b.region(4 * half, 0, 4 * half + 4, 8),
                             2e-3, 0.03, fmt::format("{}, {}", name, turned ? "turned" : "straight"));
    }
  }
}

// A file that no one here made.
TEST(GridScenes, SharedSmokeIsRead) {
  const fs::path smoke = (std::filesystem::path(TYNDALL_SOURCE_DIR) / "../shared/data/smoke.vdb");
  if (!fs::exists(smoke)) GTEST_SKIP() << "no " << smoke;
  resolve::Options options;
  options.allow_outside = true;
  const Resolved r = resolved(camera + fmt::format(R"(let smoke = grid("{}", "density")
volume {{ medium: {{ density = smoke(p)  albedo = 0.9 }} }})",
                                                   smoke.string()),
                              options);
  EXPECT_TRUE(r.diagnostics.all().empty()) << r.messages();
  ASSERT_EQ(r.scene.media[0].full.tables.voxels.size(), 1u);
  EXPECT_NEAR(r.scene.media[0].full.tables.voxels[0]->levels.back().ranges[0].hi, 5.71, 0.01);
}

}  // namespace UNNAMED
}  // namespace tyndall::import
