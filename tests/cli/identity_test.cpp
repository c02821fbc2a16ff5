// What pictures tell of how they were made, and why one is not the one that would be rendered now.
#include "tools/identity.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"
#include "tools/staleness.h"

namespace tyndall::test {
namespace UNNAMED {

using tools::RenderArguments;

// A scene that includes a file and reads a picture, of one sample.
class Identity : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    file("fog.tyn", "let amount_of_fog = 2\n");
    paint("sky.png", 0.5f);
    write_scene("");
  }
  void paint(const std::string& name, float value) const {
    const image::Image picture{2, 2, {"R", "G", "B"}, std::vector<float>(12, value)};
    ASSERT_EQ(image::write(path(name), picture, {}), "");
  }
  void write_scene(const std::string& more) const {
    file("a.tyn",
         "include \"fog.tyn\"\n"
         "let glow = 1\n"
         "camera perspective { from: (0, 0, 4)  to: (0, 0, 0)  fov: 40deg }\n"
         "render { resolution: (8, 6)  samples: 1 }\n"
         "light environment { radiance: glow * image(\"sky.png\") }\n" +
             more);
  }
  RenderArguments arguments(const std::string& output) const {
    RenderArguments result;
    result.scene.path = path("a.tyn");
    result.scene.frame = 0;
    result.output = path(output);
    return result;
  }
  void render(const std::string& output, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{"render", path("a.tyn"), "-o", path(output), "--quiet", "--frame", "0"};
    command.insert(command.end(), options.begin(), options.end());
    const Outcome outcome = tyndall(command);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
};

using Words = std::vector<std::string>;

TEST_F(Identity, APictureThatIsAsItWouldBeIsNotStale) {
  for (const std::string name : {"a.exr", "a.png", "a.tynpart"}) {
    EXPECT_EQ(tools::why_stale(arguments(name)), Words{"it is not there"});
    render(name);
    EXPECT_EQ(tools::why_stale(arguments(name)), Words{});
    // Comments and columns are no change.
    write_scene("// a comment\n\n");
    EXPECT_EQ(tools::why_stale(arguments(name)), Words{});
    // What the scene says anyway may also be given.
    RenderArguments given = arguments(name);
    given.settings.values.samples = 1;
    given.settings.names.insert("samples");
    EXPECT_EQ(tools::why_stale(given), Words{});
    write_scene("");
  }
}

TEST_F(Identity, EachChangeIsToldByItsName) {
  using Change = std::function<void(RenderArguments&)>;
  const auto given = [](const char* name, auto member, auto value) -> Change {
    return [=](RenderArguments& a) {
      a.settings.values.*member = value;
      a.settings.names.insert(name);
    };
  };
  using Settings = scene::RenderSettings;
  const std::pair<Words, Change> changes[] = {
      {{"the scene's text has changed"}, [this](auto&) { write_scene("let other = 3\n"); }},
      {{"'fog.tyn' has changed"}, [this](auto&) { file("fog.tyn", "let amount_of_fog = 3\n"); }},
      {{"'sky.png' has changed"}, [this](auto&) { paint("sky.png", 0.25f); }},
      {{"'sky.png' cannot be read any more"}, [this](auto&) { std::filesystem::remove(path("sky.png")); }},
      {{"--set glow 2 is new"},
       [](auto& a) {
         a.scene.overrides = {{"glow", "2"}};
       }},
      {{"--include has changed"}, [](auto& a) { a.scene.include_directories = {"/tmp"}; }},
      {{"it is frame 0, not 7"}, [](auto& a) { a.scene.frame = 7; }},
      {{"--samples was 1, is 3"}, given("samples", &Settings::samples, 3)},
      {{"--seed was 0, is 5"}, given("seed", &Settings::seed, std::uint64_t{5})},
      {{"--resolution was 8x6, is 9x6"}, given("resolution", &Settings::resolution, scene::Resolution{9, 6})},
      {{"--light-samples was 1, is 2"}, given("light_samples", &Settings::light_samples, 2)},
      {{"--bounces was 1024, is 3"}, given("bounces", &Settings::bounces, 3)},
      {{"--method was decoupled, is tracking"}, [](auto& a) { a.method = render::Method::tracking; }},
      {{"--aov depth is new"}, [](auto& a) { a.aovs.add(render::Aov::depth); }},
      {{"--crop 1,1,3,3 is new"},
       [](auto& a) {
         a.crop = {1, 1, 3, 3};
       }},
      {{"--error 0.5 is new", "--samples was 1, is not given"}, [](auto& a) { a.error = 0.5; }},
  };
  for (const auto& [words, change] : changes) {
    SetUp();
    render("a.exr");
    RenderArguments now = arguments("a.exr");
    change(now);
    EXPECT_EQ(tools::why_stale(now), words) << words[0];
  }
}

TEST_F(Identity, WhatWasGivenAndIsNoMoreIsTold) {
  render("a.exr", {"--samples", "2", "--set", "glow=3", "--distance", "mis", "--sample-range", "0..1"});
  EXPECT_EQ(
      tools::why_stale(arguments("a.exr")),
      (Words{"--set glow was 3, is not given", "--distance was mis, is product", "--samples was 2, is 1"}));
}

TEST_F(Identity, InspectTellsWhatMadeAPicture) {
  for (const std::string name : {"a.exr", "a.png", "a.tynpart"}) {
    render(name, {"--set", "glow=3", "--seed", "9"});
    const Outcome text = tyndall({"inspect", path(name)});
    ASSERT_EQ(text.status, 0) << text.err;
    for (const std::string part : {"sky.png", "fog.tyn", "glow=3", "9 (option)", "0..0", "8x6"})
      EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
    const auto json = nlohmann::json::parse(tyndall({"inspect", path(name), "--json"}).out);
    EXPECT_EQ(json["files"].size(), 2u);
    EXPECT_EQ(json["frame"], 0);
    EXPECT_EQ(json["samples_of_a_pixel"], "0..0");
  }
  const Outcome foreign = tyndall({"inspect", path("sky.png")});
  EXPECT_EQ(foreign.status, 1);
  EXPECT_NE(foreign.err.find("does not tell what it was rendered from"), std::string::npos) << foreign.err;
}

}  // namespace UNNAMED
}  // namespace tyndall::test
