// Materials: colours that depend on the place, and outputs that wait for later surface models.
#include <gtest/gtest.h>

#include "compiled.h"

namespace tyndall::shader {
namespace {

TEST(Material, TilesOfTheLanguagePage) {
  BodyText text(
      "material tiles(size = 1) { base_color = if checker(p.xz / size) then 0.8 else 0.2 roughness = 0.4 } "
      "let m = tiles(size: 0.5)");
  const auto material = text.material();
  ASSERT_TRUE(material) << text.messages();
  ASSERT_EQ(text.diagnostics.all().size(), 1u) << text.messages();
  EXPECT_EQ(text.diagnostics.all()[0].severity, Severity::warning);
  EXPECT_EQ(text.diagnostics.all()[0].message, "'roughness' has no effect yet");
  const auto at = [&](float x) { return rgb(run(material->program, {{x, 0, 0.25f}}), material->base_color); };
  EXPECT_NE(at(0.25f), at(0.75f));
  EXPECT_EQ(at(0.25f), at(1.25f));
  EXPECT_TRUE(at(0.25f) == Rgb(0.8f) || at(0.25f) == Rgb(0.2f));
}

TEST(Material, ReadsEveryInput) {
  BodyText text(
      "material m() { base_color = clamp((p.x + P.y, n.z + N.x, uv.x + uv.y + time), 0, 1) emission = p }");
  const auto material = text.material();
  ASSERT_TRUE(material) << text.messages();
  Point at;
  at.p = {0.125f, 2, 3};
  at.P = {9, 0.25f, 9};
  at.n = {9, 9, 0.375f};
  at.N = {0.25f, 9, 9};
  at.u = 0.25f;
  at.v = 0.125f;
  at.time = 0.5f;
  const auto outputs = run(material->program, at);
  EXPECT_EQ(rgb(outputs, material->base_color), Rgb(0.375f, 0.625f, 0.875f));
  ASSERT_TRUE(material->emission);
  EXPECT_EQ(rgb(outputs, *material->emission), Rgb(0.125f, 2, 3));
  EXPECT_EQ(material->output_spans.size(), outputs.size());
}

TEST(Material, DefaultsToGrey) {
  BodyText text("material m() { emission = 1 }");
  const auto material = text.material();
  ASSERT_TRUE(material) << text.messages();
  EXPECT_EQ(rgb(run(material->program, {}), material->base_color), Rgb(0.8f));
}

struct Mistake {
  const char* body;
  const char* fragment;
};
TEST(Material, MistakesAreErrors) {
  for (const Mistake& row :
       {Mistake{"base_color = 2", "in [0, 1]"}, Mistake{"roughness = -1", "in [0, 1]"},
        Mistake{"ior = 0.5", "at least 1"}, Mistake{"normal = 1", "wants a vec"},
        Mistake{"base_colour = 1", "did you mean 'base_color'"},
        Mistake{"density = 1", "no output 'density'"}, Mistake{"emission = -1", "at least 0"}}) {
    SCOPED_TRACE(row.body);
    BodyText text(std::string("material m() { ") + row.body + " }");
    EXPECT_FALSE(text.material());
    EXPECT_EQ(text.diagnostics.error_count(), 1);
    EXPECT_NE(text.messages().find(row.fragment), std::string::npos) << text.messages();
  }
}

}  // namespace
}  // namespace tyndall::shader
