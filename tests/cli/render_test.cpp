// `tyndall render`: pictures, options, statistics, interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/compare.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

using Render = CliTest;

std::string text_of(const image::Metadata& metadata, const std::string& name) {
  for (const auto& [key, value] : metadata)
    if (key == name) return value;
  return {};
}

image::Image picture(const std::string& path) {
  const image::ReadResult result = image::read(path);
  EXPECT_TRUE(result.image) << result.error;
  return result.image.value_or(image::Image{});
}

TEST_F(Render, WritesAPictureThatIsNotBlack) {
  const std::string scene = file("a.tyn", small_scene());
  const Outcome outcome = tyndall({"render", scene, "-o", path("a.exr")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const image::Image image = picture(path("a.exr"));
  EXPECT_EQ(image.width, 16);
  EXPECT_EQ(image.height, 12);
  EXPECT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_GT(image::compare(image, image).mean, 0);
  EXPECT_EQ(image::count_not_finite(image), 0u);
  EXPECT_NE(outcome.err.find("16x12, 2 samples per pixel"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(file_count(), 2u) << "nothing is left beside";
}

TEST_F(Render, MetadataTellWhatDecidedThePicture) {
  const std::string scene = file("a.tyn", small_scene());
  ASSERT_EQ(tyndall({"render", scene, "-o", path("a.exr"), "--seed", "17", "--sample-range", "1..3", "--step",
                     "0.3"})
                .status,
            0);
  const image::Metadata metadata = image::read(path("a.exr")).metadata;
  EXPECT_EQ(text_of(metadata, "tyndall:seed"), "17");
  EXPECT_EQ(text_of(metadata, "tyndall:samples"), "1..3");
  EXPECT_EQ(text_of(metadata, "tyndall:frame"), "0");
  EXPECT_EQ(text_of(metadata, "tyndall:scene_hash").size(), 16u);
  EXPECT_NE(text_of(metadata, "tyndall:settings").find("step=0.3 "), std::string::npos);
  EXPECT_NE(text_of(metadata, "tyndall:simd"), "");

  ASSERT_EQ(
      tyndall({"render", file("b.tyn", small_scene() + "// another comment\n"), "-o", path("b.exr")}).status,
      0);
  const std::string hash = text_of(metadata, "tyndall:scene_hash");
  EXPECT_EQ(text_of(image::read(path("b.exr")).metadata, "tyndall:scene_hash"), hash);
  ASSERT_EQ(tyndall({"render", scene, "-o", path("c.exr"), "--set", "thickness=4"}).status, 0);
  EXPECT_NE(text_of(image::read(path("c.exr")).metadata, "tyndall:scene_hash"), hash);
}

TEST_F(Render, ThreadsDoNotChangeAByte) {
  const std::string scene = file("a.tyn", small_scene());
  for (const std::string extension : {".exr", ".png"}) {
    ASSERT_EQ(tyndall({"render", scene, "-o", path("one" + extension), "--threads", "1"}).status, 0);
    ASSERT_EQ(tyndall({"render", scene, "-o", path("two" + extension), "--threads", "2"}).status, 0);
    EXPECT_EQ(read_file(path("one" + extension)), read_file(path("two" + extension))) << extension;
    EXPECT_FALSE(read_file(path("one" + extension)).empty());
  }
}

TEST_F(Render, OptionsTakeThePlaceOfSettings) {
  const std::string scene = file("a.tyn", small_scene());
  ASSERT_EQ(tyndall({"render", scene, "-o", path("a.png"), "--resolution", "9x7", "--samples", "1",
                     "--bounces", "0", "--light-samples", "2", "--distance", "equiangular", "--transmittance",
                     "jackknife", "--stats", path("a.json"), "--quiet"})
                .status,
            0);
  EXPECT_EQ(picture(path("a.png")).width, 9);
  const auto statistics = nlohmann::json::parse(read_file(path("a.json")));
  EXPECT_EQ(statistics["samples"], 9 * 7);
  EXPECT_EQ(statistics["resolution"], (nlohmann::json{9, 7}));
}

TEST_F(Render, CropKeepsItsPixelsAndLeavesTheOthersBlack) {
  const std::string scene = file("a.tyn", small_scene());
  ASSERT_EQ(tyndall({"render", scene, "-o", path("all.exr")}).status, 0);
  ASSERT_EQ(tyndall({"render", scene, "-o", path("crop.exr"), "--crop", "4,3,9,8"}).status, 0);
  const image::Image all = picture(path("all.exr")), crop = picture(path("crop.exr"));
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool inside = x >= 4 && x < 9 && y >= 3 && y < 8;
      EXPECT_EQ(crop.at(x, y, 0), inside ? all.at(x, y, 0) : 0) << x << "," << y;
    }
}

TEST_F(Render, StatisticsCountTheRun) {
  const std::string scene = file("a.tyn", small_scene());
  const Outcome outcome =
      tyndall({"render", scene, "-o", path("a.exr"), "--stats", path("a.json"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto statistics = nlohmann::json::parse(read_file(path("a.json")));
  for (const char* stage : {"read", "parse", "resolve", "compile", "render", "write"})
    EXPECT_GE(statistics["seconds"][stage].get<double>(), 0) << stage;
  EXPECT_EQ(statistics["samples"], 16 * 12 * 2);
  EXPECT_GE(statistics["rays"], statistics["samples"]);
  EXPECT_GT(statistics["marches"], 0);
  EXPECT_GT(statistics["segments"], statistics["marches"]);
  EXPECT_GE(statistics["vm"]["lanes_issued"], statistics["vm"]["lanes_used"]);
  EXPECT_GT(statistics["vm"]["lanes_used"], 0);
  EXPECT_EQ(statistics["bad_samples"], 0);
  EXPECT_TRUE(statistics["bad_values"].empty());
  EXPECT_GT(statistics["peak_memory_bytes"], 1 << 20);
  EXPECT_FALSE(statistics["interrupted"]);
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["samples"], statistics["samples"]);
}

TEST_F(Render, ReplayTellsOfOneSample) {
  const std::string scene = file("a.tyn", small_scene());
  const Outcome outcome = tyndall({"render", scene, "--pixel", "8,6", "--sample", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("radiance "), std::string::npos) << outcome.out;
}

TEST_F(Render, ReplayedSamplesAddUpToThePixel) {
  const std::string scene = file("a.tyn", small_scene());
  ASSERT_EQ(tyndall({"render", scene, "-o", path("a.exr")}).status, 0);
  double sum = 0;
  for (const std::string sample : {"0", "1"})
    sum += nlohmann::json::parse(
               tyndall({"render", scene, "--pixel", "7,5", "--sample", sample, "--json"}).out)["radiance"][0]
               .get<double>();
  EXPECT_NEAR(picture(path("a.exr")).at(7, 5, 0), sum / 2, 1e-6 * sum);
}

// Bad values of a shader: taken as 0 and told with the shader's line, or an error with --strict.
TEST_F(Render, BadValuesOfAShaderAreToldAtItsLine) {
  std::string text = small_scene();
  const std::string good = "density = amount * smoothstep(1, 0.2, length(p) + 0.3 * fbm(p * 2, octaves: 3))";
  text.replace(text.find(good), good.size(), "density = p.x");
  const std::string scene = file("a.tyn", text);
  const Outcome outcome = tyndall({"render", scene, "-o", path("a.exr")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find(scene + ":5:3: warning: 'density' is below 0 here"), std::string::npos)
      << outcome.err;
  const Outcome strict = tyndall({"render", scene, "-o", path("a.exr"), "--strict"});
  EXPECT_EQ(strict.status, 1);
  EXPECT_NE(strict.err.find(scene + ":5:3: error: 'density' is below 0 here"), std::string::npos)
      << strict.err;
}

// The outputs beside the picture do not change it, and the parts of its light are no more than the whole.
TEST_F(Render, AovsStandBesideThePicture) {
  const std::string scene = file("a.tyn", small_scene());
  ASSERT_EQ(tyndall({"render", scene, "-o", path("plain.exr")}).status, 0);
  ASSERT_EQ(tyndall({"render", scene, "-o", path("a.exr"), "--aov",
                     "depth,normal,albedo,volume_direct,volume_indirect,volume_emission,transmittance,"
                     "optical_depth,samples,cost"})
                .status,
            0);
  const image::Image plain = picture(path("plain.exr")), image = picture(path("a.exr"));
  const auto at = [&](int x, int y, const std::string& name) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    EXPECT_NE(found, image.channels.end()) << name;
    return image.at(x, y, static_cast<std::size_t>(found - image.channels.begin()));
  };
  double direct = 0, indirect = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      EXPECT_EQ(at(x, y, "R"), plain.at(x, y, 0));
      EXPECT_EQ(at(x, y, "samples"), 2);
      EXPECT_GE(at(x, y, "cost"), 1);
      EXPECT_LE(at(x, y, "volume_direct.R") + at(x, y, "volume_indirect.R") + at(x, y, "volume_emission.R"),
                at(x, y, "R") * 1.0001f + 1e-6f);
      // By Jensen's inequality the mean transmittance is no less than that of the mean optical depth.
      EXPECT_GE(at(x, y, "transmittance.G"), std::exp(-at(x, y, "optical_depth")) - 1e-5f);
      EXPECT_LE(at(x, y, "albedo.G"), 1.0001f);
      direct += at(x, y, "volume_direct.R");
      indirect += at(x, y, "volume_indirect.R");
    }
  EXPECT_GT(direct, 0);
  EXPECT_GT(indirect, 0);
}

TEST_F(Render, AnErrorIsReachedAndTold) {
  const std::string scene = file("a.tyn", small_scene());
  const Outcome outcome = tyndall({"render", scene, "-o", path("a.exr"), "--error", "0.15", "--stats",
                                   path("a.json"), "--aov", "samples,variance"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto statistics = nlohmann::json::parse(read_file(path("a.json")));
  EXPECT_LT(statistics["estimated_error"], 0.15);
  EXPECT_GE(statistics["samples"], 64 * 16 * 12);
  EXPECT_NE(outcome.err.find("estimated error 0."), std::string::npos) << outcome.err;
  // Measured against many other samples, the error is what was asked for: relmse is its square.
  ASSERT_EQ(tyndall({"render", scene, "-o", path("many.exr"), "--samples", "4096", "--seed", "5"}).status, 0);
  image::Image some = picture(path("a.exr")), picture_only{some.width, some.height, {"R", "G", "B"}, {}};
  for (std::size_t i = 0; i < some.pixels.size(); i += some.channels.size())
    picture_only.pixels.insert(picture_only.pixels.end(),
                               {some.pixels[i], some.pixels[i + 1], some.pixels[i + 2]});
  const double error = std::sqrt(image::compare(picture_only, picture(path("many.exr"))).relative_mse);
  EXPECT_LT(error, 1.3 * 0.15);
  EXPECT_GT(error, 0.01);
}

TEST_F(Render, ATimeLimitEndsTheRender) {
  const std::string scene = file("a.tyn", small_scene());
  const Outcome outcome =
      tyndall({"render", scene, "-o", path("a.exr"), "--time-limit", "0.5", "--stats", path("a.json")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto statistics = nlohmann::json::parse(read_file(path("a.json")));
  EXPECT_TRUE(statistics["out_of_time"]);
  EXPECT_EQ(statistics["samples"].get<int>() % (16 * 12), 0) << "whole passes";
  EXPECT_GT(statistics["samples"], 16 * 12);
}

TEST_F(Render, GoalsAndPartsExcludeEachOther) {
  const std::string scene = file("a.tyn", small_scene());
  for (const std::string goal : {"--error", "--time-limit"}) {
    EXPECT_EQ(tyndall({"render", scene, "-o", path("a.exr"), goal, "1", "--crop", "0,0,4,4"}).status, 2);
    EXPECT_EQ(tyndall({"render", scene, "-o", path("a.exr"), goal, "1", "--sample-range", "0..3"}).status, 2);
    EXPECT_EQ(tyndall({"render", scene, "-o", path("a.exr"), goal, "-1"}).status, 2);
  }
  const Outcome unknown = tyndall({"render", scene, "-o", path("a.exr"), "--aov", "depth,deep"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("optical_depth"), std::string::npos) << unknown.err;
  EXPECT_EQ(tyndall({"render", scene, "-o", path("a.png"), "--aov", "depth"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
}

TEST_F(Render, CtrlCSavesWhatThereIs) {
  const std::string scene = file("a.tyn", small_scene());
  const Outcome outcome = tyndall({"render", scene, "-o", path("a.exr"), "--samples", "100000000", "--stats",
                                   path("a.json"), "--checkpoint-interval", "0.1"},
                                  {.interrupt_after_seconds = 1e-3, .wait_for = appears("a.exr.checkpoint")});
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  const image::ReadResult saved = image::read(path("a.exr"));
  ASSERT_TRUE(saved.image) << saved.error << outcome.err;
  EXPECT_GT(image::compare(*saved.image, *saved.image).mean, 0);
  EXPECT_NE(text_of(saved.metadata, "tyndall:interrupted"), "");
  EXPECT_TRUE(nlohmann::json::parse(read_file(path("a.json")))["interrupted"]);
}

TEST_F(Render, QuietIsQuiet) {
  const Outcome outcome =
      tyndall({"render", file("a.tyn", small_scene()), "-o", path("a.png"), "--quiet", "--bounces", "32"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, "");
}

}  // namespace UNNAMED
}  // namespace tyndall::test
