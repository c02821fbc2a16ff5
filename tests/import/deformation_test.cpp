// Meshes that deform while the shutter is open: as many poses as their ways need, and what is seen of them.
#include "import/deformation.h"

#include <cmath>
#include <numbers>

#include "compile/compiled_scene.h"
#include "image/image.h"
#include "opened.h"
#include "render/render.h"
#include "resolve/resolve.h"
#include "shapes/mesh_at.h"
#include "support/filled.h"
#include "support/test_folder.h"
#include "syntax/parser.h"

namespace tyndall {
namespace UNNAMED {

constexpr double pi_ = std::numbers::pi;

shapes::TriangleMesh triangle() {
  shapes::TriangleMesh mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  mesh.normals = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}
shapes::MeshPose turned(double angle) {
  shapes::MeshPose pose;
  for (const Vec3d& p : triangle().points)
    pose.points.push_back(
        {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle), 0});
  pose.normals = pose.points;
  return pose;
}

TEST(LaterPoses, AreNoneWhereNothingMoves) {
  shapes::TriangleMesh mesh = triangle();
  EXPECT_EQ(add_later_poses(mesh, [](double) { return turned(0); }).largest, 0);
  EXPECT_TRUE(mesh.later.empty());
}

TEST(LaterPoses, AreOneOnStraightWays) {
  shapes::TriangleMesh mesh = triangle();
  const PoseError error = add_later_poses(mesh, [](double t) {
    shapes::MeshPose pose = turned(0);
    for (Vec3d& p : pose.points) p += Vec3d{3 * t, -t, 1e6 * t};
    return pose;
  });
  EXPECT_EQ(mesh.later.size(), 1u);
  EXPECT_EQ(error.off_share, 0);
  EXPECT_NEAR(shapes::MeshAt(mesh, 0.25).point(1).x, 0.75, 1e-9);
}

// A half turn in n parts is off by 1 - cos(π / 2n) of the radius in the middle of each, and the box is 2
// wide.
TEST(LaterPoses, AreAsManyAsTurnsNeed) {
  shapes::TriangleMesh mesh = triangle();
  const PoseError error = add_later_poses(mesh, [](double t) { return turned(pi_ * t); });
  EXPECT_EQ(mesh.later.size(), 64u);  // 1 - cos(π / 128) = 0.0003 < 2 / 4000, and 1 - cos(π / 64) = 0.0012
  EXPECT_LE(error.largest, 1);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    const shapes::MeshAt now(mesh, t);
    const shapes::MeshPose truth = turned(pi_ * t);
    for (std::uint32_t k = 0; k < 3; ++k)
      worst = std::max({worst, length(now.point(k) - truth.points[k]),
                        length(normalize(now.normal(k)) - truth.normals[k]) / 40});
  }
  EXPECT_LE(worst, 2.0 / 4000);
  EXPECT_GT(worst, 0.5 / 4000);
}

// Points that stay while their normals turn.
TEST(LaterPoses, FollowNormalsToo) {
  shapes::TriangleMesh mesh = triangle();
  add_later_poses(mesh, [](double t) {
    shapes::MeshPose pose = turned(3 * t);
    pose.points = turned(0).points;
    return pose;
  });
  EXPECT_EQ(mesh.later.size(), 4u);
}

TEST(LaterPoses, EndAtALimitThatIsTold) {
  shapes::TriangleMesh mesh = triangle();
  const PoseError turns = add_later_poses(mesh, [](double t) { return turned(40 * pi_ * t); });
  EXPECT_EQ(mesh.later.size(), most_later_poses);
  EXPECT_GT(turns.off_share, 0.9);
  EXPECT_GT(turns.largest, 100);
  const PoseError jump = add_later_poses(mesh, [](double t) { return turned(t < 0.3 ? 0 : 1); });
  EXPECT_EQ(mesh.later.size(), most_later_poses);
  EXPECT_LT(jump.off_share, 1.5 / most_later_poses);
}

// A square of (0, 0) to (1, 1) that a morph target moves along x by 2, evenly in 1 s.
GltfWriter moving_square(json material) {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  p["indices"] = w.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR");
  p["targets"] = {{{"POSITION", w.accessor(std::vector<float>{2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3")}}};
  p["material"] = w.add("materials", std::move(material));
  const std::size_t mesh = w.mesh(p);
  w.node({{"mesh", mesh}, {"name", "Square"}});
  w.add("animations", {{"samplers",
                        {{{"input", w.accessor(std::vector<float>{0, 1}, "SCALAR")},
                          {"output", w.accessor(std::vector<float>{0, 1}, "SCALAR")}}}},
                       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  return w;
}
const json glow = {{"emissiveFactor", {1, 1, 1}},
                   {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}}}};

struct Scene {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  scene::Scene scene;
  std::string messages() const { return render_text(diagnostics, sources, false); }
};
Scene scene_in(const std::filesystem::path& folder, const std::string& text) {
  Scene s;
  const SourceId source = s.sources.add((folder / "scene.tyn").string(), text);
  const syntax::TokenList tokens = syntax::lex(s.sources, source, s.diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(s.sources, source, tokens, s.symbols, s.diagnostics);
  s.scene = resolve::resolve(tree, s.sources, s.symbols, {}, s.diagnostics);
  return s;
}

const std::string shutter_of_a_second = "animation { fps: 1  frames: 0..3  shutter: 360deg }\n";
const std::string dim = "light point { position: (0, 0, 100)  power: 1e-9 }\n";

// The mean light of a point over the time that the shutter is open.
double seen_at(const std::filesystem::path& folder, double x, const std::string& text) {
  Scene s = scene_in(folder, support::filled(R"(
camera orthographic { from: ($X, 0.5, 9)  to: ($X, 0.5, 0)  height: 1e-6 }
animation { fps: 1  frames: 0..3  shutter: 360deg }
$MORE
)",
                                             {{"X", x}, {"MORE", text}}));
  EXPECT_EQ(s.messages(), "");
  s.scene.settings.resolution.width = s.scene.settings.resolution.height = 1;
  s.scene.settings.samples = 1024;
  const compile::CompiledScene world = compile::compile(std::move(s.scene));
  return double{render::render(world, {}).film.image().pixels[0]};
}

// The square is above x while 2 t <= x <= 2 t + 1: for min(x, 1, 3 - x) / 2 of the time.
TEST(GltfBlur, IsTheTimeThatAMorphedMeshIsThere) {
  const auto folder = test_folder();
  moving_square(glow).save(folder);
  for (const double x : {0.25, 0.5, 1.5, 2.25, 2.75})
    EXPECT_NEAR(seen_at(folder, x, dim + "gltf \"test.glb\" {}"), std::min({x, 1.0, 3 - x}) / 2, 0.02) << x;
  // Twice as fast it stands still, at (2, 0, 0), in the second half of the time.
  EXPECT_NEAR(seen_at(folder, 2.5, dim + "gltf \"test.glb\" { speed: 2  loop: false }"), 0.5 + 0.125, 0.02);
  EXPECT_NEAR(seen_at(folder, 0.5, dim + "gltf \"test.glb\" { animation: \"\" }"), 1, 1e-6);
}

// Where a mesh is a shape, it deforms as well: a light is met, and the medium in it is seen.
TEST(GltfBlur, IsOfLightsToo) {
  const auto folder = test_folder();
  moving_square(glow).save(folder);
  EXPECT_NEAR(seen_at(folder, 0.5, "light mesh { in: gltf \"test.glb\" { node: \"Square\" }  radiance: 1 }"),
              0.25, 0.02);
}

// Lines go with their morph targets as meshes do: a rod that goes 2 m in the time, and is 0.2 m thick, is
// before a point on its way for a tenth of the time.
TEST(GltfBlur, MovesLines) {
  const auto folder = test_folder();
  GltfWriter w;
  json p = w.primitive({-1, 0, 0, 2, 0, 0});
  p["mode"] = 1;
  p["targets"] = {{{"POSITION", w.accessor(std::vector<float>{0, 2, 0, 0, 2, 0}, "VEC3")}}};
  p["material"] = w.add("materials", glow);
  w.node({{"mesh", w.mesh(p)}});
  w.add("animations", {{"samplers",
                        {{{"input", w.accessor(std::vector<float>{0, 1}, "SCALAR")},
                          {"output", w.accessor(std::vector<float>{0, 1}, "SCALAR")}}}},
                       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  w.save(folder);
  const std::string rods = "gltf \"test.glb\" { line_width: 0.2  loop: false }";
  EXPECT_NEAR(seen_at(folder, 0.5, dim + rods), 0.1, 0.01);
  const Scene s = scene_in(folder, "camera orthographic { from: (0, 0, 9)  to: (0, 0, 0)  height: 1 }\n" +
                                       shutter_of_a_second + rods);
  ASSERT_EQ(s.scene.strand_sets.size(), 1u);
  ASSERT_EQ(s.scene.strand_sets[0].later.size(), 1u);
  EXPECT_EQ(s.scene.strand_sets[0].later[0].points.at(1), (Vec3d{2, 2, 0}));
}

// A picture all around turns by its own angle and with the groups around it; its colour may change.
TEST(SkyBlur, TurnsPictures) {
  const auto folder = test_folder();
  std::filesystem::copy_file(TYNDALL_SOURCE_DIR "/scenes/images/dusk.hdr", folder / "sky.hdr",
                             std::filesystem::copy_options::overwrite_existing);
  const auto motion_of = [&](const std::string& light) {
    const Scene s = scene_in(
        folder, "camera orthographic { from: (0, 0, 9)  to: (0, 0, 0)  height: 1 }\n" + shutter_of_a_second +
                    (light.find("sky") != std::string::npos ? "let sky = image(\"sky.hdr\")\n" : "") + light);
    EXPECT_EQ(s.messages(), "");
    return s.scene.motion.lights;
  };
  const auto half = [](const scene::Moving<scene::LightInstance>& moving) {
    return std::get<scene::EnvironmentLight>(scene::at(moving, 0.5).light);
  };
  EXPECT_TRUE(
      motion_of("light environment { radiance: sky  rotation: 90deg }\nsphere { center: (time, 0, 0) }")
          .empty());
  EXPECT_TRUE(motion_of("light environment { radiance: 1  rotation: 90deg * time }").empty());
  const auto by_angle = motion_of("light environment { radiance: sky  rotation: 1800deg * time }");
  ASSERT_EQ(by_angle.size(), 1u);
  EXPECT_EQ(by_angle[0].keys.size(), 2u);
  EXPECT_NEAR(half(by_angle[0]).rotation.radians, 5 * pi, 1e-9);
  const auto by_group =
      motion_of("group { transform: rotate_x(720deg * time)  light environment { radiance: sky } }");
  ASSERT_EQ(by_group.size(), 1u);
  EXPECT_GT(by_group[0].keys.size(), 4u);  // less than half a turn apart
  for (const double fraction : {0.1, 0.33, 0.8}) {
    const auto now = std::get<scene::EnvironmentLight>(scene::at(by_group[0], fraction).light);
    EXPECT_LE(length(now.world_from_sky.y - Transform::rotate({1, 0, 0}, 4 * pi * fraction).y), 1e-9);
  }
  const auto by_color = motion_of("light environment { radiance: (1, time, 2) * sky }");
  ASSERT_EQ(by_color.size(), 1u);
  EXPECT_NEAR(half(by_color[0]).radiance.color.y, 0.5, 1e-6);
}

TEST(GltfBlur, CostsNothingWhereTheShutterIsClosedOrNothingDeforms) {
  const auto folder = test_folder();
  moving_square(glow).save(folder);
  const std::string camera = "camera orthographic { from: (0, 0, 9)  to: (0, 0, 0)  height: 1 }\n" + dim;
  Scene closed = scene_in(folder, camera + "animation { fps: 1  frames: 0..3 }\ngltf \"test.glb\" {}");
  ASSERT_EQ(closed.scene.meshes.size(), 1u);
  EXPECT_TRUE(closed.scene.meshes[0]->later.empty());
  Scene open = scene_in(folder, camera + shutter_of_a_second + "gltf \"test.glb\" { loop: false }");
  ASSERT_EQ(open.scene.meshes.size(), 1u);
  EXPECT_EQ(open.scene.meshes[0]->later.size(), 1u);  // it goes straight
  Scene still = scene_in(folder, camera + shutter_of_a_second + "gltf \"test.glb\" { animation: \"\" }");
  EXPECT_TRUE(still.scene.meshes.at(0)->later.empty());
  EXPECT_TRUE(still.scene.motion.instances.empty());
}

// What makes three turns while the shutter is open, which is more than 128 poses follow: a mesh by its skin
// of one joint, or by its node.
GltfWriter wheel(bool skinned) {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  p["attributes"]["JOINTS_0"] = w.accessor(std::vector<std::uint8_t>(12, 0), "VEC4");
  p["attributes"]["WEIGHTS_0"] = w.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  std::size_t mesh = w.mesh(p);
  w.root["meshes"][mesh]["name"] = "Wheel";
  json hub{{"mesh", mesh}, {"name", "Hub"}};
  if (skinned) {
    w.add("skins", {{"joints", {1}}});
    hub["skin"] = 0;
  }
  w.node(hub);
  w.node(json::object());
  std::vector<float> times, turns;
  for (int i = 0; i <= 12; ++i) {
    const double angle = pi_ / 2 * i;
    times.push_back(static_cast<float>(i) / 12);
    for (const double q : {0.0, 0.0, std::sin(angle / 2), std::cos(angle / 2)})
      turns.push_back(static_cast<float>(q));
  }
  w.add("animations",
        {{"samplers", {{{"input", w.accessor(times, "SCALAR")}, {"output", w.accessor(turns, "VEC4")}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", skinned ? 1 : 0}, {"path", "rotation"}}}}}}});
  return w;
}

TEST(GltfBlur, TellsOfWhatMovesTooUnevenly) {
  const auto folder = test_folder();
  GltfWriter w = wheel(true);
  w.save(folder);
  const Scene s = scene_in(folder, "camera orthographic { from: (0, 0, 9)  to: (0, 0, 0)  height: 1 }\n" +
                                       dim + shutter_of_a_second + "gltf \"test.glb\" {}");
  EXPECT_NE(
      s.messages().find("has a mesh, 'Wheel', that moves too unevenly while the shutter is open: of 129 "
                        "poses the blur is off by up to"),
      std::string::npos)
      << s.messages();
}

// Nodes that do so are told of where all that they have is one shape, and so are meshes, once.
TEST(GltfBlur, TellsOfShapesThatMoveTooUnevenly) {
  for (const bool skinned : {false, true}) {
    const auto folder = test_folder();
    GltfWriter w = wheel(skinned);
    w.save(folder);
    for (const bool by_name : {false, true}) {
      const Scene s = scene_in(
          folder, fmt::format("camera orthographic {{ from: (0, 0, 9)  to: (0, 0, 0)  height: 1 }}\n{}"
                              "light mesh {{ in: gltf \"test.glb\" {{ {} }}  radiance: 1 }}",
                              shutter_of_a_second, by_name ? "node: \"Hub\"" : ""));
      const std::string_view what = skinned   ? "has a mesh, 'Wheel',"
                                    : by_name ? "has a node, 'Hub',"
                                              : "has a scene";
      EXPECT_NE(s.messages().find(fmt::format("{} that moves too unevenly while the shutter is open: of 129 "
                                              "poses the blur is off by up to",
                                              what)),
                std::string::npos)
          << s.messages();
      const std::string once = s.messages();
      EXPECT_EQ(once.find("too unevenly"), once.rfind("too unevenly")) << once;
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
