// `tyndall measure` as a user runs it: what it finds of a scene, where it goes on, and what it refuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

using nlohmann::json;

class Measure : public CliTest {
 protected:
  // Grey smoke in even light: hardly any noise, so that the bias of a coarse step stands out.
  std::string smoke() const {
    return file("smoke.tyn", R"(render { resolution: (12, 8)  samples: 16  bounces: 0 }
camera perspective { from: (0, 0, 4)  to: (0, 0, 0)  fov: 34deg }
volume { in: sphere { radius: 1 }  medium: { density = 6 * smoothstep(1, 0.2, length(p))  albedo = 0.8 } }
light environment { radiance: 1 }
)");
  }
  json measured(std::vector<std::string> words) const {
    words.insert(words.begin(), "measure");
    words.insert(words.end(), {"--json", "--quiet"});
    const Outcome outcome = tyndall(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
  }
};

TEST_F(Measure, ACoarseStepShowsItsBiasApartFromNoise) {
  const json report =
      measured({smoke(), "--sweep", "step=1.3,0.05", "--sweep", "samples=4,64", "--reference-error", "0.03"});
  ASSERT_EQ(report["settings"].size(), 4u);
  EXPECT_TRUE(report["complete"]);
  const auto& coarse = report["settings"][1];
  const auto& fine = report["settings"][3];
  EXPECT_EQ(coarse["name"], "step 1.3, samples 64");
  EXPECT_EQ(fine["parameters"]["step"], "0.05");
  EXPECT_GT(coarse["squared_bias"]["low"], 0) << "the bias of the coarse step is proven";
  EXPECT_GT(coarse["squared_bias"]["low"], fine["squared_bias"]["high"]);
  EXPECT_LT(coarse["noise"]["value"], coarse["bias"]["value"]);
  // Bias is the same for any number of samples, and noise is not.
  const auto& few = report["settings"][0];
  EXPECT_LT(few["squared_bias"]["low"], coarse["squared_bias"]["high"]);
  EXPECT_GT(few["squared_bias"]["high"], coarse["squared_bias"]["low"]);
  EXPECT_GT(few["squared_noise"]["low"], 4 * coarse["squared_noise"]["high"].get<double>());
  for (const json& setting : report["settings"]) {
    EXPECT_EQ(setting["runs"], 4);
    EXPECT_NEAR(
        setting["relmse"]["value"],
        setting["squared_bias"]["value"].get<double>() + setting["squared_noise"]["value"].get<double>(),
        1e-9);
    EXPECT_GT(setting["peak_memory_bytes"], 1e6);
    EXPECT_GT(setting["flip"], 0);
  }
  EXPECT_TRUE(report["features"]["environment"]);
  EXPECT_LT(report["reference"]["error"]["value"], 0.03);
}

TEST_F(Measure, GoesOnFromWhatWasMeasured) {
  const std::string scene = smoke(), kept = path("kept");
  const auto runs = [&](const std::string& seeds, const std::string& steps) {
    return measured(
        {scene, "--sweep", "step=" + steps, "--seeds", seeds, "--keep", kept, "--reference-error", "1"});
  };
  const json first = runs("2", "0.4");
  const auto size = std::filesystem::file_size(kept);
  EXPECT_EQ(runs("2", "0.4")["settings"], first["settings"]) << "nothing is left to be done";
  EXPECT_EQ(std::filesystem::file_size(kept), size);
  // The last render, and the end of the last part of the reference: the same are made again.
  std::filesystem::resize_file(kept, size - (12 * 8 * 3 * sizeof(float) + 650));
  const json again = runs("2", "0.4");
  EXPECT_EQ(again["settings"][0]["relmse"], first["settings"][0]["relmse"]);
  EXPECT_EQ(again["reference"]["error"], first["reference"]["error"]);
  // More seeds and another value: three renders more; the reference is there.
  const json more = runs("3", "0.4,0.8");
  EXPECT_EQ(more["settings"][0]["runs"], 3);
  EXPECT_EQ(more["settings"][1]["runs"], 3);
  const auto picture = 12 * 8 * 3 * sizeof(float);
  EXPECT_NEAR(static_cast<double>(std::filesystem::file_size(kept)),
              static_cast<double>(size + 4 * (picture + 300)), 800);
  EXPECT_EQ(more["reference"], again["reference"]);
  // What ended within a render is dropped.
  std::filesystem::resize_file(kept, std::filesystem::file_size(kept) - 1);
  EXPECT_EQ(runs("3", "0.4,0.8")["settings"][1]["runs"], 3);
  // Another scene has other numbers.
  const Outcome other = tyndall({"measure", scene, "--frame", "7", "--budget", "1ms", "--keep", kept});
  EXPECT_EQ(other.status, 2) << "a budget has no milliseconds";
  file("smoke.tyn", read_file(scene) + "\nplane { point: (0, -1, 0)  normal: (0, 1, 0) }\n");
  const Outcome changed = tyndall({"measure", scene, "--seeds", "2", "--budget", "0.01s", "--keep", kept});
  EXPECT_EQ(changed.status, 0) << changed.err;
  EXPECT_NE(changed.err.find("which are dropped: other scene"), std::string::npos) << changed.err;
  EXPECT_NE(changed.err.find("the same command goes on from"), std::string::npos) << changed.err;
}

// The page holds the report as JSON, and its plots and table have the same numbers.
TEST_F(Measure, ThePageHasWhatTheReportHas) {
  const json report = measured({smoke(), "--sweep", "step=1,0.1", "--sweep", "samples=4,16", "--seeds", "2",
                                "--reference-error", "0.03", "-o", path("page.html")});
  const std::string page = read_file(path("page.html"));
  const std::string begin = "<script type=\"application/json\" id=\"measurements\">";
  const std::size_t at = page.find(begin);
  ASSERT_NE(at, std::string::npos);
  const std::string text = page.substr(at + begin.size(), page.find("</script>", at) - at - begin.size());
  EXPECT_EQ(json::parse(text), report);

  const auto plot = [&page](const std::string& id) {
    const std::size_t figure = page.find("<figure id=\"" + id + "\">");
    return figure == std::string::npos ? "" : page.substr(figure, page.find("</figure>", figure) - figure);
  };
  const auto numbers = [](const std::string& svg) {
    std::vector<std::pair<double, double>> found;
    const std::regex circle("data-x=\"([^\"]*)\" data-y=\"([^\"]*)\"");
    for (std::sregex_iterator it(svg.begin(), svg.end(), circle), end; it != end; ++it)
      found.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
    return found;
  };
  const auto errors = numbers(plot("error-time")), noises = numbers(plot("noise-samples")),
             biases = numbers(plot("bias-step"));
  ASSERT_EQ(errors.size(), 4u);
  ASSERT_EQ(noises.size(), 4u);
  ASSERT_EQ(biases.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const json& setting = report["settings"][i];
    EXPECT_EQ(errors[i].first, setting["cpu_seconds"]);
    EXPECT_EQ(errors[i].second, 100 * setting["error"]["value"].get<double>());
    EXPECT_EQ(noises[i].first, setting["samples"]);
    EXPECT_EQ(noises[i].second, 100 * setting["noise"]["value"].get<double>());
    EXPECT_EQ(biases[i].first, i < 2 ? 1 : 0.1);
    EXPECT_NE(page.find("<td>" + setting["name"].get<std::string>() + "</td>"), std::string::npos);
  }
  EXPECT_NE(plot("noise-samples").find("class=\"expected\""), std::string::npos);
  EXPECT_NE(plot("error-time").find("class=\"front\""), std::string::npos);
  // A reference, and of each setting two pictures and two maps; nothing comes from elsewhere.
  const std::regex pictures("<img src=\"data:image/png;base64,");
  EXPECT_EQ(std::distance(std::sregex_iterator(page.begin(), page.end(), pictures), std::sregex_iterator()),
            17);
  for (const char* elsewhere : {"http://", "https://", "<link", "src=\"/"})
    EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
}

TEST_F(Measure, TheAdviceIsABlockThatASceneTakes) {
  const json report = measured({smoke(), "--sweep", "step=0.1", "--reference-error", "0.02"});
  ASSERT_EQ(report["advice"].size(), 3u);
  const json& advice = report["advice"][0];
  ASSERT_TRUE(advice["reached"]) << advice;
  std::string text = read_file(path("smoke.tyn"));
  text.replace(0, text.find('\n'), advice["render"].get<std::string>());
  const Outcome checked = tyndall({"check", file("advised.tyn", text)});
  EXPECT_EQ(checked.status, 0) << checked.err;
  const Outcome scene = tyndall({"inspect", path("advised.tyn")});
  EXPECT_NE(scene.out.find("samples " + std::to_string(advice["samples"].get<int>())), std::string::npos)
      << scene.out;
}

TEST_F(Measure, CsvHasALinePerSetting) {
  const Outcome outcome =
      tyndall({"measure", smoke(), "--sweep", "clamp=off,(4,2)", "--seeds", "2", "--budget", "2s", "--csv"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("setting,clamp,samples_per_pixel,runs,")) << outcome.out;
  EXPECT_NE(outcome.out.find("\nclamp off,off,16,2,"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n\"clamp (4,2)\",\"(4,2)\",16,2,"), std::string::npos) << outcome.out;
}

TEST_F(Measure, AReferenceMayBeGiven) {
  const std::string scene = smoke(), small = path("small.exr"), halves = path("halves.exr");
  ASSERT_EQ(tyndall({"render", scene, "-o", small, "--resolution", "6x4"}).status, 0);
  ASSERT_EQ(tyndall({"render", scene, "-o", halves, "--step", "0.05", "--samples", "64", "--seed", "99",
                     "--aov", "half"})
                .status,
            0);
  const Outcome wrong = tyndall({"measure", scene, "--reference", small});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.err.find("has 6x4 pixels, and the scene is rendered with 12x8: give --resolution 6x4"),
            std::string::npos)
      << wrong.err;
  const json report = measured({scene, "--sweep", "step=0.1", "--reference", halves});
  EXPECT_TRUE(report["reference"]["given"]);
  EXPECT_EQ(report["reference"]["parts"], 2);
  EXPECT_GT(report["reference"]["error"]["value"], 0);
  EXPECT_LT(report["reference"]["error"]["value"], 0.1);
}

TEST_F(Measure, WhatCannotBeMeasuredIsToldWithAWayOut) {
  const std::string scene = smoke();
  const struct {
    std::vector<std::string> words;
    int status;
    const char* told;
  } rows[] = {
      {{"--sweep", "stepp=1"}, 2, "did you mean 'step'?"},
      {{"--sweep", "step="}, 2, "wants NAME=VALUE,VALUE"},
      {{"--sweep", "step"}, 2, "wants NAME=VALUE,VALUE"},
      {{"--sweep", "step=1,,2"}, 2, "a value before and after each comma"},
      {{"--sweep", "step=1,long"}, 2, "wants a length in metres above 0, auto"},
      {{"--sweep", "method=fast"}, 2, "wants one of decoupled"},
      {{"--sweep", "step=1", "--sweep", "step=2"}, 2, "step=A,B,C"},
      {{"--sweep", "resolution=32x18,64x36"}, 2, "--resolution WxH"},
      {{"--sweep", "seed=1,2"}, 2, "--seeds N"},
      {{"--seeds", "1"}, 2, "a whole number from 2"},
      {{"--budget", "10"}, 2, "a time such as 90s, 10min or 1h"},
      {{"--budget", "1e-9s"}, 2, "at least 0.001s"},
      {{"--sweep", "step=1,0.5,1"}, 2, "step=1 twice"},
      {{"--sweep", "quiet=1"}, 2, "quiet"},
      {{"--aov", "depth"}, 2, "--features"},
      {{"--features", "--sweep", "step=1", "--csv"}, 2, "--csv prints one table"},
      {{"--json", "--csv"}, 2, "--csv"},
      {{"-o", "page.txt"}, 2, "-o OUT.html"},
      {{"-o", "none/page.html"}, 1, "none"},
      {{"--keep", scene}, 1, "would overwrite the scene"},
      {{"--reference", path("none.exr")}, 1, "none.exr"},
  };
  for (const auto& row : rows) {
    std::vector<std::string> words{"measure", scene};
    words.insert(words.end(), row.words.begin(), row.words.end());
    const Outcome outcome = tyndall(words);
    EXPECT_EQ(outcome.status, row.status) << row.told << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(row.told), std::string::npos) << row.told << "\n" << outcome.err;
  }
  const Outcome foreign = tyndall({"measure", scene, "--keep", file("notes", "mine\n")});
  EXPECT_EQ(foreign.status, 1);
  EXPECT_NE(foreign.err.find("is no file of measurements"), std::string::npos) << foreign.err;
  EXPECT_EQ(read_file(path("notes")), "mine\n");
}

TEST_F(Measure, CtrlCTellsWhatIsKnown) {
  RunOptions options;
  options.wait_for_on_err = "render 2 of";
  options.interrupt_after_seconds = 0.05;
  const Outcome outcome = tyndall({"measure", smoke(), "--sweep", "samples=64,256", "--seeds", "1000",
                                   "--reference-error", "1", "--json"},
                                  options);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_FALSE(json::parse(outcome.out)["complete"]);
}

// A scene with one of each thing that can be taken out.
constexpr const char* much = R"(render { resolution: (16, 12)  samples: 4 }
animation { fps: 24  frames: 0..1  shutter: 180deg }
camera perspective { from: (0, 0, 5 + time)  to: (0, 0, 0)  aperture: 0.1 }
medium thick() { density = 3 * smoothstep(1, 0, length(p))  albedo = 0.9 }
medium thin() { density = 0.1  albedo = 0.5 }
volume { in: sphere { center: (time * 10, 0, 0) }  medium: thick }
volume { in: box { min: (-3, -3, -3)  max: (3, 3, 3) }  medium: thin }
light sphere { center: (2, 2, 2)  radius: 0.2  power: 50 }
light point { position: (-2, 2, 2)  power: 50 }
light point { position: (-2, -2, 2)  power: 50 }
light environment { radiance: 0.1 }
)";

TEST_F(Measure, EachFeatureIsTakenOut) {
  const std::string scene = file("much.tyn", much), page = path("page.html");
  const json report = measured({scene, "--features", "--seeds", "3", "--aov", "depth,albedo", "-o", page});
  EXPECT_TRUE(report["settings"].empty());
  EXPECT_TRUE(report["complete"]);
  std::vector<std::string> names;
  for (const json& row : report["feature_costs"]) {
    names.push_back(row["without"]);
    EXPECT_EQ(row["runs"], 3);
    EXPECT_GT(row["cpu_seconds"], 0);
    EXPECT_GT(row["peak_memory_bytes"], 1e6);
    EXPECT_EQ(row.contains("time_share"), !names.back().empty());
  }
  EXPECT_EQ(names, (std::vector<std::string>{
                       "", "motion blur", "all 2 media", "medium thick", "medium thin", "light environment",
                       "light point, all 2", "light point, number 1", "light point, number 2", "light sphere",
                       "depth of field", "output channel depth", "output channel albedo"}));
  // The media are nearly all that there is.
  EXPECT_GT(report["feature_costs"][2]["time_share"]["value"], 0.3) << report.dump();
  const std::string html = read_file(page);
  EXPECT_NE(html.find("id=\"costs\""), std::string::npos);
  EXPECT_NE(html.find("without medium thick"), std::string::npos);
  const Outcome csv = tyndall({"measure", scene, "--features", "--seeds", "2", "--csv", "--quiet"});
  EXPECT_EQ(csv.status, 0) << csv.err;
  EXPECT_TRUE(csv.out.starts_with("feature,runs,seconds,")) << csv.out;
  EXPECT_EQ(csv.out.find("inf"), std::string::npos) << csv.out;
}

// What is not used costs nothing to take out.
TEST_F(Measure, AStillSceneHasNoMotionToTakeOut) {
  const json report = measured({smoke(), "--features", "--seeds", "2"});
  ASSERT_EQ(report["feature_costs"].size(), 3u) << report.dump();
  EXPECT_TRUE(report["feature_costs"][1]["without"].get<std::string>().starts_with("medium"));
  EXPECT_EQ(report["feature_costs"][2]["without"], "light environment");
}

}  // namespace UNNAMED
}  // namespace tyndall::test
