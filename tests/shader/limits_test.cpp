// Numbers out of range, over the tables of outputs and of phase functions' parameters: constants are refused,
// what varies is limited where it is used and shown as it was given.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "compiled.h"
#include "optics/phase.h"
#include "shader/outputs.h"
#include "support/filled.h"

namespace tyndall::shader {
namespace UNNAMED {

using support::filled;

constexpr double largest = scene::largest_coefficient;

// What goes with an output so that the body is a medium.
std::string beside(std::string_view output) {
  return output == "albedo" || output == "scattering" || output == "absorption" ? "" : "albedo = 0.5";
}

TEST(OutputRanges, ConstantsOutOfThemAreRefused) {
  for (const auto kind : {syntax::BodyKind::medium, syntax::BodyKind::material}) {
    const bool medium = kind == syntax::BodyKind::medium;
    for (const OutputRule& rule : medium ? medium_outputs() : material_outputs()) {
      if (rule.type == eval::Type::phase || std::isinf(rule.lowest)) continue;
      const std::string highest = std::isinf(rule.highest) ? "1e31" : std::to_string(rule.highest * 1.01);
      for (const std::string& value : {std::to_string(rule.lowest - 0.01), highest, std::string("1 / 0")}) {
        const std::string name(rule.name);
        BodyText text(filled(
            medium ? "medium m() { $OUTPUT = $VALUE $BESIDE }" : "material m() { $OUTPUT = $VALUE $BESIDE }",
            {{"OUTPUT", name}, {"VALUE", value}, {"BESIDE", medium ? beside(rule.name) : ""}}));
        EXPECT_FALSE(medium ? text.medium().has_value() : text.material().has_value()) << name << value;
        EXPECT_EQ(text.diagnostics.error_count(), 1) << text.messages();
        EXPECT_NE(text.messages().find("'" + name + "'"), std::string::npos) << text.messages();
      }
    }
  }
}

const scene::GivenNumber* given_as(const scene::Medium& medium, const std::string& name) {
  for (const scene::GivenNumber& given : medium.given)
    if (given.name == name) return &given;
  return nullptr;
}

// The outputs at p.x = 1, with a value for `name`, are those of a body in which the number is within its
// range in the first place.
void expect_limited(const std::string& name, const std::string& value, const std::string& limited_value) {
  constexpr float x = 1;
  const auto body_with = [&](const std::string& v) {
    return filled("medium m() { $OUTPUT = $VALUE $BESIDE }",
                  {{"OUTPUT", name}, {"VALUE", v}, {"BESIDE", beside(name)}});
  };
  const std::string body = body_with(value);
  BodyText text(body), limited(body_with(limited_value));
  const auto a = text.medium(), b = limited.medium();
  ASSERT_TRUE(a && b) << text.messages() << limited.messages();
  const auto values = run(a->full, {{x, 0, 0}}), wanted = run(b->full, {{x, 0, 0}});
  EXPECT_EQ(rgb(values, a->sigma_t), rgb(wanted, b->sigma_t)) << body;
  EXPECT_EQ(rgb(values, a->sigma_s), rgb(wanted, b->sigma_s)) << body;
  if (a->emission) {
    EXPECT_EQ(rgb(values, *a->emission), rgb(wanted, *b->emission)) << body;
  }
  EXPECT_EQ(rgb(run(a->extinction, {{x, 0, 0}}), a->extinction_sigma_t), rgb(wanted, b->sigma_t)) << body;
  const scene::GivenNumber* given = given_as(*a, name);
  ASSERT_TRUE(given) << body;
  const float shown = values[given->output];
  EXPECT_FALSE(shown >= static_cast<float>(given->lowest) && shown <= static_cast<float>(given->highest))
      << body;
}

// The number as a scene gives it, and as what might vary.
std::string digits_of(double v) { return fmt::format("{:.9g}", v); }
std::string varying(double v) { return digits_of(v) + " + 0 * p.x"; }

TEST(OutputRanges, WhatVariesIsLimitedAndShown) {
  for (const OutputRule& rule : medium_outputs()) {
    if (rule.type == eval::Type::phase) continue;
    const std::string name(rule.name);
    const double high = std::min(rule.highest, largest);
    const std::string lowest = varying(rule.lowest), highest = varying(high);
    expect_limited(name, "p.x - 3", lowest);
    expect_limited(name, "1e38 * p.x", highest);
    expect_limited(name, "p.x / (p.x - p.x)", highest);
    expect_limited(name, "sqrt(-p.x)", lowest);
  }
}

// A medium with this phase function, whose other parameters are in the middle of their ranges.
std::string medium_with(const optics::PhaseInfo& function, std::size_t parameter, const std::string& value) {
  std::vector<std::string> values;
  for (const optics::PhaseParameter& p : function.parameters)
    values.push_back(std::to_string((p.lowest + p.highest) / 2));
  values.at(parameter) = value;
  return filled(
      "medium m() { albedo = 1 phase = $FUNCTION($VALUES) }",
      {{"FUNCTION", std::string(function.keyword)}, {"VALUES", fmt::format("{}", fmt::join(values, ", "))}});
}

TEST(PhaseRanges, AreTheSameForConstantsAndForWhatVaries) {
  for (const optics::PhaseInfo& function : optics::phase_functions())
    for (std::size_t k = 0; k < function.parameters.size(); ++k) {
      const optics::PhaseParameter& p = function.parameters[k];
      const double margin = 0.001 * (p.highest - p.lowest);
      for (const double inside : {p.lowest, p.highest}) {
        BodyText text(medium_with(function, k, digits_of(inside)));
        EXPECT_TRUE(text.medium()) << text.messages();
      }
      for (const double outside : {p.lowest - margin, p.highest + margin, infinity}) {
        const std::string value = std::isinf(outside) ? "1 / 0" : digits_of(outside);
        BodyText text(medium_with(function, k, value));
        EXPECT_FALSE(text.medium()) << medium_with(function, k, value);
        EXPECT_NE(text.messages().find("must lie in ["), std::string::npos) << text.messages();

        BodyText varied(medium_with(function, k, value + " + 0 * p.x"));
        const auto medium = varied.medium();
        ASSERT_TRUE(medium) << varied.messages();
        const std::string name = std::string(p.name) + " of " + std::string(function.keyword);
        const auto values = run(medium->full, {{1, 0, 0}});
        EXPECT_FLOAT_EQ(values[*medium->phase[0].parameters[k].output],
                        static_cast<float>(outside < p.lowest ? p.lowest : p.highest));
        const scene::GivenNumber* given = given_as(*medium, name);
        ASSERT_TRUE(given) << name;
        EXPECT_FLOAT_EQ(values[given->output], static_cast<float>(outside));
        EXPECT_EQ(given->lowest, p.lowest);
        EXPECT_EQ(given->highest, p.highest);
      }
    }
}

// The share of a mixture, and parameters where their lobe does not count.
TEST(PhaseRanges, HoldInMixturesAndBranches) {
  BodyText text("medium m() { albedo = 1 phase = mix(isotropic, rayleigh, p.x) }");
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  for (const auto& [x, weight] : {std::pair{1.5f, 1.0f}, {-0.5f, 0.0f}, {0.25f, 0.25f}}) {
    const auto values = run(medium->full, {{x, 0, 0}});
    EXPECT_EQ(values[*medium->phase[1].weight.output], weight);
    int bad = 0;
    for (const scene::GivenNumber& given : medium->given)
      bad += given.name == "w of mix" && !(values[given.output] >= 0 && values[given.output] <= 1);
    EXPECT_EQ(bad, x != 0.25f);
  }
  BodyText branches("medium m() { albedo = 1 if p.x > 0 { phase = hg(p.x) } else { phase = rayleigh } }");
  const auto branched = branches.medium();
  ASSERT_TRUE(branched) << branches.messages();
  const scene::GivenNumber* g = given_as(*branched, "g of hg");
  ASSERT_TRUE(g);
  EXPECT_EQ(run(branched->full, {{2, 0, 0}})[g->output], 2);
  EXPECT_GE(run(branched->full, {{-2, 0, 0}})[g->output], static_cast<float>(g->lowest));
}

}  // namespace UNNAMED
}  // namespace tyndall::shader
