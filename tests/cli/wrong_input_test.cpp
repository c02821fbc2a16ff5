// Wrong input never crashes: each kind gets a clear error and the right exit status.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"

namespace tyndall::test {
namespace UNNAMED {

using WrongInput = CliTest;

// Rendering the text must fail with status 1 and an error that has the words, and leave no picture.
#define EXPECT_REFUSED(outcome, words)                             \
  EXPECT_EQ((outcome).status, 1) << (outcome).err.substr(0, 2000); \
  EXPECT_NE((outcome).err.find("error: "), std::string::npos);     \
  EXPECT_NE((outcome).err.find(words), std::string::npos) << (outcome).err.substr(0, 2000)

std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  result.reserve(text.size() * times);
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

TEST_F(WrongInput, MissingScene) {
  const Outcome outcome = tyndall({"render", path("none.tyn"), "-o", path("a.png")});
  EXPECT_REFUSED(outcome, "none.tyn");
  EXPECT_NE(outcome.err.find("No such file"), std::string::npos) << outcome.err;
}

TEST_F(WrongInput, DirectoryAsScene) {
  EXPECT_REFUSED(tyndall({"render", path(""), "-o", path("a.png")}), "it is a directory");
}

TEST_F(WrongInput, EmptyFile) {
  EXPECT_REFUSED(tyndall({"render", file("empty.tyn", ""), "-o", path("a.png")}), "camera");
}

TEST_F(WrongInput, BinaryRubbish) {
  std::string rubbish;
  unsigned state = 1;
  for (int i = 0; i < 20000; ++i) rubbish += static_cast<char>((state = state * 1664525 + 1013904223) >> 24);
  const Outcome outcome = tyndall({"render", file("rubbish.tyn", rubbish), "-o", path("a.png")});
  EXPECT_REFUSED(outcome, "rubbish.tyn:");
  EXPECT_LT(outcome.err.size(), 100000u) << "a file of rubbish is not answered with pages of it";
}

TEST_F(WrongInput, TenThousandParentheses) {
  const std::string deep = "let a = " + repeated("(", 10000) + "1" + repeated(")", 10000) + "\n";
  EXPECT_REFUSED(tyndall({"render", file("deep.tyn", deep), "-o", path("a.png")}), "deep.tyn:1:");
  EXPECT_REFUSED(
      tyndall({"render", file("open.tyn", "let a = " + repeated("(", 10000)), "-o", path("a.png")}),
      "open.tyn:1:");
}

TEST_F(WrongInput, OtherDeepNests) {
  const std::pair<std::string, std::string> nests[] = {
      {"[", "]"}, {"-", ""}, {"f(", ")"}, {"if true then 1 else ", ""}, {"1 ^ ", ""}, {"not ", ""}};
  for (const auto& [open, close] : nests) {
    const std::string text = "let a = " + repeated(open, 10000) + "1" + repeated(close, 10000) + "\n";
    EXPECT_EQ(tyndall({"check", file("deep.tyn", text)}).status, 1) << open;
  }
  EXPECT_EQ(tyndall({"check", file("groups.tyn", repeated("group {", 10000) + repeated("}", 10000))}).status,
            1);
}

TEST_F(WrongInput, AFiveMegabyteLine) {
  // One that is wrong at its end: the line is not printed whole.
  const std::string line = "let a = 1" + repeated(" + 1", 1250000) + " + #!?\n";
  const Outcome outcome = tyndall({"check", file("long.tyn", line)});
  EXPECT_REFUSED(outcome, "long.tyn:1:");
  EXPECT_LT(outcome.err.size(), 20000u);
}

TEST_F(WrongInput, ALongLineThatIsRightIsRead) {
  const std::string line = small_scene() + "// " + repeated("x", 5000000) + "\n";
  EXPECT_EQ(tyndall({"check", file("long.tyn", line)}).status, 0);
}

TEST_F(WrongInput, RecursiveFunction) {
  EXPECT_REFUSED(tyndall({"check", file("a.tyn", "def f(x) = f(x - 1)\nlet a = f(3)\n" + small_scene())}),
                 "a.tyn:1:");
}

TEST_F(WrongInput, DivisionByZero) {
  const Outcome outcome = tyndall({"check", file("a.tyn", "let a = 1 / (2 - 2)\n" + small_scene())});
  EXPECT_REFUSED(outcome, "a.tyn:1:");
  EXPECT_NE(outcome.err.find("zero"), std::string::npos) << outcome.err;
}

TEST_F(WrongInput, UnwritableOutputIsToldBeforeRendering) {
  // So many samples that rendering first would run into the test's time limit.
  const std::string scene = file("a.tyn", small_scene());
  for (const std::string output : {"/proc/a.png", "/no/such/directory/a.png", "a.gif", "picture", "/tmp/"}) {
    const Outcome outcome = tyndall({"render", scene, "-o", output, "--samples", "100000000"});
    EXPECT_EQ(outcome.status, 1) << output;
    EXPECT_NE(outcome.err.find(output), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(
      tyndall({"render", scene, "-o", path("a.png"), "--stats", "/proc/a.json", "--samples", "100000000"})
          .status,
      1);
}

TEST_F(WrongInput, SeveralErrorsInOneRun) {
  const Outcome outcome = tyndall(
      {"check", file("a.tyn", small_scene() + "sphere { radios: 2 }\nlight points { position: 0 }\n")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("a.tyn:12:"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("a.tyn:13:"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("radius"), std::string::npos) << "the right spelling is suggested\n"
                                                           << outcome.err;
  EXPECT_NE(outcome.err.find("^"), std::string::npos);
}

TEST_F(WrongInput, ErrorsAsJson) {
  const std::string scene = file("a.tyn", small_scene() + "sphere { radios: 2 }\n");
  const auto result = nlohmann::json::parse(tyndall({"check", scene, "--json"}).out);
  const auto& diagnostic = result["scenes"][0]["diagnostics"][0];
  EXPECT_EQ(diagnostic["file"], scene);
  EXPECT_EQ(diagnostic["line"], 12);
  EXPECT_EQ(diagnostic["column"], 10);
  EXPECT_EQ(diagnostic["severity"], "error");
  EXPECT_FALSE(result["scenes"][0]["good"]);
  const auto rendered = nlohmann::json::parse(tyndall({"render", scene, "-o", path("a.png"), "--json"}).out);
  EXPECT_EQ(rendered["diagnostics"][0]["line"], 12);
  const auto unwritable =
      nlohmann::json::parse(tyndall({"render", scene, "-o", "/proc/a.png", "--json"}).out);
  EXPECT_EQ(unwritable["diagnostics"][0]["severity"], "error");
}

TEST_F(WrongInput, MisuseIsStatusTwo) {
  const std::string scene = file("a.tyn", small_scene());
  const std::vector<std::string> misuses[] = {
      {},
      {"rendre"},
      {"render"},
      {"render", scene},
      {"render", scene, "-o"},
      {"render", scene, "-o", path("a.png"), "--sampels", "3"},
      {"render", scene, "-o", path("a.png"), "--samples", "0"},
      {"render", scene, "-o", path("a.png"), "--samples", "many"},
      {"render", scene, "-o", path("a.png"), "--step", "-1"},
      {"render", scene, "-o", path("a.png"), "--step", "nan"},
      {"render", scene, "-o", path("a.png"), "--resolution", "640"},
      {"render", scene, "-o", path("a.png"), "--resolution", "0x5"},
      {"render", scene, "-o", path("a.png"), "--resolution", "99999999999x5"},
      {"render", scene, "-o", path("a.png"), "--crop", "3,3,3,9"},
      {"render", scene, "-o", path("a.png"), "--crop", "0,0,17,2"},
      {"render", scene, "-o", path("a.png"), "--sample-range", "4..2"},
      {"render", scene, "-o", path("a.png"), "--distance", "nearest"},
      {"render", scene, "-o", path("a.png"), "--transmittance", "guess"},
      {"render", scene, "-o", path("a.png"), "--method", "magic"},
      {"render", scene, "-o", path("a.png"), "--multiple-scattering", "some"},
      {"render", scene, "-o", path("a.png"), "--clamp", "0"},
      {"render", scene, "-o", path("a.png"), "--clamp", "1,2,3"},
      {"render", scene, "-o", path("a.png"), "--multiple-scattering", "approximate", "--transmittance",
       "ratio"},
      {"render", scene, "-o", path("a.png"), "--threads", "0"},
      {"render", scene, "-o", path("a.png"), "--seed", "-1"},
      {"render", scene, "-o", path("a.png"), "--set", "thickness"},
      {"render", scene, "--pixel", "3,3"},
      {"render", scene, "--pixel", "16,3", "--sample", "0"},
      {"render", scene, "more.tyn", "-o", path("a.png")},
      {"check"},
      {"inspect", scene, "--stage", "soup"},
      {"compare", scene},
      {"compare", "a.exr", "b.exr", "--metric", "taste"},
  };
  for (const auto& arguments : misuses) {
    const Outcome outcome = tyndall(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    EXPECT_EQ(outcome.status, 2) << line << "\n" << outcome.err;
    EXPECT_NE(outcome.err, "") << line;
    EXPECT_EQ(outcome.out, "") << line;
  }
}

TEST_F(WrongInput, LightSamplesThatAMethodCannotTakeAreWarnedOf) {
  const std::vector<std::string> render = {
      "render",  file("a.tyn", small_scene()), "-o", path("a.png"), "--light-samples", "4", "--bounces", "32",
      "--method"};
  const auto error_of = [&](const std::string& method) {
    std::vector<std::string> arguments = render;
    arguments.push_back(method);
    const Outcome outcome = tyndall(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(error_of("tracking").find("warning: light_samples 4 has no effect"), std::string::npos);
  EXPECT_EQ(error_of("decoupled").find("warning"), std::string::npos);
}

TEST_F(WrongInput, BoundsTooGreatToTrackAreWarnedOf) {
  const std::string scene = file("a.tyn", R"(
render { resolution: (4, 4)  samples: 1 }
camera perspective { from: (0, 0.2, 4)  to: (0, 0, 0)  fov: 40deg }
volume { in: sphere { radius: 1 }  medium: { density = 0.001 / max(1e-12, abs(p.z))  albedo = 0.9 } }
light point { position: (0, 2, 0)  power: 100 }
)");
  const std::string warning = "warning: the proven bounds of a density were too great";
  EXPECT_NE(tyndall({"render", scene, "-o", path("a.png"), "--method", "tracking"}).err.find(warning),
            std::string::npos);
  EXPECT_EQ(tyndall({"render", scene, "-o", path("a.png")}).err.find(warning), std::string::npos);
}

TEST_F(WrongInput, AnOverrideOfNothingIsAnError) {
  const std::string scene = file("a.tyn", small_scene());
  EXPECT_REFUSED(tyndall({"check", scene, "--set", "thicknes=3"}), "thickness");
  EXPECT_REFUSED(tyndall({"check", scene, "--set", "thickness=3 +"}), "error");
}

TEST_F(WrongInput, AFullStandardOutputIsAnError) {
  // The shell's redirection, to a device that takes nothing.
  const Outcome outcome =
      run("/bin/sh", {"-c", std::string("'") + TYNDALL_PROGRAM + "' inspect '" +
                                file("a.tyn", small_scene()) + "' --stage tokens >/dev/full"});
  EXPECT_REFUSED(outcome, "standard output");
}

}  // namespace UNNAMED
}  // namespace tyndall::test
