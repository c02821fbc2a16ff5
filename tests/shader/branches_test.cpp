// Conditions that differ from place to place: every lane gets its own branch's values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "compiled.h"

namespace tyndall::shader {
namespace UNNAMED {

struct Branch {
  const char* text;  // sets `density`, a function of x = p.x
  float (*expected)(float x);
};
void PrintTo(const Branch& row, std::ostream* out) { *out << row.text; }

class Branches : public testing::TestWithParam<Branch> {};

TEST_P(Branches, GiveEachLaneItsOwn) {
  BodyText text(GetParam().text);
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  EXPECT_EQ(text.messages(), "");
  for (const float x : {-2.5f, -1.0f, -0.5f, 0.0f, 0.5f, 1.0f, 1.5f, 2.5f, 4.0f})
    EXPECT_FLOAT_EQ(run(medium->extinction, {{x, 0, 0}})[medium->extinction_sigma_t[0]],
                    GetParam().expected(x))
        << x;
}

INSTANTIATE_TEST_SUITE_P(
    Laws, Branches,
    testing::Values(
        Branch{"medium m() { density = if p.x > 0 then p.x else 1 albedo = 1 }",
               [](float x) { return x > 0 ? x : 1; }},
        Branch{"medium m() { if p.x > 0 { density = p.x } else { density = 1 } albedo = 1 }",
               [](float x) { return x > 0 ? x : 1; }},
        Branch{R"(
medium m() { if p.x > 2 { density = 3 } else if p.x > 0 { density = 2 } else { density = 1 }  albedo = 1 }
)",
               [](float x) { return x > 2   ? 3.0f
                                    : x > 0 ? 2.0f
                                            : 1.0f; }},
        Branch{R"(
medium m() { var d = 1  if p.x > 0 { d = d + p.x  if p.x > 1 { d = d * 2 } }  density = d  albedo = 1 }
)",
               [](float x) { return x > 1   ? (1 + x) * 2
                                    : x > 0 ? 1 + x
                                            : 1; }},
        Branch{R"(
medium m() {
  var d = 1
  if p.x > 0 { d = 2 } else { d = 3 }
  if p.x > 1 { d = d + 5 }
  density = d
  albedo = 1
}
)",
               [](float x) { return x > 1   ? 7.0f
                                    : x > 0 ? 2.0f
                                            : 3.0f; }},
        Branch{"medium m() { var d = 0 for i in 0..3 { if p.x > i { d = d + 1 } } density = d albedo = 1 }",
               [](float x) { return static_cast<float>((x > 0) + (x > 1) + (x > 2) + (x > 3)); }},
        Branch{"def f(x) = { if x > 0 { return x } return 1 } medium m() { density = f(p.x) albedo = 1 }",
               [](float x) { return x > 0 ? x : 1; }},
        Branch{R"(
def f(x) = { var a = 1  if x > 0 { a = 2  if x > 1 { return 10 }  a = a + 1 } else { a = 4 }  return a }
medium m() { density = f(p.x)  albedo = 1 }
)",
               [](float x) { return x > 1   ? 10.0f
                                    : x > 0 ? 3.0f
                                            : 4.0f; }},
        Branch{R"(
def f(x) = { for i in 0..3 { if x < i { return i } }  return 9 }
medium m() { density = f(p.x)  albedo = 1 }
)",
               [](float x) {
                 return x < 0 ? 0.0f : x < 1 ? 1.0f : x < 2 ? 2.0f : x < 3 ? 3.0f : 9.0f;
               }},
        Branch{R"(
def f(x) = { if x > 0 { if x > 1 { return 5 } else { return 6 } } else { return 7 } }
medium m() { density = f(p.x)  albedo = 1 }
)",
               [](float x) { return x > 1   ? 5.0f
                                    : x > 0 ? 6.0f
                                            : 7.0f; }},
        Branch{"medium m() { density = if p.x > 0 and p.x < 2 or p.x < -2 then 1 else 0 albedo = 1 }",
               [](float x) { return (x > 0 && x < 2) || x < -2 ? 1.0f : 0.0f; }},
        Branch{"medium m() { density = if not (p.x > 0) then 1 else 0 albedo = 1 }",
               [](float x) { return x > 0 ? 0.0f : 1.0f; }},
        Branch{"medium m(on = false) { density = if on and p.x > 0 then 1 else 2 albedo = 1 }",
               [](float) { return 2.0f; }},
        Branch{"medium m() { let v = if p.x > 0 then (1, 2, 3) else 5 density = v.y albedo = 1 }",
               [](float x) { return x > 0 ? 2.0f : 5.0f; }},
        Branch{
            "medium m() { var d = 0 for i in 0..<clamp(p.x, 0, 3) { d = d + 1 + i } density = d albedo = 1 }",
            [](float x) { return x <= 0   ? 0.0f
                                 : x <= 1 ? 1.0f
                                 : x <= 2 ? 3.0f
                                          : 6.0f; }},
        Branch{"medium m() { var d = 1 for i in 1..min(p.x, 4) { d = d * 2 } density = d albedo = 1 }",
               [](float x) { return std::exp2(std::max(0.0f, std::min(4.0f, std::floor(x)))); }},
        Branch{R"(
def f(x) = { for i in 0..<min(x, 3) { if x < i + 1.5 { return 10 + i } }  return 5 }
medium m() { density = f(p.x)  albedo = 1 }
)",
               [](float x) {
                 for (int i = 0; static_cast<float>(i) < std::min(x, 3.0f); ++i)
                   if (x < static_cast<float>(i) + 1.5f) return 10.0f + static_cast<float>(i);
                 return 5.0f;
               }},
        Branch{R"(
def f(x) = { for i in 0..<min(x, 3) { return 7 }  return 5 }
medium m() { density = f(p.x)  albedo = 1 }
)",
               [](float x) { return x > 0 ? 7.0f : 5.0f; }},
        Branch{"medium m() { let l = [3, 5, 9] density = l[p.x] albedo = 1 }",
               [](float x) { return x < 1   ? 3.0f
                                    : x < 2 ? 5.0f
                                            : 9.0f; }},
        Branch{"medium m() { let l = [(1, 2, 3), 4] density = l[p.x].y albedo = 1 }",
               [](float x) { return x < 1 ? 2.0f : 4.0f; }},
        Branch{"medium m() { density = p.x^2 + abs(p.x)^3 + p.x^4 + (p.x + 9)^0.5 albedo = 1 }",
               [](float x) { return x * x + std::abs(x * x * x) + x * x * x * x + std::sqrt(x + 9); }},
        Branch{"medium m() { density = 1 + keys(p.x, [0, 0], [1, 2], [2, 0]) albedo = 1 }", [](float x) {
                 return 1 + (x <= 0 || x >= 2 ? 0 : x < 1 ? 2 * x : 2 * (2 - x));
               }}));

// A mixture's weights are shares: they sum to 1, also where they depend on the place.
struct Mixture {
  const char* phase;
  std::vector<float> weights_at_half;  // at p.x = 0.5
};
void PrintTo(const Mixture& row, std::ostream* out) { *out << row.phase; }
class Mixtures : public testing::TestWithParam<Mixture> {};

TEST_P(Mixtures, HaveSharesThatSumToOne) {
  BodyText text(std::string("medium m() { albedo = 1 phase = ") + GetParam().phase + " }");
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  ASSERT_EQ(medium->phase.size(), GetParam().weights_at_half.size());
  for (const float x : {-1.0f, 0.0f, 0.25f, 0.5f, 1.0f, 3.0f}) {
    const auto full = run(medium->full, {{x, 0, 0}});
    float sum = 0;
    for (std::size_t i = 0; i < medium->phase.size(); ++i) {
      const auto& weight = medium->phase[i].weight;
      const float value = weight.output ? full[*weight.output] : weight.value;
      EXPECT_GE(value, 0);
      if (x == 0.5f) {
        EXPECT_FLOAT_EQ(value, GetParam().weights_at_half[i]);
      }
      sum += value;
    }
    EXPECT_NEAR(sum, 1, 1e-6f);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, Mixtures,
    testing::Values(Mixture{"isotropic", {1}}, Mixture{"mix(hg(0.8), hg(-0.3), 0.2)", {0.8f, 0.2f}},
                    Mixture{"mix(mix(hg(0.8), rayleigh, 0.5), droplets(0.01mm), 0.2)", {0.4f, 0.4f, 0.2f}},
                    Mixture{"mix(hg(0.8), isotropic, p.x)", {0.5f, 0.5f}},
                    Mixture{"mix(hg(0.8), mix(isotropic, draine(0.5, 1), p.x), 0.5)", {0.5f, 0.25f, 0.25f}},
                    Mixture{"if p.x > 0 then hg(0.5) else isotropic", {1, 0}},
                    Mixture{"mix(hg(0.8), isotropic, 0)", {1}}));

TEST(Phase, NumbersMayDependOnThePlace) {
  BodyText text("medium m() { albedo = 1 phase = hg(0.5 * p.x) }");
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  const auto& g = medium->phase.at(0).parameters[0];
  ASSERT_TRUE(g.output);
  EXPECT_FLOAT_EQ(run(medium->full, {{0.5f, 0, 0}})[*g.output], 0.25f);
}

// What surrounds a body's definition and its arguments decide its key, and nothing else does.
TEST(Key, IsEqualForEqualBodies) {
  BodyText text(
      R"(
let k = 2
medium c(a = 1, b = 2) { density = a * b * k  albedo = 1 }
let one = c(3)
let two = c(a: 3, b: 2)
let three = c(4)
def make(d) = { medium inner() { density = d  albedo = 1 }  return inner() }
let four = make(1)
let five = make(1)
let six = make(2)
let seven = c()
)");
  EXPECT_EQ(text.messages(), "");
  EXPECT_EQ(text.body("one")->key, text.body("two")->key);
  EXPECT_NE(text.body("one")->key, text.body("three")->key);
  EXPECT_EQ(text.body("four")->key, text.body("five")->key);
  EXPECT_NE(text.body("four")->key, text.body("six")->key);
  eval::Evaluator evaluator(text.context);
  EXPECT_EQ(evaluator.bound(*text.body("c"), {})->key, text.body("seven")->key);
}

TEST(Arguments, MayBeFunctionsAndMedia) {
  BodyText text("def double(x) = x * 2 medium c(f, x) { density = f(x) albedo = 1 } let m = c(double, 4)");
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  EXPECT_EQ(run(medium->extinction, {})[0], 8);
}

// A function never sees the body's p, whatever surrounds its call.
TEST(Functions, DoNotSeeTheBodysInputs) {
  BodyText text("def f(q, p = 3) = q + p medium m() { density = f(p.x) albedo = 1 }");
  const auto medium = text.medium();
  ASSERT_TRUE(medium) << text.messages();
  EXPECT_EQ(run(medium->extinction, {{2, 0, 0}})[0], 5);
}

// Branches with noise are guarded, and guards change no bit.
TEST(Guards, StandAroundTheNoiseOfABranch) {
  const std::string bodies[] = {
      "medium m() { density = if p.y > 0 then fbm(p) + 1 else 0 albedo = 1 }",
      R"(
medium m() {
  var d = 1
  if p.x > 0 { d = d + noise(p) } else { d = turbulence(p) + 2 }
  density = d
  albedo = 1
}
)",
      R"(
def f(p) = { if p.x > 1 { return 1 }  if p.y > 1 { return 2 + fbm(p) }  return 3 + cells(p) }
medium m() { density = f(p)  albedo = (noise(p), 0.5, 1) }
)",
      R"(
medium m() {
  var d = 2
  for i in 0..<clamp(4 * p.x, 0, 6) { d = d + fbm(p * 2^i, octaves: 2) / 2^i }
  density = d
  albedo = 1
}
)",
      "medium m() { density = 3 + [noise(p), fbm(p), cells(p)][2 * p.x] albedo = 1 }",
  };
  for (const std::string& body : bodies) {
    BodyText guarded(body), plain(body);
    const auto with = guarded.medium(),
               without = compile_medium(plain.context, *plain.body("m"), {.guards = false});
    ASSERT_TRUE(with && without) << guarded.messages();
    EXPECT_FALSE(with->full.guards.empty()) << body;
    EXPECT_TRUE(without->full.guards.empty());
    std::array<std::vector<float>, 3> p;
    for (int i = 0; i < 300; ++i) {
      p[0].push_back(static_cast<float>(i / 40) - 3.0f);
      p[1].push_back(static_cast<float>(i % 50) * 0.1f - 2.5f);
      p[2].push_back(0.37f * static_cast<float>(i));
    }
    vm::BatchInputs inputs;
    for (std::size_t k = 0; k < 3; ++k) inputs.lanes[k] = p[k].data();
    const std::size_t outputs = with->full.outputs.size();
    std::vector<std::vector<float>> results(2 * outputs, std::vector<float>(300));
    vm::Machine machine;
    for (std::size_t way = 0; way < 2; ++way) {
      std::vector<float*> rows;
      for (std::size_t k = 0; k < outputs; ++k) rows.push_back(results[way * outputs + k].data());
      machine.run(way == 0 ? with->full : without->full, inputs, 300, rows);
    }
    for (std::size_t k = 0; k < outputs; ++k) EXPECT_EQ(results[k], results[outputs + k]) << body;
    const auto lanes = machine.lanes_run(with->full);
    EXPECT_LT(*std::min_element(lanes.begin(), lanes.end()), lanes.front())
        << "nothing was skipped: " << body;
  }
}

TEST(Loops, WhoseEndDiffersNeedALimit) {
  const std::pair<std::string, std::string> rows[] = {
      {"medium m() { var d = 0 for i in 0..<p.x { d = d + 1 } density = d albedo = 1 }",
       "give it a limit, for instance min(n, 8)"},
      {"medium m() { var d = 0 for i in p.x..9 { d = d + 1 } density = d albedo = 1 }",
       "only the end of a range may differ"},
      {"medium m() { var d = 0 for i in 9..max(p.x, min(p.y, 3))..-1 { d = d + 1 } density = d albedo = 1 }",
       "limit"},
      {"medium m() { var d = 0 for i in 9..min(p.x, 3)..-1 { d = d + 1 } density = d albedo = 1 }",
       "counts down"},
      {"medium m() { for i in 0..<min(p.x, 3) { density = 1 } albedo = 1 }", "set the output after the loop"},
      {"medium m() { var d = 0 for i in 0..min(p.x, 5000) { d = d + 1 } density = d albedo = 1 }",
       "a loop of 5001 rounds"},
  };
  for (const auto& [body, message] : rows) {
    BodyText text(body);
    EXPECT_FALSE(text.medium()) << body;
    EXPECT_NE(text.messages().find(message), std::string::npos) << body << '\n' << text.messages();
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::shader
