// Programs of others as judges: Khronos' validator of glTF looks at our fixtures, and glTF-Transform writes
// files that must look here as the plain one does. scripts/judges installs them; without them these tests are
// skipped.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "compile/compiled_scene.h"
#include "image/image.h"
#include "import/gltf_writer.h"
#include "render/render.h"
#include "resolve/resolve.h"
#include "support/filled.h"
#include "syntax/parser.h"

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

const fs::path judges = fs::path(TYNDALL_JUDGES_DIR);

// What a command prints, and whether it ended well.
struct Output {
  std::string text;
  bool good = false;
};
Output output_of(const std::string& command) {
  Output out;
  FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return out;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    out.text.append(buffer.data(), n);
  out.good = ::pclose(pipe) == 0;
  return out;
}

class Judges : public testing::Test {
 protected:
  void SetUp() override {
    if (!output_of("node -e 'process.exit(parseInt(process.versions.node) >= 20 ? 0 : 1)'").good)
      GTEST_SKIP() << "there is no Node.js of version 20 or later";
    for (const char* module : {"gltf-validator", "@gltf-transform/core", "@gltf-transform/extensions",
                               "@gltf-transform/functions", "draco3dgltf", "meshoptimizer", "sharp"})
      if (!fs::exists(judges / "node_modules" / module))
        GTEST_SKIP() << module << " is not installed: run scripts/judges";
    // Modules are found beside the script that asks for them.
    for (const char* script : {"validate.mjs", "transform.mjs"})
      fs::copy_file(fs::path(TYNDALL_SOURCE_DIR) / "tests/judges" / script, judges / script,
                    fs::copy_options::overwrite_existing);
  }
};

void expect_sound(const std::vector<fs::path>& files) {
  std::string command = fmt::format("node '{}'", (judges / "validate.mjs").string());
  for (const fs::path& file : files) command += fmt::format(" '{}'", file.string());
  const Output out = output_of(command);
  EXPECT_TRUE(out.good) << out.text;
}

std::vector<fs::path> gltfs_below(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
      out.push_back(entry.path());
  return out;
}

TEST_F(Judges, FindOurModelsSound) {
  const auto models = gltfs_below(fs::path(TYNDALL_SOURCE_DIR) / "scenes/models");
  ASSERT_GE(models.size(), 3u);
  expect_sound(models);
}

// What the tests of importers write where they expect no complaint. (A file that the test wants to be
// refused, or that shows what is done with what glTF does not allow, is not among them.)
TEST_F(Judges, FindTheFixturesOfOurTestsSound) {
  const fs::path folder = judges / "fixtures";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string filter =
      "GltfNodes.*:GltfAnimations.*:GltfSkins.*:GltfMorphs.*:GltfBlur.*:GltfLines.*:RenderedGltf.*:"
      "GltfMaterials.*"
      "-GltfMaterials.TellOfPicturesThatCannotBeRead:GltfMaterials.TellWhatIsNotReadOnceByName";
  const Output ran = output_of(fmt::format("TMPDIR='{}' TYNDALL_KEEP_TEST_FILES=1 '{}' --gtest_filter='{}'",
                                           folder.string(), TYNDALL_TEST_IMPORT, filter));
  EXPECT_TRUE(ran.good) << ran.text;
  const auto files = gltfs_below(folder);
  ASSERT_GE(files.size(), 20u);
  expect_sound(files);
}

// ------------------------------------------------------------------------------------------ packed by others

// Textured balls in a row, which share a mesh that a sparse morph target dents.
GltfWriter balls() {
  GltfWriter w;
  constexpr int around = 24, rows = 13;
  std::vector<float> points, normals, uvs, dent;
  std::vector<std::uint16_t> corners;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i <= around; ++i) {
      const double phi = 2 * pi * i / around, theta = pi * j / (rows - 1);
      const std::array<double, 3> p{std::sin(theta) * std::cos(phi), std::cos(theta),
                                    std::sin(theta) * std::sin(phi)};
      for (const double x : p) points.push_back(static_cast<float>(x));
      for (const double x : p) normals.push_back(static_cast<float>(x));
      uvs.insert(uvs.end(), {static_cast<float>(i) / around, static_cast<float>(j) / (rows - 1)});
      dent.insert(dent.end(), {0, 0, j == 3 ? -0.3f : 0});
      if (j == 0 || i == 0) continue;
      const int n = around + 1, a = (j - 1) * n + i - 1, b = a + 1, c = a + n, d = c + 1;
      for (const int corner : {a, b, c, b, d, c}) corners.push_back(static_cast<std::uint16_t>(corner));
    }
  json p = w.primitive(points);
  p["attributes"]["NORMAL"] = w.accessor(normals, "VEC3");
  p["attributes"]["TEXCOORD_0"] = w.accessor(uvs, "VEC2");
  p["indices"] = w.accessor(corners, "SCALAR");
  p["targets"] = {{{"POSITION", w.accessor(dent, "VEC3")}}};
  w.add("images", {{"bufferView", w.view(std::vector<std::uint8_t>{})}, {"mimeType", "image/png"}});
  w.add("textures", {{"source", 0}});
  p["material"] = w.add(
      "materials", {{"pbrMetallicRoughness",
                     {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}});
  const std::size_t mesh = w.mesh(p);
  w.root["meshes"][mesh]["weights"] = {1};
  for (int i = -1; i <= 1; ++i)
    w.node({{"mesh", mesh}, {"translation", {2.2 * i, 0, 0}}, {"scale", {1, 1 + 0.3 * i, 1}}});
  w.root["scenes"] = {{{"nodes", {0, 1, 2}}}};
  w.root["scene"] = 0;
  return w;
}

// The picture of a soft pattern is put at the end of the buffer.
void add_picture(GltfWriter& w, const fs::path& folder) {
  image::Image picture{64, 32, {"R", "G", "B"}, {}};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const double u = 2 * pi * x / 64, v = pi * y / 32;
      for (const double c : {std::cos(2 * u), std::sin(3 * v), std::sin(u + v)})
        picture.pixels.push_back(static_cast<float>(0.5 + 0.3 * c));
    }
  ASSERT_EQ(image::write((folder / "soft.png").string(), picture, {}), "");
  std::ifstream file(folder / "soft.png", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  w.root["images"][0]["bufferView"] = w.view(std::vector<char>(bytes.begin(), bytes.end()));
}

constexpr int width = 48, height = 24, samples = 64;

image::Image picture_of(const fs::path& folder, const std::string& file) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const std::string text = support::filled(R"(
camera orthographic { from: (0, 0, 9)  to: (0, 0, 0)  height: 3.4 }
light environment { radiance: 1 }
gltf "$FILE" {}
)",
                                           {{"FILE", file}});
  const SourceId source = sources.add((folder / "scene.tyn").string(), text);
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  scene::Scene scene = resolve::resolve(tree, sources, symbols, {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << file << ": " << render_text(diagnostics, sources, false);
  scene.settings.resolution = {width, height};
  scene.settings.samples = samples;
  scene.settings.bounces = 1;
  const compile::CompiledScene world = compile::compile(std::move(scene));
  return render::render(world, {}).film.image();
}

json root_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof(length));
  return json::parse(bytes.substr(20, length));
}

// glTF-Transform keeps points with 14 bits of their extent, so that they are off by half a step at most;
// texture coordinates with 12 bits, which is a part of a texel; normals with 8 bits at least. What a pixel
// shows changes with its edges by how far these move in pixels, and with texels and normals by their slopes.
double tolerance_of_means() {
  const double pixels_per_unit = height / 3.4, extent = 6.4;
  const double edges = 2 * pixels_per_unit * extent / (1 << 14);  // two edges across a pixel, contrast 1
  const double texels = 0.3 * 2 * pi * 3 / (1 << 12);             // the pattern's steepest slope
  const double normals = 1.0 / 127;                               // the cosine's slope is 1 at most
  return edges + texels + normals;
}

TEST_F(Judges, WriteFilesThatLookAsTheyDid) {
  const fs::path folder = judges / "packed";
  fs::remove_all(folder);
  fs::create_directories(folder);
  GltfWriter w = balls();
  add_picture(w, folder);
  w.save(folder, "balls.glb");
  const Output written = output_of(fmt::format("node '{}' '{}' '{}'", (judges / "transform.mjs").string(),
                                               (folder / "balls.glb").string(), folder.string()));
  ASSERT_TRUE(written.good) << written.text;
  const image::Image plain = picture_of(folder, "balls.glb");
  std::istringstream names(written.text);
  int files = 0;
  for (std::string name; std::getline(names, name); ++files) {
    const std::string file = name + ".glb";
    const json root = root_of(folder / file);
    const auto used = root.value("extensionsUsed", std::set<std::string>{});
    const bool sparse = std::any_of(root["accessors"].begin(), root["accessors"].end(),
                                    [](const json& accessor) { return accessor.contains("sparse"); });
    const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
    EXPECT_EQ(has("draco"), used.contains("KHR_draco_mesh_compression")) << name;
    EXPECT_EQ(has("meshopt"), used.contains("EXT_meshopt_compression")) << name;
    EXPECT_EQ(has("webp"), used.contains("EXT_texture_webp")) << name;
    EXPECT_EQ(has("instancing"), used.contains("EXT_mesh_gpu_instancing")) << name;
    // What is quantised is written whole.
    EXPECT_EQ(has("sparse") && !has("quantize") && !has("meshopt"), sparse) << name;
    const image::Image packed = picture_of(folder, file);
    ASSERT_EQ(packed.pixels.size(), plain.pixels.size());
    double off = 0, seen = 0;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
      off += std::abs(double{packed.pixels[i]} - double{plain.pixels[i]});
      seen += double{plain.pixels[i]};
    }
    const auto count = static_cast<double>(plain.pixels.size());
    EXPECT_LE(off / count, tolerance_of_means()) << name;
    EXPECT_GT(seen / count, 0.3) << name;
  }
  EXPECT_EQ(files, 32);
}

}  // namespace UNNAMED
}  // namespace tyndall
