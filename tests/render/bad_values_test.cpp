// Numbers of bodies out of their range, over the tables of outputs: the picture is that of the limited
// number, and the guilty output is told once, and no other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/render.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using support::scene_of;

const std::string frame =
    "render { resolution: (6, 4)  samples: 8  bounces: 4  step: 0.1 }\n"
    "camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 30deg }\n"
    "light environment { radiance: 1 }\n"
    "light distant { direction: (-1, -1, -1)  irradiance: 2 }\n";

std::string fog(const std::string& body) {
  return frame + "volume { in: sphere {}  medium: { " + body + " } }\n";
}
std::string ball(const std::string& body) { return frame + "sphere { material: { " + body + " } }\n"; }

struct Row {
  std::string output;   // as it is told
  std::string body;     // with VALUE
  std::string bad;      // for VALUE
  std::string limited;  // the same, within the range
  BadValue::Kind kind;
  bool material = false;
};

std::vector<Row> rows() {
  using enum BadValue::Kind;
  // Both of one range: 0 to 1, and numbers without an upper end.
  const auto of_share = [](const std::string& output, const std::string& body, bool material) {
    return std::vector<Row>{
        {output, body, "4 * p.x", "clamp(4 * p.x, -9, 1)", above, material},  // and below
        {output, body, "0.5 + 0 / max(p.x, 0)", "if p.x > 0 then 0.5 else 0", undefined, material},
        {output, body, "0.5 + 4 * abs(p.x)", "min(0.5 + 4 * abs(p.x), 1)", above, material},
        {output, body, "0.5 - 4 * abs(p.x)", "max(0.5 - 4 * abs(p.x), 0)", below, material}};
  };
  const auto of_amount = [](const std::string& output, const std::string& body, bool material) {
    return std::vector<Row>{
        {output, body, "0.5 + 0 / max(p.x, 0)", "if p.x > 0 then 0.5 else 0", undefined, material},
        {output, body, "1 / max(p.x, 0)", "if p.x > 0 then 1 / max(p.x, 0) else 1e30", above, material},
        {output, body, "1 - 4 * abs(p.x)", "max(1 - 4 * abs(p.x), 0)", below, material}};
  };
  std::vector<Row> all;
  const auto add = [&](std::vector<Row> some) { all.insert(all.end(), some.begin(), some.end()); };
  add(of_amount("density", "density = VALUE  albedo = 0.5", false));
  add(of_amount("density", "density = VALUE  scattering = 0  absorption = 1", false));
  add(of_share("albedo", "density = 2  albedo = VALUE", false));
  add(of_amount("extinction", "albedo = 0.5  extinction = VALUE", false));
  add(of_amount("scattering", "scattering = VALUE  absorption = 1", false));
  add(of_amount("absorption", "scattering = 1  absorption = VALUE", false));
  add(of_amount("emission", "albedo = 0.5  emission = VALUE", false));
  for (const char* output : {"base_color", "metallic", "roughness", "specular", "coat", "sheen", "opacity"})
    add(of_share(
        output,
        (output == std::string("base_color") ? "" : std::string("base_color = 0.5  ")) + output + " = VALUE",
        true));
  add(of_share("transmission", "base_color = 0.5  roughness = 0.3  transmission = VALUE", true));
  add(of_amount("emission", "base_color = 0.5  emission = VALUE", true));
  all.push_back({"g of hg", "albedo = 1  phase = hg(VALUE)", "2 + p.x", "0.9999 + 0 * p.x", above});
  all.push_back({"g of hg", "albedo = 1  phase = hg(VALUE)", "-2 + p.x", "-0.9999 + 0 * p.x", below});
  all.push_back({"a of draine", "albedo = 1  phase = draine(0.5, VALUE)", "p.x - 2", "0 * p.x", below});
  all.push_back({"diameter of droplets", "albedo = 1  phase = droplets(VALUE)", "0.001 + 0 * p.x",
                 "0.00005 + 0 * p.x", above});
  all.push_back(
      {"w of mix", "albedo = 1  phase = mix(rayleigh, hg(0.5), VALUE)", "2 + p.x", "1 + 0 * p.x", above});
  return all;
}

std::string with(const Row& row, const std::string& value) {
  std::string body = row.body;
  body.replace(body.find("VALUE"), 5, value);
  return row.material ? ball(body) : fog(body);
}

TEST(BadValues, AreTakenAsToldAndOnlyTheGuiltyOutputIs) {
  for (const Row& row : rows()) {
    const std::string what = row.body + ", " + row.bad;
    const RenderResult bad = render(compile::compile(scene_of(with(row, row.bad))), {});
    int of_kind = 0;
    for (const BadValue& b : bad.statistics.bad_values) {
      EXPECT_EQ(b.output, row.output) << what;
      EXPECT_GT(b.count, 0u) << what;
      of_kind += b.kind == row.kind;
    }
    EXPECT_EQ(of_kind, 1) << what;
    EXPECT_EQ(bad.statistics.bad_samples, 0u) << what;
    if (row.bad == "4 * p.x") continue;  // below and above
    EXPECT_EQ(bad.statistics.bad_values.size(), 1u) << what;
    const RenderResult limited = render(compile::compile(scene_of(with(row, row.limited))), {});
    EXPECT_TRUE(limited.statistics.bad_values.empty()) << what;
    double mean = 0, difference = 0;
    for (int i = 0; i < 24; ++i) {
      const Rgb a = bad.film.mean(i % 6, i / 6), b = limited.film.mean(i % 6, i / 6);
      mean += static_cast<double>(std::abs(b.x));
      difference += static_cast<double>(std::abs(a.x - b.x));
    }
    EXPECT_LE(difference, 1e-5 * mean) << what;
  }
}

// The statement of a row's body that has its VALUE.
std::string statement_of(const Row& row) {
  const std::size_t value = row.body.find("VALUE");
  const std::size_t before = row.body.rfind("  ", value),
                    begin = before == std::string::npos ? 0 : before + 2;
  return row.body.substr(begin, row.body.find("  ", value) - begin);
}

// Where two branches set an output, the statements that gave something bad are told, each once, and no other.
TEST(BadValues, AreToldAtTheBranchThatGaveThem) {
  for (const Row& row : rows()) {
    if (row.bad == "4 * p.x") continue;  // below and above
    const std::string statement = statement_of(row);
    for (const auto& [first_bad, second_bad] : {std::pair{true, false}, {false, true}, {true, true}}) {
      const auto branch = [&](bool is_bad) {
        std::string text = statement;
        return text.replace(text.find("VALUE"), 5, is_bad ? row.bad : row.limited);
      };
      const std::string first = branch(first_bad), second = branch(second_bad);
      std::string body = row.body;
      body.replace(body.find(statement), statement.size(),
                   "if p.y > 0 { " + first + " } else { " + second + " }");
      const std::string text = row.material ? ball(body) : fog(body);
      std::vector<std::size_t> expected;
      if (first_bad) expected.push_back(text.find("{ " + first + " }") + 2);
      if (second_bad) expected.push_back(text.find("else { " + second + " }") + 7);
      std::vector<std::size_t> told;
      for (const BadValue& bad : render(compile::compile(scene_of(text)), {}).statistics.bad_values) {
        EXPECT_EQ(bad.output, row.output) << text;
        told.push_back(bad.span.begin);
      }
      std::sort(told.begin(), told.end());
      EXPECT_EQ(told, expected) << text;
    }
  }
}

// Branches within branches, and an output whose components are bad alike.
TEST(BadValues, AreToldAtTheInnermostBranch) {
  const std::string text =
      fog("if p.y > 0 { if p.x > 0 { density = 1 } else { density = -1 - p.x^2 } }\n"
          "else { if p.x > 0 { density = -2 - p.x^2 } else { density = 2 } }\n"
          "albedo = (2 + p.x, 3 + p.y, 4 + p.z)");
  std::vector<std::size_t> told;
  for (const BadValue& bad : render(compile::compile(scene_of(text)), {}).statistics.bad_values)
    told.push_back(bad.span.begin);
  std::sort(told.begin(), told.end());
  EXPECT_EQ(told, (std::vector{text.find("density = -1"), text.find("density = -2"), text.find("albedo")}));
}

// Statements that give one and the same number are told each.
TEST(BadValues, OfAllStatementsAreToldAtOnce) {
  for (const char* others : {"emission = -1 - p.x^2  albedo = 0.5", "scattering = -1 - p.x^2  absorption = 1",
                             "scattering = 1  absorption = -1 - p.x^2"}) {
    const RenderResult result =
        render(compile::compile(scene_of(fog(std::string("density = -1 - p.x^2  ") + others))), {});
    EXPECT_EQ(result.statistics.bad_values.size(), 2u) << others;
  }
}

TEST(BadValues, AnInfiniteNormalIsNotCalledUndefined) {
  const auto told = [](const std::string& normal) {
    return render(compile::compile(scene_of(ball("base_color = 0.5  normal = " + normal))), {})
        .statistics.bad_values;
  };
  const std::vector<BadValue> infinite = told("n / max(p.x - 9, 0)"),
                              undefined = told("n * sqrt(-1 - p.x^2)");
  ASSERT_EQ(infinite.size(), 1u);
  ASSERT_EQ(undefined.size(), 1u);
  EXPECT_EQ(infinite[0].kind, BadValue::Kind::above);
  EXPECT_EQ(undefined[0].kind, BadValue::Kind::undefined);
  EXPECT_TRUE(infinite[0].instead && undefined[0].instead);
}

// White fog cannot give more than it gets, whatever its albedo claims.
TEST(BadValues, AnAlbedoAboveOneMakesNoEnergy) {
  const RenderResult result =
      render(compile::compile(
                 scene_of("render { resolution: (8, 4)  samples: 4 }\n"
                          "camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 20deg }\n"
                          "light environment { radiance: 1 }\n"
                          "volume { in: sphere {}  medium: { density = 20  albedo = 1 + 0.1 * p.x^2 } }\n")),
             {});
  double mean = 0;
  for (int i = 0; i < 32; ++i) mean += static_cast<double>(result.film.mean(i % 8, i / 8).x) / 32;
  EXPECT_NEAR(mean, 1, 0.05);
  ASSERT_EQ(result.statistics.bad_values.size(), 1u);
  EXPECT_EQ(result.statistics.bad_values[0].output, "albedo");
  EXPECT_EQ(result.statistics.bad_values[0].highest, 1);
}

// An index of refraction is one number for the whole surface; a function of time may leave its range.
TEST(BadValues, AnIndexOfRefractionIsToldToo) {
  const std::string text = "animation { fps: 1  frames: 0..9 }\n" + frame +
                           "sphere { material: { base_color = 1  transmission = 1  ior = 1.5 - time } }\n";
  for (const double time : {0.0, 3.0}) {
    resolve::Options options;
    options.frame = static_cast<int>(time);
    const RenderResult result = render(compile::compile(scene_of(text, options)), {});
    ASSERT_EQ(result.statistics.bad_values.size(), time > 0) << time;
    if (time == 0) continue;
    EXPECT_EQ(result.statistics.bad_values[0].output, "ior");
    EXPECT_EQ(result.statistics.bad_values[0].kind, BadValue::Kind::below);
  }
}

// Samples that the film cannot hold are counted; ordinary ones lose nothing that is told.
TEST(FilmRange, WhatItLosesIsCounted) {
  const auto statistics = [](const std::string& power) {
    return render(compile::compile(scene_of(fmt::format("let power = {}\n", power) + R"(
render { resolution: (2, 2)  samples: 4  bounces: 0 }
camera orthographic { from: (0, 1, 0)  to: (0, 0, 0)  up: (0, 0, 1)  height: 0.001 }
plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.5 } }
light point { position: (0, 2, 0)  power: power }
)")),
                  {})
        .statistics;
  };
  const Statistics bright = statistics("1e14"), ordinary = statistics("100"), dark = statistics("1e-19");
  EXPECT_EQ(bright.clipped_samples, 16u);
  EXPECT_NEAR(bright.lost_light / bright.light,
              1 - 0x1p38 / (0.5 / 3.14159265358979 * 1e14 / (16 * 3.14159265358979)), 1e-4);
  EXPECT_EQ(ordinary.clipped_samples, 0u);
  EXPECT_EQ(ordinary.lost_light, 0);
  EXPECT_EQ(dark.clipped_samples, 0u);
  EXPECT_EQ(dark.lost_light, dark.light);
}

}  // namespace
}  // namespace tyndall::render
