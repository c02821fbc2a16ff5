// Memory that runs out is told with the place, or with the work that wanted it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"

namespace tyndall::test {
namespace UNNAMED {

using Memory = CliTest;

// Runs the program in so much address space.
Outcome tyndall_within(int megabytes, const std::string& arguments) {
  return run("/bin/sh",
             {"-c", fmt::format("ulimit -v {}; exec '{}' {}", megabytes * 1024, TYNDALL_PROGRAM, arguments)});
}

#if defined(__SANITIZE_ADDRESS__)
constexpr bool reserves_all_addresses = true;
#else
constexpr bool reserves_all_addresses = false;
#endif

TEST_F(Memory, ThatRunsOutIsToldAtTheStatement) {
  if (reserves_all_addresses) GTEST_SKIP() << "the sanitizer's own memory is beyond any limit";
  const std::string scene =
      file("a.tyn", small_scene() + "\n  for i in 0..<10000000 { sphere { radius: 1 } }\n");
  const Outcome outcome = tyndall_within(300, "check " + scene);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find(":27: error: there is not enough memory for what this makes"), std::string::npos)
      << outcome.err;
}

TEST_F(Memory, ThatRunsOutIsToldWithTheWork) {
  if (reserves_all_addresses) GTEST_SKIP() << "the sanitizer's own memory is beyond any limit";
  const Outcome outcome =
      tyndall_within(400, fmt::format("render {} -o {} --resolution 16384x16384 --samples 1 --threads 1",
                                      file("a.tyn", small_scene()), path("a.png")));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("error: there is not enough memory to render the picture"), std::string::npos)
      << outcome.err;
}

// What can be no scene is told before memory is taken in proportion to it.
TEST_F(Memory, IsNotTakenForMillionsOfBrackets) {
  if (reserves_all_addresses) GTEST_SKIP() << "the sanitizer's own memory is beyond any limit";
  const std::string scene = file("a.tyn", "let a = " + std::string(50'000'000, '('));
  const Outcome outcome = tyndall_within(600, "check " + scene);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("a.tyn:1:265: error: nested too deeply"), std::string::npos)
      << outcome.err.substr(0, 1000);
}

// Words, marks, comments and strings are counted as they are read; where there are too many, or errors
// without end, nothing is made of them.
TEST_F(Memory, IsNotTakenForMillionsOfWords) {
  if (reserves_all_addresses) GTEST_SKIP() << "the sanitizer's own memory is beyond any limit";
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"@", "1:1: error: '@' means nothing here"},
      {"<", "1:1: error: '<<' means nothing here"},
      {"< ", "more than 12000000 words, marks and comments"},
      {"0..", "more than 12000000 words, marks and comments"},
      {"\"", "1:1: error: a string has one quote on each side"},
      {"\"\" ", "more than 1000000 strings"},
      {"/**/", "more than 12000000 words, marks and comments"},
  };
  for (const auto& [word, message] : cases) {
    std::string text;
    while (text.size() < 50'000'000) text += word;
    const Outcome outcome = tyndall_within(700, "check " + file("a.tyn", text));
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find(message), std::string::npos) << word << outcome.err.substr(0, 1000);
  }
}

// What writes pictures is small; what reads all kinds of them is not, and stays away.
TEST_F(Memory, ASmallPictureTakesLittle) {
  if (reserves_all_addresses) GTEST_SKIP() << "the sanitizer's own memory is beyond any limit";
  const std::string scene = file("scene.tyn", small_scene());
  for (const char* name : {"out.exr", "out.png"}) {
    const Outcome outcome = tyndall({"render", scene, "-o", path(name), "--resolution", "64x64", "--samples",
                                     "1", "--stats", path("stats.json"), "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto statistics = nlohmann::json::parse(read_file(path("stats.json")));
    EXPECT_LT(statistics["peak_memory_bytes"], 60e6) << name;
    EXPECT_GT(statistics["peak_memory_bytes"], 5e6) << name;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
