// Lines of glTF files become rods, which have a width; points are told and left out.
#include <cmath>

#include "opened.h"
#include "resolve/resolve.h"
#include "support/test_folder.h"
#include "syntax/parser.h"

namespace tyndall {
namespace UNNAMED {

struct Resolved {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  scene::Scene scene;
  std::string messages() const { return render_text(diagnostics, sources, false); }
};
Resolved resolve_in(const std::filesystem::path& folder, const std::string& text) {
  Resolved r;
  const SourceId source = r.sources.add((folder / "scene.tyn").string(),
                                        "camera perspective { from: (0, 0, 5) to: (0, 0, 0) }\n"
                                        "light environment { radiance: 1 }\n" +
                                            text);
  const syntax::TokenList tokens = syntax::lex(r.sources, source, r.diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(r.sources, source, tokens, r.symbols, r.diagnostics);
  r.scene = resolve::resolve(tree, r.sources, r.symbols, {}, r.diagnostics);
  return r;
}

enum Mode { points, lines, line_loop, line_strip };

// A square's corners (0, 0), (3, 0), (3, 4), (0, 4).
GltfWriter drawn(Mode mode) {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 3, 0, 0, 3, 4, 0, 0, 4, 0});
  p["mode"] = mode;
  w.node({{"mesh", w.mesh(p)}, {"scale", {2, 2, 2}}});
  return w;
}

TEST(GltfLines, AreRodsFromEndToEnd) {
  const auto folder = test_folder();
  const auto ends = [&](Mode mode) {
    drawn(mode).save(folder);
    const Resolved r = resolve_in(folder, "gltf \"test.glb\" {}");
    EXPECT_EQ(r.messages(), "");
    return r.scene.strand_sets.at(0);
  };
  const scene::StrandSet separate = ends(lines), strip = ends(line_strip), loop = ends(line_loop);
  ASSERT_EQ(separate.strands(), 2u);
  ASSERT_EQ(strip.strands(), 3u);
  ASSERT_EQ(loop.strands(), 4u);
  const auto expect_ends = [](const scene::StrandSet& set, std::size_t i, const Vec3d& a, const Vec3d& b) {
    ASSERT_EQ(set.begin[i + 1] - set.begin[i], 2u);
    EXPECT_EQ(set.points[set.begin[i]], a);
    EXPECT_EQ(set.points[set.begin[i] + 1], b);
  };
  expect_ends(separate, 0, {0, 0, 0}, {3, 0, 0});
  expect_ends(separate, 1, {3, 4, 0}, {0, 4, 0});
  expect_ends(strip, 1, {3, 0, 0}, {3, 4, 0});
  expect_ends(loop, 3, {0, 4, 0}, {0, 0, 0});
}

// The box around all lines has the diagonal 2 · 5, in the file's space; radii are in the mesh's, half as
// large.
TEST(GltfLines, AreAFiveHundredthOfTheirBoxWideOrAsWideAsIsSaid) {
  const auto folder = test_folder();
  drawn(line_loop).save(folder);
  EXPECT_NEAR(resolve_in(folder, "gltf \"test.glb\" {}").scene.strand_sets.at(0).radii.at(0),
              10.0 / 500 / 2 / 2, 1e-15);
  EXPECT_NEAR(
      resolve_in(folder, "gltf \"test.glb\" { line_width: 40cm }").scene.strand_sets.at(0).radii.at(0),
      0.4 / 2 / 2, 1e-15);
  const Resolved zero = resolve_in(folder, "gltf \"test.glb\" { line_width: 0 }");
  EXPECT_NE(zero.messages().find("'line_width' must be above 0, found 0"), std::string::npos)
      << zero.messages();
}

TEST(GltfLines, HaveTheMaterialOfTheirPrimitive) {
  const auto folder = test_folder();
  GltfWriter w = drawn(lines);
  w.root["meshes"][0]["primitives"][0]["material"] = w.add("materials", {{"name", "Wire"}});
  w.root["meshes"][0]["primitives"].push_back(w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  w.save(folder);
  const Resolved r =
      resolve_in(folder, "gltf \"test.glb\" { materials: [[\"Wire\", { base_color = 0.1 }]] }");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.prototypes.size(), 1u);
  ASSERT_EQ(r.scene.prototypes[0].shapes.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<scene::Mesh>(r.scene.prototypes[0].shapes[0].shape));
  EXPECT_TRUE(std::holds_alternative<scene::Curves>(r.scene.prototypes[0].shapes[1].shape));
  EXPECT_TRUE(r.scene.prototypes[0].shapes[1].material.valid());
}

TEST(GltfLines, WithoutALengthAreNone) {
  const auto folder = test_folder();
  GltfWriter w;
  json p = w.primitive({1, 1, 1, 1, 1, 1});
  p["mode"] = lines;
  w.node({{"mesh", w.mesh(p)}});
  w.save(folder);
  const Resolved r = resolve_in(folder, "gltf \"test.glb\" {}");
  EXPECT_EQ(r.messages(), "");
  EXPECT_EQ(r.scene.strand_sets.at(0).strands(), 0u);
}

TEST(GltfLines, TellOfPointsOnce) {
  const auto folder = test_folder();
  GltfWriter w = drawn(points);
  w.root["meshes"][0]["primitives"].push_back(w.root["meshes"][0]["primitives"][0]);
  w.save(folder);
  const Resolved r = resolve_in(folder, "gltf \"test.glb\" {}");
  EXPECT_EQ(r.diagnostics.all().size(), 1u);
  EXPECT_NE(r.messages().find("'test.glb' holds points, which are left out"), std::string::npos);
}

}  // namespace UNNAMED
}  // namespace tyndall
