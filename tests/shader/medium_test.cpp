// Media: what their outputs come to, and which go together.
#include <gtest/gtest.h>

#include "compiled.h"

namespace tyndall::shader {
namespace UNNAMED {

void expect_rgb(const Rgb& found, const Rgb& expected) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-6f * std::max(1.0f, std::abs(expected[i])));
}

// language.md "Medium", one row a rule: sigma_s and sigma_t of constant bodies.
struct Rule {
  const char* body;
  Rgb sigma_s, sigma_t, emission;
  bool emits;
};
void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.body; }

class Coefficients : public testing::TestWithParam<Rule> {};

TEST_P(Coefficients, FollowTheRule) {
  BodyText text(std::string("medium m() { ") + GetParam().body + " }");
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  EXPECT_EQ(text.messages(), "");
  const std::vector<float> full = run(medium->full, {});
  expect_rgb(rgb(full, medium->sigma_s), GetParam().sigma_s);
  expect_rgb(rgb(full, medium->sigma_t), GetParam().sigma_t);
  expect_rgb(rgb(run(medium->extinction, {}), medium->extinction_sigma_t), GetParam().sigma_t);
  EXPECT_EQ(medium->emission.has_value(), GetParam().emits);
  if (medium->emission) expect_rgb(rgb(full, *medium->emission), GetParam().emission);
  EXPECT_TRUE(medium->homogeneous());
  EXPECT_EQ(medium->output_spans.size(), medium->full.outputs.size());
  EXPECT_EQ(medium->scatters(), !is_black(GetParam().sigma_s));
}

INSTANTIATE_TEST_SUITE_P(
    Rules, Coefficients,
    testing::Values(
        Rule{"albedo = 0.5", Rgb(0.5f), Rgb(1), {}, false},
        Rule{"density = 4 albedo = 0.5", Rgb(2), Rgb(4), {}, false},
        Rule{"albedo = (1, 0.5, 0) density = 2", {2, 1, 0}, Rgb(2), {}, false},
        Rule{"albedo = 0.5 extinction = (1, 2, 4) density = 3", {1.5f, 3, 6}, {3, 6, 12}, {}, false},
        Rule{"scattering = (1, 2, 3) absorption = 1", {1, 2, 3}, {2, 3, 4}, {}, false},
        Rule{"scattering = 1 absorption = 2 density = 3", Rgb(3), Rgb(9), {}, false},
        Rule{"absorption = (1, 2, 3)", {}, {1, 2, 3}, {}, false},
        Rule{"scattering = 2", Rgb(2), Rgb(2), {}, false},
        Rule{"emission = (1, 2, 3) density = 2", {}, {}, {2, 4, 6}, true},
        Rule{"albedo = 0 emission = 2 density = 0.5", {}, Rgb(0.5f), Rgb(1), true},
        Rule{"albedo = #fff", Rgb(1), Rgb(1), {}, false},
        Rule{"if true { albedo = 0.5 } else { albedo = 1 }", Rgb(0.5f), Rgb(1), {}, false},
        Rule{"var d = 0 for i in 1..4 { d = d + i } density = d albedo = 1", Rgb(10), Rgb(10), {}, false}));

// Mistakes: what is underlined and what is said.
struct Mistake {
  const char* body;
  const char* place;
  const char* fragment;
};
void PrintTo(const Mistake& row, std::ostream* out) { *out << row.body; }

class MediumError : public testing::TestWithParam<Mistake> {};

TEST_P(MediumError, IsReportedOnceAtItsPlace) {
  BodyText text(std::string("medium m() { ") + GetParam().body + " }");
  EXPECT_FALSE(text.medium());
  ASSERT_EQ(text.diagnostics.error_count(), 1) << text.messages();
  for (const Diagnostic& d : text.diagnostics.all()) {
    if (d.severity != Severity::error) continue;
    EXPECT_EQ(text.sources.text(d.span), GetParam().place);
    EXPECT_NE((d.message + " | " + d.help).find(GetParam().fragment), std::string::npos) << text.messages();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Rules, MediumError,
    testing::Values(
        Mistake{"desnity = 1 albedo = 1", "desnity", "did you mean 'density'"},
        Mistake{"density = 1", "m", "neither scatters, absorbs nor emits"},
        Mistake{"albedo = 1 scattering = 1", "scattering = 1", "not both"},
        Mistake{"extinction = 1", "extinction = 1", "without 'albedo'"},
        Mistake{"albedo = 1.5", "1.5", "'albedo' must be in [0, 1]"},
        Mistake{"albedo = (1, 2, 0)", "(1, 2, 0)", "must be in [0, 1], found (1, 2, 0)"},
        Mistake{"density = -1 albedo = 1", "-1", "at least 0"},
        Mistake{"emission = (0, -1, 0)", "(0, -1, 0)", "at least 0"},
        Mistake{"density = 1 / 0 albedo = 1", "1 / 0", "not a finite number"},
        Mistake{"density = (1, 2, 3) albedo = 1", "(1, 2, 3)", "'density' wants a number"},
        Mistake{"albedo = 1 phase = 0.5", "0.5", "'phase' wants a phase function"},
        Mistake{"albedo = 1 albedo = 0.5", "albedo", "set twice"},
        Mistake{"albedo = 1 phase = hg(2)", "2", "[-0.9999, 0.9999]"},
        Mistake{"if p.x > 0 { density = 1 } albedo = 1", "density", "one branch only"},
        Mistake{"if p.x > 0 { albedo = 1 } else { albedo = 1 density = 2 }", "density", "one branch only"},
        Mistake{"if true { density = 1 } albedo = 1", "density", "one branch only"},
        Mistake{"density = n.x albedo = 1", "n", "a medium has no 'n'"},
        Mistake{"let p = 1 albedo = 1", "p", "cannot be redefined"},
        Mistake{"var d = 0 for i in 0..p.x { d = d + i } density = d albedo = 1", "p.x", "give it a limit"},
        Mistake{"var d = 0 for i in 0..9999 { d = d + i } density = d albedo = 1", "0..9999",
                "at most 4096 rounds"},
        Mistake{"density = fbm(p, octaves: p.x) albedo = 1", "p.x", "must be known"},
        Mistake{"density = (translate(p) * p).x albedo = 1", "p", "must be known"},
        Mistake{"density = (rotate_y(p.x * 1rad) * p).x albedo = 1", "rotate_y(p.x * 1rad)",
                "rotate_y(p, angle)"},
        Mistake{"let q = if p.x > 0 then 1 else true density = q albedo = 1", "if p.x > 0 then 1 else true",
                "one branch gives"},
        Mistake{"sphere { radius: 1 } albedo = 1", "sphere { radius: 1 }", "only computes"},
        Mistake{"return 1 albedo = 1", "return 1", "belongs in a function"},
        Mistake{"density = \"{p.x}\" albedo = 1", "p.x", "must be known"}));

// A mistake outside of the body, reported there, must not be compiled into it.
TEST(Poison, FromOutsideFailsSilently) {
  BodyText text("let a = wrong medium m() { albedo = 1 density = 2 phase = a }");
  EXPECT_FALSE(text.medium());
  EXPECT_EQ(text.diagnostics.error_count(), 1) << text.messages();
}

TEST(Warnings, UnusedNamesInABody) {
  BodyText text("medium m(a = 1) { let b = 1 let _c = 2 let d = 3 density = d albedo = 1 }");
  ASSERT_TRUE(text.medium());
  ASSERT_EQ(text.diagnostics.all().size(), 1u) << text.messages();
  EXPECT_EQ(text.diagnostics.all()[0].message, "'b' is never used");
}

// Grey quantities share one output, and equal ones are the same. One more shows the density as it was given.
TEST(Outputs, EqualOnesAreShared) {
  BodyText text(
      "medium grey() { density = 1 + p.x albedo = 0.5 } medium white() { density = 1 + p.x albedo = 1 }");
  const auto grey = text.medium("grey"), white = text.medium("white");
  ASSERT_TRUE(grey && white);
  EXPECT_EQ(grey->full.outputs.size(), 3u);
  EXPECT_EQ(white->full.outputs.size(), 2u);
  EXPECT_EQ(white->sigma_s, white->sigma_t);
  EXPECT_EQ(white->extinction.outputs.size(), 2u);
}

// The two programs agree on extinction, and folding changes nothing.
TEST(Programs, AgreeWithEachOther) {
  BodyText text(
      R"(
medium m() {
  let q = rotate_y(p, 0.6rad * time)
  let d = fbm(q * 2, octaves: 3) + 2
  density = d
  extinction = (1, d, 2)
  albedo = clamp(p, 0, 1)
  emission = abs(p)
  phase = hg(0.5 * p.x)
}
)");
  const auto folded = text.medium("m", true), unfolded = text.medium("m", false);
  ASSERT_TRUE(folded && unfolded) << text.messages();
  for (const Point& at : {Point{{0.1f, 0.7f, -0.3f}}, Point{{-2, 3.5f, 1}, {}, {}, {}, 0, 0, 4}, Point{}}) {
    const auto a = run(folded->full, at), b = run(unfolded->full, at);
    EXPECT_EQ(a, b);
    EXPECT_EQ(rgb(a, folded->sigma_t), rgb(run(folded->extinction, at), folded->extinction_sigma_t));
  }
  EXPECT_LT(folded->extinction.lane_code.size(), folded->full.lane_code.size());
  EXPECT_FALSE(folded->homogeneous());
}

// The cloud of language.md against the same formula in C++.
TEST(Cloud, IsItsFormula) {
  BodyText text(R"(medium cloud(height = 1) {
    density = 20 * smoothstep(1, 0.4, length(p / (1, height, 1)) + 0.35 * fbm(p * 2.3 - (0, 0.4 * time, 0), octaves: 6))
    albedo  = 0.99
    phase   = hg(0.6)
  }
  let m = cloud(height: 0.7))");
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  EXPECT_EQ(text.messages(), "");
  ASSERT_EQ(medium->phase.size(), 1u);
  EXPECT_EQ(medium->phase[0].kind, optics::phase_kind<optics::HenyeyGreenstein>);
  EXPECT_FLOAT_EQ(medium->phase[0].parameters[0].value, 0.6f);
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const float a = static_cast<float>(i);
    Point at;
    at.p = {0.9f * std::sin(a), 0.6f * std::sin(a * 1.7f), 0.9f * std::cos(a * 0.9f)};
    at.time = 0.01f * a;
    const double x = static_cast<double>(at.p.x), y = static_cast<double>(at.p.y),
                 z = static_cast<double>(at.p.z);
    const double q[] = {x * 2.3, y * 2.3 - 0.4 * static_cast<double>(at.time), z * 2.3};
    const double billow = vm::evaluate(vm::Op::fbm3, q, 6);
    const double edge[] = {1, 0.4, std::sqrt(x * x + y * y / 0.49 + z * z) + 0.35 * billow};
    const double density = 20 * vm::evaluate(vm::Op::smoothstep, edge);
    const auto full = run(medium->full, at);
    // The slope of the edge (at most 20 * 1.5 / 0.6 = 50) times the roundings of a float near 1 to 5, six
    // octaves.
    EXPECT_NEAR(static_cast<double>(full[medium->sigma_t[0]]), density, 50 * 2e-6);
    EXPECT_NEAR(static_cast<double>(full[medium->sigma_s[1]]), 0.99 * density, 50 * 2e-6);
    inside += density > 0.1 && density < 19.9;
  }
  EXPECT_GT(inside, 20);
}

}  // namespace UNNAMED
}  // namespace tyndall::shader
