// Materials: colours that depend on the place, and which outputs a surface comes to cost.
#include <gtest/gtest.h>

#include <algorithm>

#include "compiled.h"
#include "shader/material_outputs.h"

namespace tyndall::shader {
namespace UNNAMED {

TEST(Material, TilesOfTheLanguagePage) {
  BodyText text(
      R"(
material tiles(size = 1) { base_color = if checker(p.xz / size) then 0.8 else 0.2  roughness = 0.4 }
let m = tiles(size: 0.5)
)");
  const auto material = text.material();
  ASSERT_TRUE(material) << text.messages();
  EXPECT_TRUE(text.diagnostics.all().empty()) << text.messages();
  EXPECT_FALSE(material->matte());
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
  EXPECT_EQ(material->given.size(), outputs.size());
}

TEST(Material, DefaultsToGrey) {
  BodyText text("material m() { emission = 1 }");
  const auto material = text.material();
  ASSERT_TRUE(material) << text.messages();
  EXPECT_EQ(rgb(run(material->program, {}), material->base_color), Rgb(0.8f));
}

// A material costs what its body asks for: what is not set, or set to its default, is no output.
TEST(Material, OutputsAtTheirDefaultsAreLeftOut) {
  BodyText text(
      R"(
material m() {
  base_color = 0.5
  metallic = 0
  roughness = 0
  specular = 0
  transmission = 0
  ior = 1.5
  coat = 0
  sheen = 0
  emission = 0
  opacity = 1
}
)");
  const auto material = text.material();
  ASSERT_TRUE(material) << text.messages();
  EXPECT_TRUE(material->matte());
  EXPECT_FALSE(material->emission || material->opacity || material->roughness || material->ior);
  EXPECT_EQ(material->program.outputs.size(), 1u);
}

TEST(Material, GlossComesWithRoughnessOrIor) {
  const auto specular = [](const char* outputs) -> std::optional<float> {
    BodyText text(std::string("material m() { ") + outputs + " }");
    const auto material = text.material();
    if (!material || !material->specular) return std::nullopt;
    return run(material->program, {})[*material->specular];
  };
  EXPECT_EQ(specular("base_color = 0.5 metallic = 0.5 coat = 1"), std::nullopt);
  EXPECT_EQ(specular("roughness = 0.3"), 1.f);
  EXPECT_EQ(specular("ior = 1.33"), 1.f);
  EXPECT_EQ(specular("transmission = 0.5"), 1.f);
  EXPECT_EQ(specular("roughness = 0.3 specular = 0"), std::nullopt);
  EXPECT_EQ(specular("specular = 0.25"), 0.25f);
}

TEST(Material, EveryOutputOfTheTableIsRead) {
  for (const OutputRule& rule : material_outputs()) {
    const std::string value = rule.name == "normal" ? "n" : rule.name == "ior" ? "1.4" : "0.25";
    BodyText text("material m() { " + std::string(rule.name) + " = " + value + " }");
    const auto material = text.material();
    ASSERT_TRUE(material) << text.messages();
    // It is somewhere in the program.
    const auto outputs = run(material->program, {});
    const float wanted = rule.name == "normal" ? 1.f : rule.name == "ior" ? 1.4f : 0.25f;
    // An index of refraction alone makes gloss, roughness too.
    EXPECT_NE(std::find(outputs.begin(), outputs.end(), wanted), outputs.end()) << rule.name;
    EXPECT_FALSE(rule.documentation.empty() || rule.standard.empty()) << rule.name;
  }
}

struct Mistake {
  const char* body;
  const char* fragment;
};
TEST(Material, MistakesAreErrors) {
  for (const Mistake& row :
       {Mistake{"base_color = 2", "in [0, 1]"}, Mistake{"roughness = -1", "in [0, 1]"},
        Mistake{"ior = 0.5", "from 1 to 1000"},
        Mistake{"ior = 1 + p.x ^ 2", "one number for the whole surface"},
        Mistake{"metallic = (1, 1, 1)", "wants a number"}, Mistake{"opacity = 1.5", "in [0, 1]"},
        Mistake{"normal = 1", "wants a vec"}, Mistake{"base_colour = 1", "did you mean 'base_color'"},
        Mistake{"density = 1", "no output 'density'"}, Mistake{"emission = -1", "at least 0"}}) {
    SCOPED_TRACE(row.body);
    BodyText text(std::string("material m() { ") + row.body + " }");
    EXPECT_FALSE(text.material());
    EXPECT_EQ(text.diagnostics.error_count(), 1);
    EXPECT_NE(text.messages().find(row.fragment), std::string::npos) << text.messages();
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::shader
