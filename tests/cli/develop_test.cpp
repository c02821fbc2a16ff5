// `tyndall develop`: a picture is rendered once and looked at in many ways.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cli/run_program.h"
#include "image/image.h"
#include "tools/staleness.h"

namespace tyndall::test {
namespace UNNAMED {

using image::Image;

class Develop : public CliTest {
 protected:
  Image read(const std::string& name) const {
    const image::ReadResult result = image::read(path(name));
    EXPECT_TRUE(result.image) << result.error;
    return result.image.value_or(Image{});
  }
  std::string write(const std::string& name, const Image& image) const {
    EXPECT_EQ(image::write(path(name), image, {}, {}), "");
    return path(name);
  }
  Outcome develop(const std::string& from, const std::string& to,
                  const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{"develop", path(from), "-o", path(to)};
    command.insert(command.end(), options.begin(), options.end());
    return tyndall(command);
  }
  void render(const std::string& output, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{"render", file("a.tyn", small_scene()), "-o", path(output), "--quiet"};
    command.insert(command.end(), options.begin(), options.end());
    const Outcome outcome = tyndall(command);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  std::string inspected(const std::string& name) const { return tyndall({"inspect", path(name)}).out; }
};

// A row of grey from dark to far beyond white.
Image wedge() {
  Image image{24, 2, {"R", "G", "B"}, {}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 24; ++x)
      image.pixels.insert(image.pixels.end(), 3, std::exp2(static_cast<float>(x - 12)));
  return image;
}

// The view of a render is that of `develop`: pixel for pixel, with every way of saying it.
TEST_F(Develop, ShowsWhatRenderShows) {
  for (const std::vector<std::string>& view : {std::vector<std::string>{},
                                               {"--exposure", "1.5"},
                                               {"--exposure", "auto(-1)", "--tonemap", "neutral"},
                                               {"--tonemap", "none"}}) {
    render("a.exr", view);
    render("a.png", view);
    EXPECT_EQ(develop("a.exr", "b.png").status, 0);
    EXPECT_EQ(read("a.png").pixels, read("b.png").pixels);
    render("c.exr");
    EXPECT_EQ(develop("c.exr", "c.png", view).status, 0);
    EXPECT_EQ(read("a.png").pixels, read("c.png").pixels);
    // Light is the same, however it is to be shown.
    EXPECT_EQ(read("a.exr").pixels, read("c.exr").pixels);
  }
}

TEST_F(Develop, CurvesKeepHighlightsAndNoneClampsThem) {
  write("wedge.exr", wedge());
  ASSERT_EQ(develop("wedge.exr", "usual.png").status, 0);
  ASSERT_EQ(develop("wedge.exr", "none.png", {"--tonemap", "none"}).status, 0);
  ASSERT_EQ(develop("wedge.exr", "none.tif", {"--tonemap", "none", "--exposure", "-2"}).status, 0);
  ASSERT_EQ(develop("wedge.exr", "none.jpg", {"--tonemap", "none"}).status, 0);
  const Image usual = read("usual.png"), none = read("none.png"), darker = read("none.tif"),
              jpeg = read("none.jpg");
  for (int x = 0; x < 24; ++x) {
    const double light = std::exp2(x - 12);
    // Half a step of 8 or 16 bits in sRGB is so much light at most.
    EXPECT_NEAR(none.at(x, 1, 2), std::min(light, 1.0), 0.0045) << x;
    EXPECT_NEAR(jpeg.at(x, 1, 2), std::min(light, 1.0), 0.05) << x;
    EXPECT_NEAR(darker.at(x, 1, 2), std::min(light / 4, 1.0), 2e-5) << x;
    if (x > 4 && x < 15) {
      EXPECT_GT(usual.at(x, 0, 0), usual.at(x - 1, 0, 0)) << x;
    }
  }
  EXPECT_EQ(none.at(12, 0, 0), 1);
  EXPECT_LT(usual.at(12, 0, 0), 0.85f);
}

TEST_F(Develop, ACropIsACutOfTheWhole) {
  render("a.exr");
  const std::vector<std::string> view{"--exposure", "auto", "--bloom", "0.1", "--white-balance", "3200"};
  ASSERT_EQ(develop("a.exr", "whole.png", view).status, 0);
  std::vector<std::string> with_crop = view;
  with_crop.insert(with_crop.end(), {"--crop", "3,2,9,7"});
  ASSERT_EQ(develop("a.exr", "cut.png", with_crop).status, 0);
  const Image whole = read("whole.png"), cut = read("cut.png");
  ASSERT_EQ(cut.width, 6);
  ASSERT_EQ(cut.height, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 6; ++x)
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(cut.at(x, y, c), whole.at(x + 3, y + 2, c));
  EXPECT_NE(develop("a.exr", "no.png", {"--crop", "0,0,17,3"}).err.find("which is 16x12"), std::string::npos);
  EXPECT_EQ(develop("a.exr", "no.png", {"--crop", "5,0,5,3"}).status, 2);
}

// An .exr of it is light: twice as much of it a stop up, without a curve.
TEST_F(Develop, AnExrStaysLinear) {
  write("wedge.exr", wedge());
  ASSERT_EQ(develop("wedge.exr", "more.exr", {"--exposure", "1", "--tonemap", "neutral"}).status, 0);
  const Image more = read("more.exr"), light = wedge();
  for (std::size_t i = 0; i < light.pixels.size(); ++i) EXPECT_EQ(more.pixels[i], 2 * light.pixels[i]);
  // And is shown as its view says, the exposure being done.
  ASSERT_EQ(develop("more.exr", "a.png").status, 0);
  ASSERT_EQ(develop("wedge.exr", "b.png", {"--exposure", "1", "--tonemap", "neutral"}).status, 0);
  EXPECT_EQ(read("a.png").pixels, read("b.png").pixels);
}

TEST_F(Develop, ALampOfATemperatureBecomesGrey) {
  // blackbody(2000K), as a scene would have it.
  const std::string scene = R"(
camera perspective { from: (0, 0, 4)  to: (0, 0, 0) }
render { resolution: (4, 4)  samples: 1 }
light environment { radiance: 0.2 * blackbody(2000K) }
)";
  ASSERT_EQ(tyndall({"render", file("lamp.tyn", scene), "-o", path("lamp.exr"), "--quiet"}).status, 0);
  ASSERT_EQ(develop("lamp.exr", "grey.exr", {"--white-balance", "2000K"}).status, 0);
  const Image lamp = read("lamp.exr"), grey = read("grey.exr");
  EXPECT_GT(lamp.pixels[0], 3 * lamp.pixels[2]);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(grey.pixels[c], 0.2f, 1e-4f);
}

TEST_F(Develop, PicturesOfOtherProgramsAreShown) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinite = std::numeric_limits<float>::infinity();
  write("bad.exr", {3, 1, {"R", "G", "B"}, {nan, 1, 1, infinite, infinite, infinite, -3, -0.5f, 1}});
  const Outcome bad = develop("bad.exr", "bad.png", {"--tonemap", "none", "--bloom", "0.5"});
  EXPECT_EQ(bad.status, 0) << bad.err;
  EXPECT_NE(bad.err.find("1 pixel with values that are no numbers"), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find("1 pixel with infinite values"), std::string::npos) << bad.err;
  const Image shown = read("bad.png");
  EXPECT_EQ(shown.pixels[0], 0);
  EXPECT_EQ(shown.pixels[3], 1);
  EXPECT_EQ(shown.pixels[6], 0);

  write("grey.exr", {2, 1, {"Y"}, {0.25f, 4}});
  EXPECT_EQ(develop("grey.exr", "grey.png", {"--tonemap", "none"}).status, 0);
  EXPECT_NEAR(read("grey.png").pixels[0], 0.25f, 0.0045f);

  write("layer.exr", {1, 1, {"A", "beauty.B", "beauty.G", "beauty.R", "Z"}, {1, 0, 0, 1, 9}});
  EXPECT_EQ(develop("layer.exr", "layer.png", {"--tonemap", "none"}).status, 0);
  const Image layer = read("layer.png");
  EXPECT_EQ(layer.pixels, (std::vector<float>{1, 0, 0}));
}

TEST_F(Develop, OutputChannelsAreLayers) {
  render("a.exr", {"--aov", "albedo,depth"});
  EXPECT_EQ(develop("a.exr", "albedo.exr", {"--layer", "albedo"}).status, 0);
  EXPECT_EQ(read("albedo.exr").channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(develop("a.exr", "depth.png", {"--layer", "depth", "--exposure", "auto"}).status, 0);
  const Outcome none = develop("a.exr", "no.png", {"--layer", "albedos"});
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("has no layer 'albedos'"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("--layer albedo"), std::string::npos) << none.err;
}

TEST_F(Develop, WhatCannotBeShownIsRefused) {
  write("two.exr", {1, 1, {"G", "R"}, {1, 1}});
  write("layers.exr", {1, 1, {"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"}, std::vector<float>(6, 1.0f)});
  write("good.exr", wedge());
  file("text.exr", "no picture");
  file("a.tyn", small_scene());
  file("a.tynpart", "");
  const struct {
    std::string picture;
    std::vector<std::string> options;
    int status;
    const char* told;
  } rows[] = {
      {"none.exr", {}, 1, "no such file"},
      {"text.exr", {}, 1, "cannot read"},
      {"a.tyn", {}, 1, "is a scene: render it"},
      {"a.tynpart", {}, 1, "merge the parts"},
      {"two.exr", {}, 1, "has no R, G and B: its channels are"},
      {"layers.exr", {}, 1, "--layer a, --layer b"},
      {"good.exr", {"--exposure", "bright"}, 2, "stops, auto, or"},
      {"good.exr", {"--tonemap", "acess"}, 2, "wants one of film, agx, neutral, none"},
      {"good.exr", {"--bloom", "1.5"}, 2, "from 0 to 1"},
      {"good.exr", {"--white-balance", "200"}, 2, "1000 to 40000"},
      {"good.exr", {"--white-balance", "0,0,0"}, 2, "its colour"},
      {"good.exr", {"-o", path("a.bmp")}, 1, ".exr, .png, .jpg or .tif"},
      {"good.exr", {"-o", path("good.exr")}, 1, "would overwrite the picture"},
  };
  const std::size_t before = file_count();
  for (const auto& row : rows) {
    const Outcome outcome = develop(row.picture, "no.png", row.options);
    EXPECT_EQ(outcome.status, row.status) << row.picture << outcome.err;
    EXPECT_NE(outcome.err.find(row.told), std::string::npos) << row.told << "\n" << outcome.err;
  }
  EXPECT_EQ(file_count(), before);
}

// What a picture tells of its making goes with it, and what was done to it since.
TEST_F(Develop, PicturesTellHowTheyWereDeveloped) {
  render("a.exr", {"--seed", "7"});
  for (const std::string name : {"a.png", "a.jpg", "a.tif", "b.exr"}) {
    ASSERT_EQ(develop("a.exr", name, {"--exposure", "1", "--bloom", "0.25"}).status, 0);
    const std::string told = inspected(name);
    EXPECT_NE(told.find("7 (option)"), std::string::npos) << name << told;
    EXPECT_NE(told.find("exposure=1 tonemap=film bloom=0.25"), std::string::npos) << name << told;
  }
  for (const std::string name : {"r.png", "r.jpg", "r.tif"}) {
    render(name, {"--exposure", "auto", "--tonemap", "neutral"});
    const std::string told = inspected(name);
    EXPECT_NE(told.find("auto (option)"), std::string::npos) << name << told;
    EXPECT_NE(told.find("neutral (option)"), std::string::npos) << name << told;
  }
}

TEST_F(Develop, AViewMakesPicturesStaleAndLightNot) {
  tools::RenderArguments arguments;
  arguments.scene.path = path("a.tyn");
  for (const std::string name : {"a.exr", "a.png", "a.jpg", "a.tynpart"}) {
    render(name);
    arguments.output = path(name);
    arguments.view = {};
    EXPECT_TRUE(tools::why_stale(arguments).empty()) << name;
    arguments.view.exposure = image::Exposure{1};
    arguments.view.tonemap = image::Tonemap::none;
    const std::vector<std::string> why = tools::why_stale(arguments);
    if (name == "a.exr" || name == "a.tynpart") {
      EXPECT_TRUE(why.empty()) << name;
    } else {
      EXPECT_EQ(why, (std::vector<std::string>{"--exposure was 0, is 1", "--tonemap was film, is none"}))
          << name;
    }
  }
  // A developed picture is not what rendering would give.
  ASSERT_EQ(develop("a.exr", "b.png").status, 0);
  arguments.output = path("b.png");
  arguments.view = {};
  EXPECT_EQ(tools::why_stale(arguments), std::vector<std::string>{"it was developed from another picture"});
}

// What the scene itself says of its view: light that is there tells it anew, and is not rendered again.
TEST_F(Develop, AViewInTheSceneIsToldAnewWithoutRendering) {
  const auto scene = [&](const std::string& view) {
    return file("b.tyn", "camera perspective {\n  from: (0, 0, 4)  to: (0, 0, 0)\n  " + view +
                             "\n}\nrender { resolution: (8, 6)  samples: 1 }\n"
                             "light environment { radiance: 0.3 }\n");
  };
  const auto render = [&](const std::string& output) {
    return tyndall({"render", path("b.tyn"), "-o", path(output), "--resume"});
  };
  scene("exposure: 0  tonemap: film");
  for (const std::string output : {"a.exr", "a.tynpart", "a.png"}) ASSERT_EQ(render(output).status, 0);
  const Image before = read("a.exr");
  for (const auto& [view, exposure, tonemap] :
       {std::tuple("exposure: -2  tonemap: none", image::Exposure{-2}, image::Tonemap::none),
        {"tonemap: neutral, exposure: auto(1)", image::Exposure{1, true}, image::Tonemap::neutral},
        {"exposure: auto", image::Exposure{0, true}, image::Tonemap::film}}) {
    scene(view);
    for (const std::string output : {"a.exr", "a.tynpart"}) {
      const Outcome outcome = render(output);
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_NE(outcome.err.find("it is there already"), std::string::npos) << view << outcome.err;
    }
    const image::ReadResult now = image::read(path("a.exr"));
    ASSERT_TRUE(now.image) << now.error;
    EXPECT_EQ(now.image->pixels, before.pixels);
    EXPECT_EQ(now.view, (image::View{.exposure = exposure, .tonemap = tonemap})) << view;
    EXPECT_EQ(render("a.png").err.find("it is there already"), std::string::npos) << view;
    ASSERT_EQ(develop("a.exr", "b.png").status, 0);
    EXPECT_EQ(read("a.png").pixels, read("b.png").pixels) << view;
    ASSERT_EQ(tyndall({"merge", path("a.tynpart"), "-o", path("c.png")}).status, 0);
    EXPECT_EQ(read("a.png").pixels, read("c.png").pixels) << view;
  }
  // What depends on anything may decide light as well.
  scene("exposure: 1 + 1");
  EXPECT_EQ(render("a.exr").err.find("it is there already"), std::string::npos);
}

// Parts hold light, and how it is to be shown.
TEST_F(Develop, PartsAreMergedToWhatRenderShows) {
  const std::vector<std::string> view{"--exposure", "auto", "--tonemap", "neutral", "--samples", "4"};
  std::vector<std::string> first = view, second = view;
  first.insert(first.end(), {"--sample-range", "0..1"});
  second.insert(second.end(), {"--sample-range", "2..3"});
  render("a.tynpart", first);
  render("b.tynpart", second);
  for (const std::string kind : {".png", ".exr"}) {
    render("whole" + kind, view);
    ASSERT_EQ(tyndall({"merge", path("a.tynpart"), path("b.tynpart"), "-o", path("merged" + kind)}).status,
              0);
    EXPECT_EQ(read_file(path("merged" + kind)), read_file(path("whole" + kind))) << kind;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
