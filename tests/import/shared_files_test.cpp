// Files that no one here made (../shared/data): each renders from a three-line scene. Skipped where they are
// not there.
#include <set>

#include "compile/compiled_scene.h"
#include "opened.h"
#include "render/render.h"
#include "resolve/resolve.h"
#include "support/filled.h"
#include "syntax/parser.h"

namespace tyndall {
namespace UNNAMED {

const std::filesystem::path shared_data = std::filesystem::path(TYNDALL_SOURCE_DIR) / "../shared/data";

// The picture of a scene that stands in the folder.
std::vector<Rgb> picture(const std::string& text, const std::string& stats_of = {}) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add((shared_data / "scene.tyn").string(), text);
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  scene::Scene scene = resolve::resolve(tree, sources, symbols, {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << stats_of << render_text(diagnostics, sources, false);
  if (diagnostics.has_errors()) return {};
  scene.settings.resolution.width = scene.settings.resolution.height = 16;
  scene.settings.samples = 4;
  scene.settings.bounces = 4;
  const compile::CompiledScene world = compile::compile(std::move(scene));
  const render::RenderResult result = render::render(world, {});
  EXPECT_EQ(result.statistics.bad_samples, 0u);
  const image::Image image = result.film.image();
  std::vector<Rgb> out;
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
    out.push_back({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
  return out;
}
// How many different colours there are: 1 for a picture of nothing.
std::size_t colors(const std::vector<Rgb>& pixels) {
  std::set<std::tuple<float, float, float>> seen;
  for (const Rgb& p : pixels) seen.emplace(p.x, p.y, p.z);
  return seen.size();
}

#define SKIP_WITHOUT(file) \
  if (!std::filesystem::exists(shared_data / (file))) GTEST_SKIP() << "no " << (shared_data / (file))

TEST(SharedFiles, BoxTexturedRenders) {
  SKIP_WITHOUT("BoxTextured.glb");
  EXPECT_GT(colors(picture(
                "camera perspective { from: (0, 0.5, 3) to: (0, 0, 0) }\nlight environment { radiance: 1 }\n"
                "gltf \"BoxTextured.glb\" {}")),
            20u);
}

TEST(SharedFiles, EngineRenders) {
  SKIP_WITHOUT("2CylinderEngine.glb");
  EXPECT_GT(
      colors(picture(
          "camera perspective { from: (500, 400, 900) to: (0, 0, 0) }\nlight environment { radiance: 1 }\n"
          "gltf \"2CylinderEngine.glb\" {}")),
      50u);
  // By its own camera.
  EXPECT_GT(colors(picture("camera gltf \"2CylinderEngine.glb\" {}\nlight environment { radiance: 1 }\n"
                           "gltf \"2CylinderEngine.glb\" {}")),
            50u);
}

TEST(SharedFiles, MorphCubeMoves) {
  SKIP_WITHOUT("AnimatedMorphCube/AnimatedMorphCube.gltf");
  const auto at = [](int frame) {
    return picture(support::filled(R"(
animation { fps: 10  frames: $FRAME..$FRAME }
camera perspective { from: (3, 3, 6)  to: (0, 0, 0) }
light environment { radiance: 1 }
gltf "AnimatedMorphCube/AnimatedMorphCube.gltf" {}
)",
                                   {{"FRAME", frame}}));
  };
  const auto first = at(0);
  EXPECT_GT(colors(first), 20u);
  EXPECT_NE(first, at(8));
}

TEST(SharedFiles, SkinMoves) {
  SKIP_WITHOUT("simple_skin.gltf");
  const auto at = [](int frame) {
    return picture(support::filled(R"(
animation { fps: 10  frames: $FRAME..$FRAME }
camera perspective { from: (0.5, 1, 5)  to: (0.5, 1, 0) }
light environment { radiance: 1 }
light point { position: (0, 3, 3)  power: 100 }
gltf "simple_skin.gltf" {}
)",
                                   {{"FRAME", frame}}));
  };
  const auto first = at(0);
  EXPECT_GT(colors(first), 10u);
  EXPECT_NE(first, at(15));
}

}  // namespace UNNAMED
}  // namespace tyndall
