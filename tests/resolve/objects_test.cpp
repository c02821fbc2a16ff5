// Objects and their placements: one prototype for all, materials and variables as if written out.
#include "resolved.h"

namespace tyndall {
namespace UNNAMED {

TEST(Placements, ShareAPrototype) {
  const Resolved r = resolve_clean(
      R"(
object leaf { sphere { radius: 0.1 } }
object tree { box { min: (0, 0, 0)  max: (1, 1, 1) }  for i in 0..<10 { place leaf {} } }
for i in 0..<1000 { place tree { transform: translate((i, 0, 0)) } }
)");
  EXPECT_EQ(r.scene.prototypes.size(), 2u);
  EXPECT_EQ(r.scene.instances.size(), 1000u);
  EXPECT_EQ(r.scene.shapes.size(), 0u);
  EXPECT_EQ(scene::expanded(r.scene).shapes.size(), 11000u);
}

TEST(Placements, WithEqualArgumentsShareAPrototype) {
  const Resolved r = resolve_clean(
      R"(
object tree(seed, height = 3, at = [0]) { cylinder { from: (at[0], 0, 0)  to: (0, height, seed)  radius: 1 } }
for i in 0..<1000 { place tree(mod(i, 8)) {} }
place tree(1, height: 3) {}
place tree(seed: 1, at: [0]) {}
place tree(1, height: 4) {}
place tree(1, at: [2]) {}
)");
  EXPECT_EQ(r.scene.prototypes.size(), 10u);
  EXPECT_EQ(r.scene.instances.size(), 1004u);
}

// The arguments of one placement are not those of another, in objects within objects too.
TEST(Placements, HaveTheirOwnArguments) {
  const Resolved r = resolve_clean(
      R"(
object leaf(size) { sphere { radius: size } }
object branch(n) { for i in 1..n { place leaf(i) {} } }
place branch(2) {}
place branch(n: 3) {}
)");
  std::vector<double> radii;
  const scene::Scene out = scene::expanded(r.scene);
  for (const scene::ShapeInstance& s : out.shapes) radii.push_back(std::get<shapes::Sphere>(s.shape).radius);
  EXPECT_EQ(radii, (std::vector<double>{1, 2, 1, 2, 3}));
  EXPECT_EQ(r.scene.prototypes.size(), 5u);
}

TEST(Placements, GiveMaterialsToShapesThatNameNone) {
  const Resolved r = resolve_clean(
      R"(
material red() { base_color = (1, 0, 0) }
material blue() { base_color = (0, 0, 1) }
object pair { sphere {}  sphere { material: blue } }
object nest { place pair {}  place pair { material: red } }
place pair { material: red }
group { material: blue  place nest {} }
place pair {}
)");
  const scene::Scene out = scene::expanded(r.scene);
  std::vector<std::string> names;
  for (const scene::ShapeInstance& s : out.shapes) names.push_back(out.materials.at(s.material.index).name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"red", "blue", "blue", "blue", "red", "blue", "diffuse", "blue"}));
}

TEST(Placements, MoveLightsAndVolumes) {
  const Resolved r = resolve_clean(
      R"(
object lamp {
  light point { position: (0, 1, 0)  power: 1 }
  volume { in: sphere {}  medium: { density = 1  albedo = 0.5 }  transform: scale(2) }
}
object post { place lamp { transform: translate((0, 5, 0)) } }
place post { transform: rotate_z(90deg) }
group { visible: false  place post {} }
)");
  ASSERT_EQ(r.scene.lights.size(), 3u);
  expect_near(std::get<scene::PointLight>(r.scene.lights[1].light).position, {-6, 0, 0});
  expect_near(std::get<scene::PointLight>(r.scene.lights[2].light).position, {0, 6, 0});
  const auto volumes = scene::all_volumes(r.scene);
  ASSERT_EQ(volumes.size(), 2u);
  expect_near(volumes[0].world_from_medium.t, {-5, 0, 0});
  EXPECT_TRUE(volumes[0].visible);
  EXPECT_FALSE(volumes[1].visible);
}

// An object sees the variables around it as they are where it is placed.
TEST(Placements, FollowVariables) {
  const Resolved r = resolve_clean(
      R"(
var size = 1
object ball { sphere { radius: size } }
object two { place ball {} }
place two {}
size = 3
place two {}
place ball {}
)");
  const scene::Scene out = scene::expanded(r.scene);
  ASSERT_EQ(out.shapes.size(), 3u);
  EXPECT_EQ(std::get<scene::Sphere>(out.shapes[0].shape).radius, 1);
  EXPECT_EQ(std::get<scene::Sphere>(out.shapes[1].shape).radius, 3);
  EXPECT_EQ(std::get<scene::Sphere>(out.shapes[2].shape).radius, 3);
}

TEST(Placements, SetVariablesEachTime) {
  const Resolved r = resolve_clean(
      R"(
var size = 1
object reset { size = 2  sphere {} }
place reset {}
size = 5
place reset {}
sphere { radius: size }
)");
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(0).shape).radius, 2);
}

// A light that one placement stretches is an error there; the others are right.
TEST(Placements, CheckLightsWhereTheyArePlaced) {
  const Resolved r = resolve_text(camera_and_light +
                                  "object lamp { light sphere { center: (0, 0, 0) radius: 1 power: 1 } }\n"
                                  "place lamp {}  place lamp { transform: scale((1, 2, 1)) }");
  EXPECT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_EQ(r.scene.lights.size(), 2u);
}

}  // namespace UNNAMED
}  // namespace tyndall
