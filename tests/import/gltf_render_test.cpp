// What the renderer sees of a model: colours of its points, texels of its textures, normals of its maps, at
// places with known answers.

#include "compile/compiled_scene.h"
#include "image/image.h"
#include "opened.h"
#include "render/render.h"
#include "resolve/resolve.h"
#include "support/filled.h"
#include "support/test_folder.h"
#include "syntax/parser.h"

namespace tyndall {
namespace UNNAMED {

// The colour that a narrow orthographic view along -z shows of the point (x, y).
Rgb seen_at(const std::filesystem::path& folder, double x, double y, const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add(
      (folder / "scene.tyn").string(),
      support::filled("camera orthographic { from: ($X, $Y, 9)  to: ($X, $Y, 0)  height: 1e-6 }\n$MORE",
                      {{"X", x}, {"Y", y}, {"MORE", text}}));
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  scene::Scene scene = resolve::resolve(tree, sources, symbols, {}, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << render_text(diagnostics, sources, false);
  scene.settings.resolution.width = scene.settings.resolution.height = 1;
  scene.settings.samples = 1;
  const compile::CompiledScene world = compile::compile(std::move(scene));
  const image::Image image = render::render(world, {}).film.image();
  return {image.pixels[0], image.pixels[1], image.pixels[2]};
}

void expect_color(const Rgb& found, const Rgb& wanted, float tolerance = 1e-4f) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], wanted[k], tolerance) << k;
}

const std::string light_elsewhere = "light point { position: (0, 0, 100)  power: 1e-9 }\n";

// A triangle that glows by what it reads.
GltfWriter glowing(json attributes, json material = json::object()) {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  for (const auto& [name, numbers] : attributes.items())
    p["attributes"][name] = w.accessor(numbers.get<std::vector<float>>(), numbers.size() == 6   ? "VEC2"
                                                                          : numbers.size() == 9 ? "VEC3"
                                                                                                : "VEC4");
  material["extensions"]["KHR_materials_unlit"] = json::object();
  p["material"] = w.add("materials", std::move(material));
  w.node({{"mesh", w.mesh(p)}});
  return w;
}

TEST(RenderedGltf, ShowsColoursOfPoints) {
  const auto folder = test_folder();
  glowing({{"COLOR_0", {1, 0, 0, 0, 1, 0, 0, 0, 1}}}).save(folder);
  const std::string scene = light_elsewhere + "gltf \"test.glb\" {}";
  expect_color(seen_at(folder, 0.25, 0.25, scene), {0.5f, 0.25f, 0.25f});
  expect_color(seen_at(folder, 0.1, 0.6, scene), {0.3f, 0.1f, 0.6f});
  // Mirrored and placed by an instance.
  expect_color(
      seen_at(folder, -2.5, 0.25,
              light_elsewhere + "gltf \"test.glb\" { transform: translate((-2, 0, 0)) * scale((-2, 1, 1)) }"),
      {0.5f, 0.25f, 0.25f});
}

// Three texels across: red, green, blue; the picture is lit from its second set of coordinates.
TEST(RenderedGltf, LooksUpTheSecondSetOfTextureCoordinates) {
  const auto folder = test_folder();
  const image::Image picture{3, 1, {"R", "G", "B"}, {1, 0, 0, 0, 1, 0, 0, 0, 1}};
  ASSERT_EQ(image::write((folder / "three.png").string(), picture, {}), "");
  GltfWriter w = glowing({{"TEXCOORD_0", {0.5, 0.5, 0.5, 0.5, 0.5, 0.5}}, {"TEXCOORD_1", {0, 0, 1, 0, 0, 1}}},
                         {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
  w.add("images", {{"uri", "three.png"}});
  w.add("samplers", {{"magFilter", 9728}});
  w.add("textures", {{"source", 0}, {"sampler", 0}});
  w.save(folder);
  const std::string scene = light_elsewhere + "gltf \"test.glb\" {}";
  expect_color(seen_at(folder, 0.2, 0.1, scene), {1, 0, 0});
  expect_color(seen_at(folder, 0.5, 0.1, scene), {0, 1, 0});
  expect_color(seen_at(folder, 0.8, 0.1, scene), {0, 0, 1});
}

// A matte face under a distant light along (1, 0, -1): its normal map leans it towards +x (u), by a texel
// whose red is 1 and blue 0.5 (stored linear), to (1, 0, 0). Lambert's law gives E cos 45° / π.
TEST(RenderedGltf, LeansNormalsByTheirMap) {
  const auto folder = test_folder();
  const float half = 0.21404114f;  // sRGB 0.5: what is stored as 128
  const image::Image picture{1, 1, {"R", "G", "B"}, {1, half, half}};
  ASSERT_EQ(image::write((folder / "lean.png").string(), picture, {}), "");
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  p["attributes"]["TEXCOORD_0"] = w.accessor(std::vector<float>{0, 1, 1, 1, 0, 0}, "VEC2");
  w.add("images", {{"uri", "lean.png"}});
  w.add("textures", {{"source", 0}});
  p["material"] =
      w.add("materials", {{"normalTexture", {{"index", 0}}},
                          {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
                          {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}});
  w.node({{"mesh", w.mesh(p)}});
  w.save(folder);
  const auto lit = [&](const char* direction) {
    return seen_at(folder, 0.2, 0.2,
                   support::filled(R"(
light distant { direction: $DIRECTION  irradiance: 3.14159265 }
gltf "test.glb" {}
)",
                                   {{"DIRECTION", direction}}));
  };
  // From the right the leaning face is bright, from the left it is dark; a flat one is the same from both.
  EXPECT_NEAR(lit("(-1, 0, -1)").x, std::sqrt(0.5), 0.02);
  EXPECT_LT(lit("(1, 0, -1)").x, 0.02);
}

}  // namespace UNNAMED
}  // namespace tyndall
