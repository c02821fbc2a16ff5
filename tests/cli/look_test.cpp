// `tyndall inspect` looking at shaders: slices and profiles.
#include <gtest/gtest.h>

#include <cmath>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

using Look = CliTest;

const std::string scene_text =
    "camera perspective { from: (5, 0, 9) to: (5, 0, 0) fov: 40deg }\n"
    "medium haze() {\n"
    "  let far = length(p)\n"
    "  let dust = if p.x > 0 then cells(p) + 1 else 0\n"
    "  density = 1 / (p.x + 3) + dust\n"
    "  albedo = (0.2, 0.4, 0.6)\n"
    "  phase = hg(0.5)\n"
    "}\n"
    "volume { in: box { min: (-1, -1, -2) max: (3, 1, 2) } medium: haze transform: translate((5, 0, 0)) }\n"
    "light environment { radiance: 1 }\n";

TEST_F(Look, SlicesHoldTheShadersNumbers) {
  const std::string scene = file("a.tyn", scene_text);
  const Outcome outcome = tyndall(
      {"inspect", scene, "--medium", "haze", "--slice", "z=0", "--show", "far", "-o", path("far.exr")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("far of medium haze at z = 0\n  x from -1 to 3, y from -1 to 1\n"),
            std::string::npos)
      << outcome.out;
  const image::ReadResult read = image::read(path("far.exr"));
  ASSERT_TRUE(read.image) << read.error;
  ASSERT_EQ(read.image->width, 480);
  ASSERT_EQ(read.image->height, 240);
  for (const int x : {0, 100, 479})
    for (const int y : {0, 77, 239}) {
      const double px = -1 + 4 * (x + 0.5) / 480, py = 1 - 2 * (y + 0.5) / 240;
      EXPECT_NEAR(static_cast<double>(read.image->at(x, y, 0)), std::hypot(px, py), 1e-6) << x << ' ' << y;
    }
}

TEST_F(Look, SlicesOfOtherAxesAreSeenFromTheirTips) {
  const std::string scene = file("a.tyn", scene_text);
  const Outcome above =
      tyndall({"inspect", scene, "--medium", "haze", "--slice", "y=0.5", "-o", path("y.exr")});
  EXPECT_NE(above.out.find("x from -1 to 3, z from 2 to -2"), std::string::npos) << above.out << above.err;
  const Outcome side =
      tyndall({"inspect", scene, "--medium", "haze", "--slice", "x=-0.5", "-o", path("x.exr")});
  EXPECT_NE(side.out.find("z from 2 to -2, y from -1 to 1"), std::string::npos) << side.out << side.err;
  EXPECT_NE(side.out.find("min 0.4, max 0.4, mean 0.4"), std::string::npos) << side.out;
}

TEST_F(Look, PicturesShowEveryComponentBesideAScale) {
  const std::string scene = file("a.tyn", scene_text);
  ASSERT_EQ(tyndall({"inspect", scene, "--medium", "haze", "--slice", "z=0", "--show", "albedo", "-o",
                     path("a.png")})
                .status,
            0);
  ASSERT_EQ(tyndall({"inspect", scene, "--medium", "haze", "--slice", "z=0", "-o", path("d.png")}).status, 0);
  const image::ReadResult albedo = image::read(path("a.png")), density = image::read(path("d.png"));
  ASSERT_TRUE(albedo.image && density.image);
  EXPECT_GT(density.image->width, 480);  // the plane and its scale
  EXPECT_GT(albedo.image->width, 3 * 480);
}

TEST_F(Look, SaysWhatIsThereWhenANameIsWrong) {
  const std::string scene = file("a.tyn", scene_text);
  const auto inspect = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"inspect", scene});
    return tyndall(arguments);
  };
  const Outcome no_medium = inspect({"--medium", "mist", "--slice", "z=0", "-o", path("a.png")});
  EXPECT_EQ(no_medium.status, 1);
  EXPECT_NE(no_medium.err.find("no volume with a medium 'mist' here: there is 'haze'"), std::string::npos)
      << no_medium.err;
  const Outcome no_name =
      inspect({"--medium", "haze", "--slice", "z=0", "--show", "near", "-o", path("a.png")});
  EXPECT_EQ(no_name.status, 1);
  EXPECT_NE(no_name.err.find("there is 'density', 'albedo', 'far', 'dust'"), std::string::npos)
      << no_name.err;
  const Outcome outside = inspect({"--medium", "haze", "--slice", "z=7", "-o", path("a.png")});
  EXPECT_EQ(outside.status, 1);
  EXPECT_NE(outside.err.find("its z goes from -2 to 2"), std::string::npos) << outside.err;
  for (const std::vector<std::string>& misuse : {std::vector<std::string>{"--medium", "haze"},
                                                 {"--medium", "haze", "--slice", "w=0", "-o", path("a.png")},
                                                 {"--medium", "haze", "--slice", "z=1x", "-o", path("a.png")},
                                                 {"--medium", "haze", "--slice", "z=0"},
                                                 {"--profile", "--slice", "z=0"}})
    EXPECT_EQ(inspect(misuse).status, 2) << misuse[0] << misuse[1];
}

// A medium without a name is called by its line, with its column where that is taken; the only one needs
// none.
TEST_F(Look, UnnamedMediaAreCalledByTheirLines) {
  const std::string head = "camera perspective { from: (0, 0, 9) to: (0, 0, 0) }\n";
  const auto volume = [](const std::string& medium) {
    return "volume { in: sphere {} medium: " + medium + " } ";
  };
  const auto slice = [&](const std::string& text, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"inspect", file("a.tyn", text), "--slice", "z=0", "-o", path("a.exr")});
    return tyndall(more);
  };
  const Outcome only = slice(head + volume("{ density = 2 albedo = 1 }"));
  EXPECT_EQ(only.status, 0) << only.err;
  EXPECT_NE(only.out.find("density of medium line:2 at z = 0"), std::string::npos) << only.out;

  const std::string three = head + volume("{ density = 2 albedo = 1 }") +
                            volume("{ density = 5 albedo = 1 }") + "\n" +
                            volume("{ density = 7 albedo = 1 }");
  const Outcome which = slice(three);
  EXPECT_EQ(which.status, 2);
  EXPECT_NE(which.err.find("--medium line:2 or --medium line:2:92 or --medium line:3"), std::string::npos)
      << which.err;
  for (const auto& [name, density] : {std::pair{"line:2", "2"}, {"line:2:92", "5"}, {"line:3", "7"}}) {
    const Outcome one = slice(three, {"--medium", name});
    EXPECT_EQ(one.status, 0) << one.err;
    EXPECT_NE(one.out.find(std::string("max ") + density), std::string::npos) << one.out;
  }
}

TEST_F(Look, MediaOfPlacedObjectsAreCutWhereTheyStand) {
  const std::string scene =
      file("a.tyn",
           "camera perspective { from: (0, 0, 9) to: (0, 0, 0) }\n"
           "object puff { volume { in: sphere {} medium: { density = P.x albedo = 1 } } }\n"
           "object two { place puff { transform: translate((3, 0, 0)) } }\n"
           "place two { transform: translate((4, 0, 0)) }\n");
  const Outcome outcome = tyndall({"inspect", scene, "--slice", "z=0", "-o", path("a.exr")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("mean 7\n"), std::string::npos) << outcome.out;
}

TEST_F(Look, ProfilesNameTheDearestLine) {
  const std::string scene = file("a.tyn", scene_text);
  const Outcome outcome = tyndall({"inspect", scene, "--profile"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto place = outcome.out.find("a.tyn:4: let dust = if p.x > 0 then cells(p) + 1 else 0");
  ASSERT_NE(place, std::string::npos) << outcome.out;
  const auto line = outcome.out.rfind('\n', place) + 1;
  EXPECT_GT(std::stod(outcome.out.substr(line)), 30) << outcome.out;
  EXPECT_EQ(outcome.out.find("let far"), std::string::npos) << "nothing needs it";
  const Outcome rendered = tyndall({"render", scene, "-o", path("a.exr"), "--resolution", "16x16",
                                    "--samples", "1", "--profile", "--quiet"});
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  EXPECT_NE(rendered.out.find("let dust"), std::string::npos) << rendered.out;
}

}  // namespace UNNAMED
}  // namespace tyndall::test
