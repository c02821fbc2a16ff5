// The commands beside `render`: check, inspect, compare, and the help.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"
#include "tools/commands.h"

namespace tyndall::test {
namespace UNNAMED {

using Commands = CliTest;

TEST_F(Commands, CheckLooksAtEveryScene) {
  const std::string good = file("good.tyn", small_scene()), bad = file("bad.tyn", "let a = b\n");
  const Outcome one = tyndall({"check", good});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.out, good + ": good\n");
  const Outcome both = tyndall({"check", bad, good});
  EXPECT_EQ(both.status, 1);
  EXPECT_EQ(both.out, bad + ": has errors\n" + good + ": good\n");
  EXPECT_NE(both.err.find(bad + ":1:9: error: "), std::string::npos) << both.err;
}

// A page of text is checked while a key is let go (`tyndall-bench language` measures it), since what reads
// pictures and grids is loaded for those alone.
TEST_F(Commands, CheckLoadsNothingThatReadsFiles) {
  const auto loads_a_module = [](const std::vector<std::string>& arguments) {
    RunOptions options;
    options.environment = {"LD_DEBUG=files"};
    const Outcome outcome = tyndall(arguments, options);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.err.find("libc.so"), std::string::npos) << "the loader tells of every file";
    return outcome.err.find("/modules/tyndall_") != std::string::npos;
  };
  EXPECT_FALSE(loads_a_module({"check", TYNDALL_SOURCE_DIR "/tests/language/correct.tyn"}));
  EXPECT_TRUE(loads_a_module({"render", file("a.tyn", small_scene()), "-o", path("a.png")}));
}

TEST_F(Commands, InspectPrintsEveryStage) {
  const std::string scene = file("a.tyn", small_scene());
  const std::pair<std::string, std::string> stages[] = {{"tokens", "camera"},
                                                        {"tree", "perspective"},
                                                        {"scene", "cloud"},
                                                        {"bytecode", "fbm"},
                                                        {"features", "volumes"}};
  for (const auto& [stage, word] : stages) {
    const Outcome outcome = tyndall({"inspect", scene, "--stage", stage});
    EXPECT_EQ(outcome.status, 0) << stage << outcome.err;
    EXPECT_NE(outcome.out.find(word), std::string::npos) << stage << "\n" << outcome.out;
  }
}

TEST_F(Commands, InspectTellsWhatIsProvenOfEachMedium) {
  const std::string scene = file("a.tyn", R"(camera perspective { from: (0, 0, 4)  to: (0, 0, 0)  fov: 40deg }
volume { in: box { min: (-1, -1, -1)  max: (1, 1, 1) }
         medium: { density = 9 * max(0, 0.5 - length(p) + 0.1 * noise(p * 3, time: time))  albedo = 0.9 } }
volume { in: sphere {}  medium: { density = 2  albedo = 0.5 } }
light environment { radiance: 1 }
)");
  const Outcome outcome = tyndall({"inspect", scene, "--stage", "features"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string& text = outcome.out;
  EXPECT_NE(text.find("varies in space, changes with time"), std::string::npos) << text;
  EXPECT_NE(text.find("the same everywhere"), std::string::npos) << text;
  EXPECT_NE(text.find("instructions a segment"), std::string::npos) << text;
  EXPECT_NE(text.find("registers"), std::string::npos) << text;
  // A ball of radius 0.5 to 0.6 fills 6 to 12 % of its box.
  const std::size_t cells = text.find("% proved empty");
  ASSERT_NE(cells, std::string::npos) << text;
  const double share = std::stod(text.substr(text.rfind(' ', cells - 2)));
  EXPECT_GT(share, 80) << text;
  EXPECT_LT(share, 94) << text;
  const std::size_t majorants = text.find("majorants");
  ASSERT_NE(majorants, std::string::npos) << text;
  const double tightness = std::stod(text.substr(majorants + 9));
  EXPECT_GE(tightness, 1) << text;
  EXPECT_LT(tightness, 2.1) << text;
}

TEST_F(Commands, InspectShowsTokensOfWhatCannotBeParsed) {
  const Outcome outcome = tyndall({"inspect", file("a.tyn", "let = = 3\n"), "--stage", "tokens"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("let"), std::string::npos);
}

TEST_F(Commands, CompareTellsNumbersAndFails) {
  const image::Image a{2, 1, {"R", "G", "B"}, {1, 1, 1, 1, 1, 1}},
      b{2, 1, {"R", "G", "B"}, {1, 1, 1, 1, 1, 2}};
  const image::Image wide{3, 1, {"R", "G", "B"}, {1, 1, 1, 1, 1, 2, 0, 0, 0}};
  ASSERT_EQ(image::write(path("a.exr"), a, {}), "");
  ASSERT_EQ(image::write(path("b.exr"), b, {}), "");
  ASSERT_EQ(image::write(path("wide.exr"), wide, {}), "");
  EXPECT_EQ(tyndall({"compare", path("a.exr"), path("a.exr"), "--max", "0"}).status, 0);
  const Outcome far = tyndall({"compare", path("a.exr"), path("b.exr"), "--max", "0.01", "--json"});
  EXPECT_EQ(far.status, 3);
  const auto numbers = nlohmann::json::parse(far.out);
  EXPECT_EQ(numbers["max_difference"], 1);
  EXPECT_FALSE(numbers["passed"]);
  EXPECT_EQ(tyndall({"compare", path("a.exr"), path("b.exr")}).status, 0) << "without a limit nothing fails";
  EXPECT_EQ(tyndall({"compare", path("a.exr"), path("wide.exr")}).status, 1);
  EXPECT_EQ(tyndall({"compare", path("a.exr"), path("none.exr")}).status, 1);
}

TEST_F(Commands, UnknownWordsAreToldWithWhatWasMeant) {
  const std::string scene = file("a.tyn", small_scene());
  const struct {
    std::vector<std::string> arguments;
    std::vector<std::string> told;
  } cases[] = {
      {{}, {"wants a command", "render", "compare"}},
      {{"rendre", scene, "-o", path("a.png")}, {"no command 'rendre': did you mean 'render'?", "inspect"}},
      {{"chek", scene}, {"no command 'chek': did you mean 'check'?"}},
      {{scene}, {"no command '" + scene + "'", "the commands are: render"}},
      {{"render", scene, "-o", path("a.png"), "--sampels", "3"},
       {"render has no option '--sampels': did you mean '--samples'?"}},
      {{"render", scene, "--sampels=3"}, {"render has no option '--sampels': did you mean '--samples'?"}},
      {{"check", "--sampels"}, {"check has no option '--sampels'", "tyndall check --help"}},
      {{"check", scene, "--samples", "3"}, {"check has no option '--samples': it belongs to render"}},
      {{"compare", "a.exr", "b.exr", "--medium", "fog"}, {"it belongs to inspect"}},
      {{"--samples", "3", "render", scene},
       {"before a command there is no option '--samples': it belongs to render"}},
      {{"render", scene, "more.tyn", "-o", path("a.png")}, {"does not know what to do with 'more.tyn'"}},
      {{"render", scene, "-o", path("a.png"), "--samples", "4", "--sample-range", "0..4"},
       {"--sample-range 0..4 reaches beyond the last sample of --samples 4, which is 3"}},
      {{"render", scene, "-o", path("a.tynpart"), "--error", "0.1"}, {"--error does not go with a part"}},
      {{"render", scene, "-o", path("a.tynpart"), "--time-limit", "1"},
       {"--time-limit does not go with a part"}},
  };
  for (const auto& c : cases) {
    const Outcome outcome = tyndall(c.arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    for (const std::string& words : c.told)
      EXPECT_NE(outcome.err.find(words), std::string::npos) << words << "\n" << outcome.err;
  }
}

TEST_F(Commands, AFrameOutsideOfTheAnimationIsTold) {
  const std::string scene = file("a.tyn", small_scene() + "animation { fps: 24 frames: 10..20 }\n");
  for (const std::string frame : {"9", "21", "-10"}) {
    const Outcome outcome = tyndall({"check", scene, "--frame", frame});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(
        outcome.err.find("a.tyn:12:29: warning: --frame " + frame + " is outside of these frames, 10 to 20"),
        std::string::npos)
        << outcome.err;
  }
  for (const std::string frame : {"10", "20"}) EXPECT_EQ(tyndall({"check", scene, "--frame", frame}).err, "");
  EXPECT_EQ(tyndall({"check", scene}).err, "");
}

TEST_F(Commands, HelpAndVersion) {
  const Outcome version = tyndall({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("tyndall ", 0), 0u) << version.out;
  const std::string all = tyndall({"--help"}).out;
  for (const tools::Command* command : tools::commands) {
    const Outcome help = tyndall({std::string(command->name), "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("--help"), std::string::npos);
    EXPECT_NE(help.out.find(command->help), std::string::npos) << help.out;
    EXPECT_NE(all.find(command->help), std::string::npos) << all;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
