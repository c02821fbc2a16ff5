// Nodes, animations, skins, morph targets: where points end up.
#include <numbers>

#include "opened.h"
#include "support/test_folder.h"

namespace tyndall {
namespace UNNAMED {

const float half = std::numbers::sqrt2_v<float> / 2;  // sine and cosine of 45°

TEST(GltfNodes, MovePointsThroughAllThatIsAround) {
  GltfWriter w;
  const std::size_t mesh = w.triangle();
  // Twice as large; then a quarter turn about z; then along x.
  w.node({{"children", {1}}, {"translation", {10, 0, 0}}});
  w.node({{"children", {2}}, {"rotation", {0, 0, half, half}}});
  w.node({{"mesh", mesh}, {"scale", {2, 2, 2}}, {"translation", {1, 0, 0}}});
  w.root["scenes"] = {{{"nodes", {0}}}};
  const auto meshes = meshes_of(w);
  ASSERT_EQ(meshes.size(), 1u);
  expect_near(meshes[0].point(0), {10, 1, 0});
  expect_near(meshes[0].point(1), {10, 3, 0});
  expect_near(meshes[0].point(2), {8, 1, 0});
}

TEST(GltfNodes, MayHaveMatrices) {
  GltfWriter w;
  w.node({{"mesh", w.triangle()}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}});
  const auto meshes = meshes_of(w);
  expect_near(meshes[0].point(1), {5, 7, 7});
  expect_near(meshes[0].point(2), {4, 6, 7});
}

TEST(GltfNodes, OutsideTheSceneAreNotShown) {
  GltfWriter w;
  const std::size_t mesh = w.triangle();
  w.node({{"mesh", mesh}});
  w.node({{"mesh", mesh}, {"translation", {1, 0, 0}}});
  w.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  w.root["scene"] = 1;
  const auto meshes = meshes_of(w);
  ASSERT_EQ(meshes.size(), 1u);
  expect_near(meshes[0].point(0), {1, 0, 0});
}

TEST(GltfNodes, AreChosenByNameWithThoseBelow) {
  GltfWriter w;
  const std::size_t mesh = w.triangle();
  w.node({{"mesh", mesh}, {"children", {1}}, {"translation", {1, 0, 0}}});
  w.node({{"mesh", mesh}, {"name", "Tür [2]"}, {"children", {2}}, {"translation", {1, 0, 0}}});
  w.node({{"mesh", mesh}, {"translation", {1, 0, 0}}});
  gltf::File file = open_gltf(w.save(test_folder()));
  const auto parts = file.parts("Tür [2]", {});
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->surfaces.size(), 2u);
  expect_near(parts->surfaces[0].file_from_mesh.t, {2, 0, 0});
  expect_near(parts->surfaces[1].file_from_mesh.t, {3, 0, 0});
  EXPECT_FALSE(file.parts("Tür", {}));
}

TEST(GltfNodes, OfAnInstancedMeshShareIt) {
  GltfWriter w;
  const std::size_t at = w.accessor(std::vector<float>{1, 0, 0, 2, 0, 0, 3, 0, 0}, "VEC3");
  const std::size_t scales = w.accessor(std::vector<float>{1, 1, 1, 2, 2, 2, 3, 3, 3}, "VEC3");
  w.node({{"mesh", w.triangle()},
          {"translation", {0, 5, 0}},
          {"extensions",
           {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", at}, {"SCALE", scales}}}}}}}});
  gltf::File file = open_gltf(w.save(test_folder()));
  const auto parts = file.parts({}, {});
  ASSERT_EQ(parts->surfaces.size(), 3u);
  expect_near(parts->surfaces[2].file_from_mesh.point({1, 0, 0}), {6, 5, 0});
  EXPECT_FALSE(parts->surfaces[2].source.posed);
}

// A node whose x goes from 0 to 8 in 2 s.
GltfWriter moving(const char* interpolation, const std::vector<float>& values) {
  GltfWriter w;
  w.node({{"mesh", w.triangle()}});
  const std::size_t times = w.accessor(std::vector<float>{1, 3}, "SCALAR");
  const std::size_t output = w.accessor(values, "VEC3");
  w.add("animations",
        {{"name", "go"},
         {"samplers", {{{"input", times}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
  return w;
}
double x_at(const GltfWriter& w, double seconds, bool loop = false) {
  return meshes_of(w, seconds, loop).at(0).point(0).x;
}

TEST(GltfAnimations, GoInSteps) {
  const GltfWriter w = moving("STEP", {0, 0, 0, 8, 0, 0});
  EXPECT_EQ(x_at(w, 0.5), 0);
  EXPECT_EQ(x_at(w, 2.9), 0);
  EXPECT_EQ(x_at(w, 3), 8);
  EXPECT_EQ(x_at(w, 99), 8);
}

TEST(GltfAnimations, GoStraight) {
  const GltfWriter w = moving("LINEAR", {0, 0, 0, 8, 0, 0});
  EXPECT_EQ(x_at(w, 0), 0);
  EXPECT_EQ(x_at(w, 1.5), 2);
  EXPECT_EQ(x_at(w, 3), 8);
  // 3 s long, its first second still; then again.
  EXPECT_NEAR(x_at(w, 4.5, true), 2, 1e-12);
}

// Hermite's curve of 0, slope 1, to 8, slope -2, over 2 s, at a quarter.
TEST(GltfAnimations, GoByCubicSplines) {
  const GltfWriter w = moving("CUBICSPLINE", {9, 0, 0, 0, 0, 0, 1, 0, 0, -2, 0, 0, 8, 0, 0, 9, 0, 0});
  const double t = 0.25, span = 2;
  const double wanted = span * (t * t * t - 2 * t * t + t) * 1 + (3 * t * t - 2 * t * t * t) * 8 +
                        span * (t * t * t - t * t) * -2;
  EXPECT_NEAR(x_at(w, 1.5), wanted, 1e-12);
}

// From 0° to 90° about z the short way, though the second quaternion has the other sign.
TEST(GltfAnimations, TurnTheShortWay) {
  GltfWriter w;
  w.node({{"mesh", w.triangle()}});
  w.add("animations",
        {{"samplers",
          {{{"input", w.accessor(std::vector<float>{0, 1}, "SCALAR")},
            {"output", w.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, -half, -half}, "VEC4")}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}});
  const double third = std::numbers::pi / 6;
  expect_near(meshes_of(w, 1.0 / 3, false).at(0).point(1), {std::cos(third), std::sin(third), 0});
}

// Two joints: one stands, one turns about (0, 1, 0). The point (0, 2, 0) is bound to the second.
GltfWriter skinned() {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 2, 0});
  p["attributes"]["JOINTS_0"] =
      w.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
  p["attributes"]["WEIGHTS_0"] =
      w.accessor(std::vector<float>{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0}, "VEC4");
  const std::vector<float> bind{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
  w.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", w.accessor(bind, "MAT4")}});
  w.node({{"mesh", w.mesh(p)}, {"skin", 0}, {"translation", {50, 0, 0}}});  // does not count
  w.node({{"children", {2}}});
  w.node({{"translation", {0, 1, 0}}});
  w.add("animations", {{"samplers",
                        {{{"input", w.accessor(std::vector<float>{0, 1}, "SCALAR")},
                          {"output", w.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, half, half}, "VEC4")}}}},
                       {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}}}});
  return w;
}

TEST(GltfSkins, TakePointsWithTheirJoints) {
  const auto rest = meshes_of(skinned(), 0, false);
  expect_near(rest.at(0).point(2), {0, 2, 0});
  const auto turned = meshes_of(skinned(), 1, false);
  expect_near(turned.at(0).point(0), {0, 0, 0});
  expect_near(turned.at(0).point(2), {-1, 1, 0});  // (0, 1, 0) above the joint, turned by 90°
  // Half of (1, 0, 0) where it is, half of it turned about (0, 1, 0): to (1, 2, 0).
  expect_near(turned.at(0).point(1), {1, 1, 0});
}

TEST(GltfMorphs, AddTargetsByWeight) {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::size_t up = w.accessor(std::vector<float>{0, 0, 4, 0, 0, 0, 0, 0, 0}, "VEC3");
  const std::size_t along = w.accessor(std::vector<float>{2, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
  p["targets"] = {{{"POSITION", up}}, {{"POSITION", along}}};
  const std::size_t mesh = w.mesh(p);
  w.root["meshes"][mesh]["weights"] = {0.5, 0};
  w.node({{"mesh", mesh}});
  w.add("animations", {{"samplers",
                        {{{"input", w.accessor(std::vector<float>{0, 1}, "SCALAR")},
                          {"output", w.accessor(std::vector<float>{0, 0, 1, 0.5f}, "SCALAR")}}}},
                       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
  gltf::File file = open_gltf(w.save(test_folder()));
  expect_near(meshes_at(file, 0.5, false).at(0).point(0), {0.5, 0, 2});
  expect_near(meshes_at(file, 1, false).at(0).point(0), {1, 0, 4});
  // Without an animation the mesh's own weights count.
  expect_near(meshes_at(file, 0.5, false, "").at(0).point(0), {0, 0, 2});
}

}  // namespace UNNAMED
}  // namespace tyndall
