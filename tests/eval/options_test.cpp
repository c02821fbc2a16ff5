// Options of built-ins: given by their names, over the whole table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "eval/names.h"
#include "run.h"

namespace tyndall::eval {
namespace {

// A call with the required arguments of the row's example, open for one more.
std::string open_call(const vm::Builtin& row) {
  const std::string call(row.example);
  const std::size_t option = call.rfind(": ");
  return call.substr(0, option == std::string::npos ? call.size() - 1 : call.rfind(", ", option));
}

TEST(Options, HaveNamesInEveryBuiltIn) {
  int options = 0;
  for (const vm::Builtin& row : vm::builtins()) {
    for (const vm::BuiltinParameter& option : row.parameters) {
      // Those of grids and images read files: tests/import, tests/language.
      if (!option.named || row.name == "grid" || row.name == "image") continue;
      if (option.name == "points" || option.name == "values")
        continue;  // given together: Lists, tests/language
      ++options;
      const bool word = option.default_value == "linear";
      const std::string value = word ? "linear" : "2";
      SceneText named(fmt::format("let result = {}, {}: {})", open_call(row), option.name, value));
      named.scene();
      EXPECT_EQ(named.diagnostics.error_count(), 0) << named.all_messages();
      SceneText positional(fmt::format("let result = {}, {})", open_call(row), value));
      positional.scene();
      EXPECT_EQ(positional.diagnostics.error_count(), 1) << positional.all_messages();
      EXPECT_EQ(positional.first_error_text(), value);
      if (word) continue;  // `keys` takes any number of places, and says what one is
      EXPECT_NE(positional.first_error().find(fmt::format("{}: 2)", option.name)), std::string::npos)
          << positional.all_messages();
    }
  }
  EXPECT_GE(options, 15);
}

// What is required is never an option, and no built-in has a place after an option.
TEST(Options, StandLast) {
  for (const vm::Builtin& row : vm::builtins())
    for (std::size_t i = 1; i < row.parameters.size(); ++i)
      EXPECT_GE(row.parameters[i].named, row.parameters[i - 1].named) << row.name;
}

TEST(Options, TheTimeIsToldWhereItIsMeant) {
  SceneText octaves("let result = fbm((1, 2, 3), 6)");
  octaves.scene();
  EXPECT_NE(octaves.first_error().find("write fbm(p, octaves: 6) or fbm(p, seed: 6) or fbm(p, time: 6)"),
            std::string::npos)
      << octaves.all_messages();
  SceneText time("let result = fbm((1, 2, 3), time)");
  time.scene();
  EXPECT_NE(time.first_error().find("write fbm(p, time: time)"), std::string::npos) << time.all_messages();
  EXPECT_EQ(time.first_error().find("octaves"), std::string::npos) << time.all_messages();
}

// Sines of what is computed are in radians; a number as it is written has no unit.
TEST(Sines, TakeComputedNumbers) {
  for (const char* name : {"sin", "cos", "tan"})
    for (const char* good : {"2 * pi * 0.25", "x", "30deg", "-x", "x / 2", "0.5rad", "2 * 0.5"}) {
      SceneText run(fmt::format("let x = 0.5 let result = {}({})", name, good));
      run.scene();
      EXPECT_EQ(run.diagnostics.error_count(), 0) << run.all_messages();
    }
}

}  // namespace
}  // namespace tyndall::eval
