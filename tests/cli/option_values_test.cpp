// Values of options, over what the help lists: none may be empty, names that are near one get a suggestion,
// and what contradicts another option is told.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "cli/run_program.h"
#include "tools/commands.h"

namespace tyndall::test {
namespace UNNAMED {

using OptionValues = CliTest;

// The options of a command that take a value, as its help lists them.
std::set<std::string> options_with_values(const std::string& command) {
  const std::string help = tyndall({command, "--help"}).out;
  const std::regex listed(R"(\n  (?:-\w,)?(--[a-z-]+) [^ \n])");
  std::set<std::string> names;
  for (std::sregex_iterator match(help.begin(), help.end(), listed), end; match != end; ++match)
    names.insert((*match)[1]);
  return names;
}

TEST_F(OptionValues, AreNeverEmpty) {
  const std::string scene = file("a.tyn", small_scene());
  std::size_t count = 0;
  for (const tools::Command* row : tools::commands) {
    const std::string command(row->name);
    for (const std::string& option : options_with_values(command)) {
      for (const auto& written : {std::vector{option, std::string()}, std::vector{option + "="}}) {
        std::vector<std::string> arguments{command, scene};
        arguments.insert(arguments.end(), written.begin(), written.end());
        const Outcome outcome = tyndall(arguments);
        EXPECT_EQ(outcome.status, 2) << command << " " << option << "\n" << outcome.err;
        EXPECT_NE(outcome.err.find(option), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("wants "), std::string::npos) << outcome.err;
      }
      const Outcome missing = tyndall({command, scene, option});
      EXPECT_EQ(missing.status, 2) << missing.err;
      EXPECT_NE(missing.err.find(option + " wants a value"), std::string::npos) << missing.err;
      ++count;
    }
  }
  EXPECT_GE(count, 25u);
  EXPECT_EQ(tyndall({"render", "", "-o", path("a.png")}).status, 2);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(OptionValues, NamesThatAreNearOneAreTold) {
  const std::string scene = file("a.tyn", small_scene());
  struct Row {
    std::string command, option, given, meant;
  };
  const Row rows[] = {
      {"render", "--method", "decoupeld", "decoupled"},
      {"render", "--distance", "equiangluar", "equiangular"},
      {"render", "--transmittance", "jacknife", "jackknife"},
      {"render", "--emission", "sampeld", "sampled"},
      {"render", "--multiple-scattering", "aproximate", "approximate"},
      {"render", "--aov", "depht", "depth"},
      {"render", "--aov", "normal,albdo", "albedo"},
      {"inspect", "--stage", "tokns", "tokens"},
  };
  for (const Row& row : rows) {
    const Outcome outcome = tyndall({row.command, scene, row.option, row.given});
    EXPECT_EQ(outcome.status, 2) << row.given;
    EXPECT_NE(outcome.err.find("error: " + row.option + ": wants one of "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("did you mean '" + row.meant + "'?"), std::string::npos) << outcome.err;
  }
}

TEST_F(OptionValues, AShortOptionTakesItsValueWithoutASign) {
  const Outcome outcome = tyndall({"render", file("a.tyn", small_scene()), "-o=" + path("a.png")});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("-o " + path("a.png")), std::string::npos) << outcome.err;
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(OptionValues, AFolderToIncludeFromIsThere) {
  const std::string scene = file("a.tyn", small_scene());
  const Outcome outcome = tyndall({"check", scene, "--include", path("nodir")});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("--include: wants a directory that is there, not"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(tyndall({"check", scene, "--include", path("")}).status, 0);
}

TEST_F(OptionValues, APixelLiesInTheCrop) {
  const std::string scene = file("a.tyn", small_scene());
  const auto replay = [&](const std::string& pixel) {
    return tyndall({"render", scene, "--crop", "2,2,6,6", "--pixel", pixel, "--sample", "0"});
  };
  EXPECT_EQ(replay("2,5").status, 0);
  for (const std::string pixel : {"1,3", "6,3", "3,1", "3,6"}) {
    const Outcome outcome = replay(pixel);
    EXPECT_EQ(outcome.status, 2) << pixel;
    EXPECT_NE(outcome.err.find("--pixel " + pixel + " is outside --crop 2,2,6,6"), std::string::npos)
        << outcome.err;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
