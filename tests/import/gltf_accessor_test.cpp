// Accessors of every kind, and the primitives that are made of them.
#include "opened.h"
#include "support/test_folder.h"

namespace tyndall {
namespace UNNAMED {

// One mesh of one primitive, in one node.
scene::TriangleMesh only_mesh(GltfWriter writer, json primitive) {
  writer.node({{"mesh", writer.mesh(std::move(primitive))}});
  std::vector<PlacedMesh> all = meshes_of(writer);
  EXPECT_EQ(all.size(), 1u);
  return all.empty() ? scene::TriangleMesh{} : std::move(all[0].mesh);
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
const std::vector<float> five{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

TEST(GltfPrimitives, HaveTheTrianglesOfTheirModes) {
  const auto triangles = [](int mode, std::size_t points) {
    GltfWriter w;
    json p = w.primitive({five.begin(), five.begin() + static_cast<std::ptrdiff_t>(3 * points)});
    p["mode"] = mode;
    return only_mesh(w, p).triangles;
  };
  EXPECT_EQ(triangles(4, 3), (Triangles{{0, 1, 2}}));
  EXPECT_EQ(triangles(5, 5), (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(triangles(6, 5), (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(GltfPrimitives, OfPointsAndLinesAreNoMeshes) {
  GltfWriter w;
  for (int mode = 0; mode < 4; ++mode) {
    json p = w.primitive(five);
    p["mode"] = mode;
    w.node({{"mesh", w.mesh(p)}});
  }
  gltf::File file = open_gltf(w.save(test_folder()));
  EXPECT_TRUE(meshes_at(file).empty());
  EXPECT_EQ(file.warnings(), std::vector<std::string>{"holds points, which are left out"});
}

template <class T>
class GltfIndices : public testing::Test {};
using IndexTypes = testing::Types<std::uint8_t, std::uint16_t, std::uint32_t>;
TYPED_TEST_SUITE(GltfIndices, IndexTypes);
TYPED_TEST(GltfIndices, OfEveryType) {
  GltfWriter w;
  json p = w.primitive(five);
  p["indices"] = w.accessor(std::vector<TypeParam>{4, 2, 3}, "SCALAR");
  EXPECT_EQ(only_mesh(w, p).triangles, (Triangles{{4, 2, 3}}));
}

TEST(GltfAccessors, FollowStridesAndOffsets) {
  GltfWriter w;
  // Two floats before each position, and a position before the first that counts.
  std::vector<float> numbers;
  for (float i = 0; i < 4; ++i)
    for (const float f : {-1.0f, -1.0f, i, 10 + i, 20 + i}) numbers.push_back(f);
  const std::size_t accessor = w.accessor(std::vector<float>{0}, "SCALAR");
  const std::size_t view = w.view(numbers);
  w.root["bufferViews"][view]["byteStride"] = 20;
  w.root["accessors"][accessor] = {
      {"bufferView", view}, {"byteOffset", 28}, {"componentType", float32}, {"count", 3}, {"type", "VEC3"}};
  const auto mesh = only_mesh(w, {{"attributes", {{"POSITION", accessor}}}});
  ASSERT_EQ(mesh.points.size(), 3u);
  expect_near(mesh.points[0], {1, 11, 21});
  expect_near(mesh.points[2], {3, 13, 23});
}

TEST(GltfAccessors, MakeNormalisedNumbersFractions) {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::size_t uvs = w.accessor(std::vector<std::uint16_t>{0, 65535, 32768, 0, 65535, 65535}, "VEC2");
  const std::size_t normals = w.accessor(std::vector<std::int8_t>{0, 0, 127, 0, -128, 0, 127, 0, 0}, "VEC3");
  w.root["accessors"][uvs]["normalized"] = true;
  w.root["accessors"][normals]["normalized"] = true;
  p["attributes"]["TEXCOORD_0"] = uvs;
  p["attributes"]["NORMAL"] = normals;
  const auto mesh = only_mesh(w, p);
  // v runs down in the file and up here.
  EXPECT_EQ(mesh.uvs[0], (Pair<double>{0, 0}));
  EXPECT_NEAR(mesh.uvs[1].x, 32768 / 65535.0, 1e-7);
  EXPECT_EQ(mesh.uvs[1].y, 1);
  expect_near(mesh.normals[0], {0, 0, 1});
  expect_near(mesh.normals[1], {0, -1, 0});
}

// KHR_mesh_quantization: positions as whole numbers, as they are.
TEST(GltfAccessors, TakePositionsOfWholeNumbers) {
  GltfWriter w;
  const std::size_t points = w.accessor(std::vector<std::int16_t>{0, 0, 0, 300, 0, 0, 0, -500, 0}, "VEC3");
  const auto mesh = only_mesh(w, {{"attributes", {{"POSITION", points}}}});
  expect_near(mesh.points[1], {300, 0, 0});
  expect_near(mesh.points[2], {0, -500, 0});
}

TEST(GltfAccessors, ReplaceWhatSparseOnesSay) {
  GltfWriter w;
  json p = w.primitive(five);
  json sparse = {
      {"count", 2},
      {"indices", {{"bufferView", w.view(std::vector<std::uint16_t>{1, 4})}, {"componentType", uint16}}},
      {"values", {{"bufferView", w.view(std::vector<float>{7, 8, 9, 4, 5, 6})}}}};
  w.root["accessors"][p["attributes"]["POSITION"].get<std::size_t>()]["sparse"] = sparse;
  p["indices"] = w.accessor(std::vector<std::uint8_t>{0, 1, 4}, "SCALAR");
  const auto mesh = only_mesh(w, p);
  expect_near(mesh.points[1], {7, 8, 9});
  expect_near(mesh.points[2], {0, 1, 0});
  expect_near(mesh.points[4], {4, 5, 6});
  // Without a buffer view all others are 0.
  w.root["accessors"].push_back(
      {{"componentType", float32}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}});
  w.root["accessors"].back()["sparse"]["indices"]["bufferView"] = w.view(std::vector<std::uint16_t>{1, 2});
  const auto zeros = only_mesh(w, {{"attributes", {{"POSITION", w.root["accessors"].size() - 1}}}});
  expect_near(zeros.points[0], {0, 0, 0});
  expect_near(zeros.points[1], {7, 8, 9});
}

// A texture's u grows along x, its v (down in the file) against y: the tangent is x, the bitangent y.
TEST(GltfTangents, AreMadeOfTextureCoordinates) {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  p["attributes"]["TEXCOORD_0"] = w.accessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2");
  p["attributes"]["NORMAL"] = w.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  w.add("images", {{"uri", "none.png"}});
  w.add("textures", {{"source", 0}});
  p["material"] = w.add("materials", {{"normalTexture", {{"index", 0}}}});
  auto mesh = only_mesh(w, p);
  ASSERT_EQ(mesh.tangents.size(), 3u);
  EXPECT_EQ(mesh.tangents[1], (std::array<float, 4>{1, 0, 0, 1}));
  // A mirrored texture turns the tangent and the sign.
  p["attributes"]["TEXCOORD_0"] = w.accessor(std::vector<float>{1, 1, 0, 1, 1, 0}, "VEC2");
  mesh = only_mesh(w, p);
  EXPECT_EQ(mesh.tangents[1], (std::array<float, 4>{-1, 0, 0, -1}));
}

}  // namespace UNNAMED
}  // namespace tyndall
