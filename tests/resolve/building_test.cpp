// How scenes are built: spaces, groups, objects, templates, loops, sharing, overrides.
#include "resolved.h"

namespace tyndall {
namespace UNNAMED {

TEST(Groups, MultiplyOnTheLeft) {
  const Resolved r = resolve_clean(
      R"(
group {
  transform: translate((1, 2, 3))
  group { transform: rotate_z(90deg)  sphere { transform: scale((2, 3, 4)) } }
}
)");
  // By hand: the sphere's x axis (2, 0, 0) turns to (0, 2, 0), its y axis (0, 3, 0) to (-3, 0, 0).
  expect_near(r.scene.shapes.at(0).world_from_object, {{0, 2, 0}, {-3, 0, 0}, {0, 0, 4}, {1, 2, 3}});
}

TEST(Groups, TakeTheirTransformWhereverItStands) {
  const std::string before = "group { transform: translate((1, 0, 0))  sphere {} }";
  const std::string after = "group { sphere {}  transform: translate((1, 0, 0)) }";
  EXPECT_EQ(scene::print(resolve_clean(before).scene), scene::print(resolve_clean(after).scene));
}

TEST(Groups, PassMaterialAndVisibilityDown) {
  const Resolved r = resolve_clean(
      R"(
material red() { base_color = (1, 0, 0) }
material blue() { base_color = (0, 0, 1) }
group { material: red  visible: false  sphere {}  sphere { material: blue } }
sphere {}
)");
  const auto& shapes = r.scene.shapes;
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(r.scene.materials.at(shapes[0].material.index).name, "red");
  EXPECT_EQ(r.scene.materials.at(shapes[1].material.index).name, "blue");
  EXPECT_FALSE(shapes[0].visible);
  EXPECT_FALSE(shapes[1].visible);
  EXPECT_TRUE(shapes[2].visible);
}

TEST(Volumes, KnowTheSpacesOfMediumAndShape) {
  const Resolved r = resolve_clean(
      R"(
group {
  transform: translate((1, 0, 0))
  volume {
    in: sphere { center: (9, 9, 9)  transform: scale(3) }
    medium: { density = 1  albedo = 0.5 }
    transform: rotate_z(90deg)
    step: 2cm
    visible: false
  }
}
)");
  const scene::Volume& volume = r.scene.volumes.at(0);
  expect_near(volume.world_from_medium, {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {1, 0, 0}});
  expect_near(volume.world_from_shape, {{0, 3, 0}, {-3, 0, 0}, {0, 0, 3}, {1, 0, 0}});
  EXPECT_EQ(volume.step, 0.02);
  EXPECT_FALSE(volume.visible);
}

TEST(Lights, MoveToWorldSpace) {
  const Resolved r = resolve_clean(
      R"(
group {
  transform: translate((1, 0, 0)) * scale(2)
  light point { position: (0, 1, 0)  power: 5  transform: rotate_z(90deg) }
  light sphere { center: (0, 1, 0)  radius: 0.5  radiance: 7 }
  light quad { center: (0, 1, 0)  u: (1, 0, 0)  v: (0, 0, 1)  power: 3  visible: false }
  light distant { direction: (0, -3, 0)  irradiance: 1  transform: rotate_z(90deg) }
}
)");
  const auto& lights = r.scene.lights;
  ASSERT_EQ(lights.size(), 5u);
  const auto& point = std::get<scene::PointLight>(lights[1].light);
  expect_near(point.position, {-1, 0, 0});
  EXPECT_EQ(point.power, Rgb(5, 5, 5));
  const auto& lamp = std::get<scene::AreaLight>(lights[2].light);
  const auto& sphere = std::get<scene::Sphere>(lamp.shape);
  expect_near(sphere.center, {1, 2, 0});
  EXPECT_DOUBLE_EQ(sphere.radius, 1);
  EXPECT_EQ(lamp.radiance, Rgb(7, 7, 7));
  const auto& window = std::get<scene::AreaLight>(lights[3].light);
  const auto& quad = std::get<scene::Quad>(window.shape);
  expect_near(quad.u, {2, 0, 0});
  expect_near(quad.v, {0, 0, 2});
  EXPECT_FALSE(window.visible);
  expect_near(std::get<scene::DistantLight>(lights[4].light).direction, {1, 0, 0});
}

// A quad light in a mirror shines to the mirror image of where it shone.
TEST(Lights, ShineFromTheMirroredSide) {
  const Resolved r = resolve_clean(
      "light quad { center: (0, 1, 0) u: (1, 0, 0) v: (0, 1, 0) power: 3 transform: scale((-1, 1, 1)) }");
  const auto& quad = std::get<scene::Quad>(std::get<scene::AreaLight>(r.scene.lights.at(1).light).shape);
  EXPECT_GT(cross(quad.u, quad.v).z, 0);
}

TEST(Cameras, MoveWithTheirGroup) {
  const Resolved r = resolve_text(
      R"(
light environment { radiance: 1 }
group {
  transform: translate((0, 1, 0)) * scale(2)
  camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 3 }
}
)");
  ASSERT_TRUE(r.diagnostics.all().empty()) << r.messages();
  const auto& camera = std::get<scene::OrthographicCamera>(r.scene.camera);
  expect_near(camera.from, {0, 1, 10});
  EXPECT_DOUBLE_EQ(camera.height, 6);
}

TEST(Objects, AreBuiltAsIfWrittenWhereTheyArePlaced) {
  const std::string placed =
      R"(
let r = 2
object ball { let s = r / 4  sphere { center: (0, 1, 0)  radius: s } }
place ball {}
group { transform: scale(2)  place ball { transform: translate((1, 0, 0)) } }
)";
  const std::string written =
      R"(
sphere { center: (0, 1, 0)  radius: 0.5 }
group {
  transform: scale(2)
  group { transform: translate((1, 0, 0))  sphere { center: (0, 1, 0)  radius: 0.5 } }
}
)";
  EXPECT_EQ(scene::print(scene::expanded(resolve_clean(placed).scene)),
            scene::print(resolve_clean(written).scene));
}

TEST(Templates, SeeTheirDefinitionNotTheirCaller) {
  const Resolved r = resolve_clean(
      R"(
let size = 1
def ball(grow = 2 * size) { sphere { radius: size * grow } }
group { let size = 100  ball()  ball(size) }
)");
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(0).shape).radius, 2);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(1).shape).radius, 100);
}

TEST(Loops, RunOnceForEachValue) {
  const Resolved r = resolve_clean(
      R"(
var sum = 0
for i in 1..3 { for x in [10, 20] { sum = sum + x * i } }
sphere { radius: sum }
for i in 0..1..0.25 { sphere { radius: 1 + i } }
for i in 3..1 { sphere { radius: i } }
)");
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(0).shape).radius, 180);
  EXPECT_EQ(r.scene.shapes.size(), 6u);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(5).shape).radius, 2);
}

TEST(Bodies, AreSharedByTheirArguments) {
  const Resolved r = resolve_clean(
      R"(
material paint(value = 0.5) { base_color = value }
let fixed = paint(0.1)
for i in 0..<10 { sphere { material: paint(value: mod(i, 2) / 2) }  sphere { material: fixed } }
sphere { material: paint }
sphere { material: paint(0.5) }
)");
  EXPECT_EQ(r.scene.materials.size(), 3u);  // 0, 0.1 and 0.5
  EXPECT_EQ(r.scene.shapes.at(20).material, r.scene.shapes.at(21).material);
  EXPECT_EQ(r.scene.shapes.at(20).material, r.scene.shapes.at(2).material);
}

TEST(Bodies, AreNotSharedAcrossTheValuesTheyCapture) {
  const Resolved r = resolve_clean(
      R"(
for i in 0..<3 { volume { in: sphere {}  medium: { density = 1 + i  albedo = 0.5 } } }
var v = 1
medium fog() { density = v  albedo = 0.5 }
volume { in: sphere {}  medium: fog }
v = 2
volume { in: sphere {}  medium: fog }
)");
  EXPECT_EQ(r.scene.media.size(), 5u);
}

TEST(Overrides, ReplaceTopLevelLets) {
  resolve::Options options;
  options.overrides = {{"size", "3 * unit"}, {"name", "\"a{unit}\""}};
  const Resolved r = resolve_clean(
      R"(
let unit = 2
let size = 1
let name = "b"
if name == "a2" { sphere { radius: size } }
group { let size = 5  sphere { radius: size } }
)",
      options);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(0).shape).radius, 6);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(1).shape).radius, 5);
}

TEST(Overrides, ReachTheAnimation) {
  resolve::Options options;
  options.overrides = {{"rate", "50"}};
  const Resolved r = resolve_clean("let rate = 25  animation { fps: rate frames: 100..200 }", options);
  EXPECT_EQ(r.scene.time, 2);
}

TEST(Overrides, OfUnknownNamesAreErrors) {
  resolve::Options options;
  options.overrides = {{"szie", "3"}, {"size", "1 +"}};
  const Resolved r = resolve_text(camera_and_light + "let size = 1 sphere { radius: size }", options);
  EXPECT_EQ(r.diagnostics.error_count(), 2) << r.messages();
  EXPECT_NE(r.messages().find("<--set szie>:1:1: error: no top-level `let szie` to set"), std::string::npos)
      << r.messages();
  EXPECT_NE(r.messages().find("did you mean 'size'?"), std::string::npos) << r.messages();
  EXPECT_NE(r.messages().find("<--set size>:1:"), std::string::npos) << r.messages();
}

TEST(Defaults, AreGreyAndThoseOfTheStructs) {
  const Resolved r = resolve_clean("sphere {}  box { min: (0, 0, 0) max: (1, 1, 1) }");
  EXPECT_EQ(r.scene.settings.resolution.width, scene::RenderSettings{}.resolution.width);
  EXPECT_EQ(r.scene.settings.step, scene::RenderSettings{}.step);
  ASSERT_EQ(r.scene.materials.size(), 1u);
  const scene::Material& grey = r.scene.materials[0];
  EXPECT_EQ(grey.program.constants.at(grey.program.outputs.at(grey.base_color[0])), 0.8f);
}

TEST(Size, AHundredThousandSpheresAreBuilt) {
  const Resolved r = resolve_clean(
      R"(
material paint(value) { base_color = value }
let grey = paint(0.5)
for i in 0..<100000 { sphere { center: (i, random(i), 0)  radius: 1cm + i / 1000000  material: grey } }
)");
  ASSERT_EQ(r.scene.shapes.size(), 100000u);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.back().shape).center.x, 99999);
  EXPECT_EQ(r.scene.materials.size(), 1u);
}

// Deep nesting of every kind ends in an error, not in a crash.
TEST(Limits, NestedBlocksInRecursiveTemplates) {
  std::string groups, ends;
  for (int i = 0; i < 60; ++i) {
    groups += "group { ";
    ends += " }";
  }
  const Resolved r =
      resolve_text(camera_and_light + "def tree() { " + groups + "tree()" + ends + " } tree()");
  EXPECT_EQ(r.diagnostics.error_count(), 1) << r.messages();
}

}  // namespace UNNAMED
}  // namespace tyndall
