// What is told after a render: numbers out of range, limits that were met. Each once, in the statistics too.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"

namespace tyndall::test {
namespace {

using Told = CliTest;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++count;
  return count;
}

const std::string frame =
    "render { resolution: (4, 3)  samples: 4 }\n"
    "camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1 }\n"
    "light environment { radiance: 1 }\n";

struct Row {
  const char* name;
  std::string scene;     // after the frame, which has three lines
  const char* place;     // "4:1"; empty: none
  const char* fragment;  // of the message
  bool strict;           // an error with --strict
};
void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class ToldAfterARender : public CliTest, public testing::WithParamInterface<Row> {};

TEST_P(ToldAfterARender, OnceAtItsPlace) {
  const Row& row = GetParam();
  const std::string scene = file("a.tyn", frame + row.scene);
  const Outcome outcome = tyndall({"render", scene, "-o", path("a.exr"), "--json"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string place = *row.place ? scene + ":" + row.place + ": " : "";
  EXPECT_EQ(count_of(outcome.err, "warning: "), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find(place + "warning: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(row.fragment), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("help: "), std::string::npos) << outcome.err;
  const auto diagnostics = nlohmann::json::parse(outcome.out)["diagnostics"];
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_NE(diagnostics[0]["message"].get<std::string>().find(row.fragment), std::string::npos);
  const Outcome strict = tyndall({"render", scene, "-o", path("a.exr"), "--strict"});
  EXPECT_EQ(strict.status, row.strict ? 1 : 0) << strict.err;
}

INSTANTIATE_TEST_SUITE_P(
    Rows, ToldAfterARender,
    testing::Values(
        Row{"AlbedoAboveOne",
            "volume { in: sphere {}  medium: {\n  density = 20\n  albedo = 1 + 0.1 * p.x^2 } }\n", "6:3",
            "values of 'albedo' above 1 here, taken as 1", true},
        Row{"InfiniteDensity",
            "volume { in: sphere {}  medium: {\n  density = 1 / (p.x - p.x)\n  scattering = 0\n  absorption "
            "= 1 } }\n",
            "5:3", "values of 'density' that are infinite or above 1e30 here, taken as 1e30", true},
        Row{"UndefinedDensity",
            "volume { in: sphere {}  medium: {\n  density = sqrt(-1 - p.x^2)\n  albedo = 0.5 } }\n", "5:3",
            "values of 'density' that are no numbers here, taken as 0", true},
        Row{"NegativeDensity", "volume { in: sphere {}  medium: {\n  density = p.x\n  albedo = 0.5 } }\n",
            "5:3", "values of 'density' below 0 here, taken as 0", true},
        Row{"PhaseParameter",
            "volume { in: sphere {}  medium: {\n  albedo = 0.5\n  phase = hg(2 * p.z + 3) } }\n", "6:3",
            "values of 'g of hg' above 0.9999 here, taken as 0.9999", true},
        Row{"Roughness", "sphere { material: {\n  base_color = 0.5\n  roughness = 2 * abs(p.x) } }\n", "6:3",
            "values of 'roughness' above 1 here, taken as 1", true},
        Row{"InfiniteEmission", "sphere { material: {\n  base_color = 0\n  emission = exp(100 + p.x) } }\n",
            "6:3", "values of 'emission' that are infinite", true},
        Row{"NoiseFarOut",
            "volume { in: sphere {}  medium: {\n  density = 0.1 + 0.01 * fbm(p * 3e7)\n  albedo = 0.5 } }\n",
            "5:26", "'fbm' here at places as far out as 3e+07, where numbers are 2 apart", false},
        Row{"WidenedStep",
            "volume { in: box { min: (-1, -1, -1)  max: (1, 1, 1) }  step: 1e-5  medium: {\n"
            "  density = 1 + 0.5 * sin(40 * p.z)\n  albedo = 0 } }\n",
            "", "a step of 1e-05 m wants more than 4096 segments", false},
        Row{"MissedTolerance",
            "volume { in: box { min: (-1, -1, 0)  max: (1, 1, 1) }  step: auto(0.1%)  medium: {\n"
            "  density = 1200 * exp(-((p.z - 0.3217) / 0.0015)^2)\n  albedo = 0 } }\n",
            "", "the tolerance of `step: auto(0.1%)` takes more than 4096 segments", true}),
    [](const auto& named) { return named.param.name; });

TEST_F(Told, LightThatBouncesCutIsToldAboveOnePercent) {
  const auto scene = [&](const std::string& density) {
    return file("a.tyn",
                "render { resolution: (4, 3)  samples: 16  bounces: 8 }\n"
                "camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1 }\n"
                "light environment { radiance: 1 }\n"
                "volume { in: sphere {}  medium: { density = " +
                    density + "  albedo = 1 } }\n");
  };
  const Outcome thick = tyndall({"render", scene("20"), "-o", path("a.exr")});
  EXPECT_NE(thick.err.find("samples/s; `bounces: 8` cut "), std::string::npos) << thick.err;
  const Outcome thin = tyndall({"render", scene("0.01"), "-o", path("a.exr")});
  EXPECT_EQ(thin.err.find("bounces"), std::string::npos) << thin.err;
}

TEST_F(Told, LightThatTheFilmCannotHold) {
  const auto err = [&](const std::string& radiance) {
    const std::string scene = file("a.tyn",
                                   "render { resolution: (2, 2)  samples: 2 }\n"
                                   "camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1 }\n"
                                   "light environment { radiance: " +
                                       radiance + " }\nsphere { center: (9, 9, 9) }\n");
    return tyndall({"render", scene, "-o", path("a.exr"), "--quiet"}).err;
  };
  EXPECT_NE(err("1e13").find("8 samples were too bright"), std::string::npos) << err("1e13");
  EXPECT_NE(err("1e-21").find("lost 100% of the light: it is too dark"), std::string::npos) << err("1e-21");
  EXPECT_EQ(err("1e-9").find("film"), std::string::npos);
  EXPECT_EQ(err("1e9").find("film"), std::string::npos);
}

}  // namespace
}  // namespace tyndall::test
