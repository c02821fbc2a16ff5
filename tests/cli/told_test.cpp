// What is told of a render: numbers out of range, limits that were met. Each once, in the statistics too;
// what needs no rays before the first sample.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
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

class ToldOfARender : public CliTest, public testing::WithParamInterface<Row> {};

TEST_P(ToldOfARender, OnceAtItsPlace) {
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
    Rows, ToldOfARender,
    testing::Values(
        Row{"AlbedoAboveOne",
            "volume { in: sphere {}  medium: {\n  density = 20\n  albedo = 1 + 0.1 * p.x^2 } }\n", "6:3",
            "'albedo' is above 1 here: ", true},
        Row{"InfiniteDensity",
            "volume { in: sphere {}  medium: {\n  density = 1 / (p.x - p.x)\n  scattering = 0\n  absorption "
            "= 1 } }\n",
            "5:3", "'density' is infinite or above 1e30 here: inf at p = (", true},
        Row{"UndefinedDensity",
            "volume { in: sphere {}  medium: {\n  density = sqrt(-1 - p.x^2)\n  albedo = 0.5 } }\n", "5:3",
            "'density' is not a number here, at p = (", true},
        Row{"NegativeDensity", "volume { in: sphere {}  medium: {\n  density = p.x\n  albedo = 0.5 } }\n",
            "5:3", "'density' is below 0 here: -", true},
        Row{"PhaseParameter",
            "volume { in: sphere {}  medium: {\n  albedo = 0.5\n  phase = hg(2 * p.z + 3) } }\n", "6:3",
            "'g of hg' is above 0.9999 here: ", true},
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
        Row{"LongStep",
            "volume { in: box { min: (-1, -1, -1)  max: (1, 1, 1) }  step: 1  medium: {\n"
            "  density = 5 * smoothstep(0.5, 0.3, length(p))\n  albedo = 0 } }\n",
            "", "a step of 1 m is too long, and changes the light of the picture by about ", false},
        Row{"MissedTolerance",
            "volume { in: box { min: (-1, -1, 0)  max: (1, 1, 1) }  step: auto(0.1%)  medium: {\n"
            "  density = 1200 * exp(-((p.z - 0.3217) / 0.0015)^2)\n  albedo = 0 } }\n",
            "", "`step: auto(0.1%)` is not kept on ", true}),
    [](const auto& named) { return named.param.name; });

TEST_F(Told, LightThatBouncesCutIsToldAboveOnePercent) {
  const auto scene = [&](const std::string& density) {
    return file("a.tyn", "let thickness = " + density + R"(
render { resolution: (4, 3)  samples: 16  bounces: 8 }
camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1 }
light environment { radiance: 1 }
volume { in: sphere {}  medium: { density = thickness  albedo = 1 } }
)");
  };
  const Outcome thick = tyndall({"render", scene("20"), "-o", path("a.exr")});
  const std::size_t told = thick.err.find("warning: `bounces: 8` left out about ");
  EXPECT_NE(told, std::string::npos) << thick.err;
  EXPECT_EQ(thick.err.find("`bounces: 8`", told + 20), std::string::npos) << "once: " << thick.err;
  EXPECT_NE(thick.err.find("or more until it is below 1%"), std::string::npos) << thick.err;
  EXPECT_LT(thick.err.find("`bounces: 8` will leave out about 40 %"), told) << thick.err;
  const Outcome enough = tyndall({"render", scene("20"), "-o", path("a.exr"), "--bounces", "1000"});
  EXPECT_EQ(enough.err.find("bounces"), std::string::npos) << enough.err;
  const Outcome thin = tyndall({"render", scene("0.01"), "-o", path("a.exr")});
  EXPECT_EQ(thin.err.find("bounces"), std::string::npos) << thin.err;
}

// A value that few rays meet is told by those, as no place that is looked at before has it.
TEST_F(Told, WhatIsRareIsToldAfterwards) {
  const std::string scene =
      file("a.tyn", frame +
                        "volume { in: sphere {}  medium: {\n  density = 1 - 2e4 * max(0, "
                        "0.01 - length(p - (0.3721, 0.0013, 0.5117)))\n  albedo = 0.5 } }\n");
  const Outcome outcome =
      tyndall({"render", scene, "-o", path("a.exr"), "--samples", "2000", "--step", "0.01"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(count_of(outcome.err, "warning: "), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find("of 'density' below 0 here, taken as 0"), std::string::npos) << outcome.err;
}

// The run is ended once the warning is there: it comes before a rendering that would take hours.
TEST_F(Told, WhatNeedsNoRaysIsToldBeforeTheFirstSample) {
  const std::string scene =
      file("a.tyn", frame + "volume { in: sphere {}  medium: { density = p.x  albedo = 0.5 } }\n");
  const std::string said = "'density' is below 0 here";
  const std::vector<std::string> words{"render", scene, "-o", path("a.exr"), "--samples", "1000000000"};
  const Outcome outcome = tyndall(words, {.interrupt_after_seconds = 0.5, .wait_for_on_err = said});
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(count_of(outcome.err, said), 1u) << outcome.err;
  std::vector<std::string> strict = words;
  strict.push_back("--strict");
  fs::remove(path("a.exr"));
  const Outcome refused = tyndall(strict);
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(count_of(refused.err, "error: " + said), 1u) << refused.err;
  EXPECT_FALSE(fs::exists(path("a.exr")));
}

// Warnings are of what will be rendered, whatever the scene's own settings.
TEST_F(Told, SettingsOfTheCommandLineAreHeeded) {
  const std::string scene = file("a.tyn", R"(render { resolution: (40, 40)  samples: 1 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }
light environment { radiance: 1 }
sphere {}
volume { in: sphere { center: (4, 0, 0) }  medium: { density = 1 + 0.5 * sin(9 * p.y)  albedo = 0.5 } }
)");
  const auto err = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"render", scene, "-o", path("a.exr"), "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    return tyndall(words).err;
  };
  EXPECT_EQ(count_of(err({}), "nothing of this volume is in the picture"), 1u);
  EXPECT_EQ(err({"--resolution", "120x40"}), "");
  EXPECT_NE(err({"--resolution", "120x40", "--step", "5"}).find("a step of 5 m is longer than this volume"),
            std::string::npos);
}

// No false alarms over what is shown to users.
TEST_F(Told, ScenesOfTheGalleryAreNotWarnedOf) {
  std::vector<std::string> words{"check"};
  for (const auto& entry : fs::recursive_directory_iterator(TYNDALL_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".tyn") words.push_back(entry.path().string());
  EXPECT_GT(words.size(), 25u);
  const Outcome outcome = tyndall(words);
  EXPECT_EQ(outcome.status, 0);
  // Bounces are left out for the sake of time.
  EXPECT_EQ(count_of(outcome.err, "warning: "), count_of(outcome.err, "warning: `bounces: ")) << outcome.err;
}

TEST_F(Told, LightThatTheFilmCannotHold) {
  const auto err = [&](const std::string& radiance) {
    const std::string scene = file("a.tyn", "let sky = " + radiance + R"(
render { resolution: (2, 2)  samples: 2 }
camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1 }
light environment { radiance: sky }
sphere { center: (9, 9, 9) }
)");
    return tyndall({"render", scene, "-o", path("a.exr"), "--quiet"}).err;
  };
  EXPECT_NE(err("1e13").find("8 samples were too bright"), std::string::npos) << err("1e13");
  EXPECT_NE(err("1e-21").find("lost 100% of the light: it is too dark"), std::string::npos) << err("1e-21");
  EXPECT_EQ(err("1e-9").find("film"), std::string::npos);
  EXPECT_EQ(err("1e9").find("film"), std::string::npos);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
