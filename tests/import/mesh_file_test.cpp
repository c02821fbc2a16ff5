// PLY and OBJ files: what they hold, and what is said of those that are not as they should be.
#include "import/mesh/mesh_file.h"

#include <algorithm>

#include "opened.h"
#include "support/test_folder.h"

namespace tyndall {
namespace UNNAMED {

mesh_file::MeshFile read_file(const std::filesystem::path& path) {
  return mesh_file::read(path, [folder = path.parent_path()](const std::string& name, std::string& why) {
    std::optional<std::filesystem::path> found = folder / name;
    if (std::filesystem::exists(*found)) return found;
    why = "names '" + name + "', and there is no such file";
    return std::optional<std::filesystem::path>{};
  });
}
mesh_file::MeshFile read_text(const std::string& name, const std::string& text) {
  return read_file(write_bytes(test_folder() / name, text));
}
std::string mesh_problem(const std::string& name, const std::string& text) {
  try {
    read_text(name, text);
    return {};
  } catch (const Malformed& m) {
    return describe(m, name);
  }
}

const std::string square_ply = R"(ply
format ascii 1.0
comment a square
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 255 0
1 1 0 0 0 255
0 1 0.5 188 188 188
4 0 1 2 3
)";

TEST(Ply, IsReadAsText) {
  const mesh_file::MeshFile file = read_text("square.ply", square_ply);
  ASSERT_EQ(file.parts.size(), 1u);
  const scene::TriangleMesh& mesh = file.parts[0].mesh;
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  expect_near(mesh.points[3], {0, 1, 0.5});
  ASSERT_EQ(mesh.colors.size(), 4u);
  EXPECT_EQ(mesh.colors[0], (std::array<float, 4>{1, 0, 0, 1}));
  EXPECT_NEAR(mesh.colors[3][0], 0.5, 0.005);  // sRGB 188
  EXPECT_TRUE(file.parts[0].material);
}

// A triangle in binary, of either byte order.
std::string binary_ply(bool big) {
  std::string out = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                    "_endian 1.0\nelement vertex 3\nproperty double x\nproperty float y\nproperty short z\n"
                    "property float quality\nelement face 1\nproperty uchar flags\n"
                    "property list ushort uint vertex_index\nend_header\n";
  const auto put = [&](auto value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof(value));
    if (big) std::reverse(bytes.begin(), bytes.end());
    out += bytes;
  };
  for (int i = 0; i < 3; ++i) {
    put(0.5 * i);
    put(1.25f * static_cast<float>(i));
    put(static_cast<std::int16_t>(-300 * i * i));
    put(9.0f);
  }
  put(std::uint8_t{7});
  put(std::uint16_t{3});
  for (const std::uint32_t corner : {2u, 0u, 1u}) put(corner);
  return out;
}

TEST(Ply, IsReadInEitherByteOrder) {
  for (const bool big : {false, true}) {
    const auto mesh = read_text("binary.ply", binary_ply(big)).parts.at(0).mesh;
    EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{2, 0, 1}}));
    expect_near(mesh.points[2], {1, 2.5, -1200});
  }
}

TEST(Ply, TellsWhatIsWrong) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = square_ply;
    return mesh_problem("square.ply", text.replace(text.find(from), from.size(), to));
  };
  EXPECT_EQ(with("ply\n", "plx\n"), "'square.ply' is no PLY: it does not begin with 'ply'");
  EXPECT_EQ(with("4 0 1 2 3", "4 0 1 2 4"), "'square.ply': face 0 names vertex 4, and there are 4");
  EXPECT_EQ(with("4 0 1 2 3", "4 0 1 2 -1"), "'square.ply': face 0 names vertex -1, and there are 4");
  EXPECT_EQ(with("4 0 1 2 3", "99 0 1 2 3"), "'square.ply': face 0 has a list of 99");
  EXPECT_EQ(with("vertex 4", "vertex 4611686018427387904"),
            "'square.ply': element vertex is promised 4611686018427387904 times, and 72 bytes are left");
  EXPECT_EQ(with("1 0 0 0 255 0", "nan 0 0 0 255 0"), "'square.ply': vertex 1 has x nan");
  EXPECT_EQ(with("1 0 0 0 255 0", "1 0 0 0 many 0"), "'square.ply': byte 22 of the data is no number");
  EXPECT_EQ(with("ascii", "ebcdic"), "'square.ply': line 2 names a format that PLY does not know");
  EXPECT_EQ(with("face 1", "face 0"), "'square.ply' has no faces");
}

TEST(Ply, MayBeCutAnywhere) {
  const auto folder = test_folder();
  for (const std::string& whole : {square_ply, binary_ply(false), binary_ply(true)})
    for (std::size_t part = 0; part < 50; ++part) {
      const std::string cut = whole.substr(0, (whole.size() - 2) * part / 50);
      EXPECT_NE(mesh_problem("cut.ply", cut), "") << part;
    }
}

const std::string square_obj = R"(mtllib paint.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl Red
f 1/1/1 2/2/1 3/3/1 4/4/1
usemtl Glass
f 1 2 -1
)";

TEST(Obj, HasPartsByMaterial) {
  const auto folder = test_folder();
  write_bytes(folder / "paint.mtl",
              "newmtl Red\nKd 0.8 0.1 0.1\nKs 1 1 1\nNs 98\nillum 2\nKe 0 2 0\n"
              "newmtl Glass\nKd 1 1 1\nd 0.25\nNi 1.33\nillum 7\n");
  const mesh_file::MeshFile file = read_file(write_bytes(folder / "square.obj", square_obj));
  ASSERT_EQ(file.parts.size(), 2u);
  const scene::TriangleMesh& red = file.parts[0].mesh;
  EXPECT_EQ(red.points.size(), 4u);
  EXPECT_EQ(red.triangles.size(), 2u);
  for (std::size_t i = 0; i < red.points.size(); ++i)
    EXPECT_EQ(red.uvs[i], (Pair<double>{red.points[i].x, red.points[i].y}));
  expect_near(red.normals[0], {0, 0, 1});
  EXPECT_TRUE(file.parts[1].mesh.uvs.empty());
  const pbr::Material& paint = file.materials.at(*file.parts[0].material);
  EXPECT_EQ(paint.name, "Red");
  EXPECT_EQ(paint.base_color, (Rgb{0.8f, 0.1f, 0.1f}));
  EXPECT_EQ(paint.emissive, (Rgb{0, 2, 0}));
  EXPECT_NEAR(paint.roughness, std::pow(0.02, 0.25), 1e-6);
  const pbr::Material& glass = file.materials.at(*file.parts[1].material);
  EXPECT_EQ(glass.transmission, 0.75f);
  EXPECT_EQ(glass.ior, 1.33f);
}

TEST(Obj, GoesWithoutMaterialsThatAreNotThere) {
  const mesh_file::MeshFile file = read_text("square.obj", square_obj);
  EXPECT_EQ(file.warnings, std::vector<std::string>{"names 'paint.mtl', and there is no such file"});
  ASSERT_EQ(file.parts.size(), 1u);
  EXPECT_FALSE(file.parts[0].material);
}

TEST(Obj, TellsWhatIsWrong) {
  EXPECT_EQ(mesh_problem("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
            "'a.obj': a face names point 9, and there are 3");
  EXPECT_EQ(mesh_problem("a.obj", "v 0 0 0\n"), "'a.obj' has no faces");
  EXPECT_EQ(mesh_problem("a.stl", "solid"), "'a.stl' is no .ply or .obj; a .gltf or .glb is a `gltf`");
  const auto folder = test_folder();
  for (std::size_t part = 0; part < 50; ++part)  // sound or an error: lines are all there is to cut
    mesh_problem("cut.obj", square_obj.substr(0, square_obj.size() * part / 50));
}

}  // namespace UNNAMED
}  // namespace tyndall
