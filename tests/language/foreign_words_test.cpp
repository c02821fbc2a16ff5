// Words of other programs, over the whole tables: each is told once, with what to write for it here.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases.h"
#include "resolve/statements/statements.h"
#include "syntax/foreign_words.h"

namespace tyndall {
namespace UNNAMED {

using syntax::ForeignUse;
using syntax::ForeignWord;

std::vector<Diagnostic> errors_of(const std::string& text) {
  Case c;
  run_text("scene.tyn", "camera perspective { from: (0, 0, 9)  to: (0, 0, 0) }\n" + text, c);
  return c.diagnostics.all();
}

// Exactly one error, with this help.
void expect_help(const std::string& text, std::string_view help) {
  const std::vector<Diagnostic> errors = errors_of(text);
  ASSERT_EQ(errors.size(), 1u) << text;
  EXPECT_EQ(errors[0].help, help) << text;
}

TEST(ForeignWords, StatementsWithAndWithoutBraces) {
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::statement)) {
    expect_help(fmt::format("{} {{ }}", row.word), row.help);
    expect_help(fmt::format("{} {{ a <1, 2> b }}", row.word), row.help);
    expect_help(fmt::format("{} 3 < x {{ sphere {{ }} }}\nlet _a = 1", row.word), row.help);
    expect_help(fmt::format("{} \"a b\"\nlet _a = 1", row.word), row.help);
    expect_help(fmt::format("{}(1) {{ sphere {{ }} }}\nlet _a = 1", row.word), row.help);
  }
}

TEST(ForeignWords, ValuesCalledAndNamed) {
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::value)) {
    expect_help(fmt::format("let _a = {}(1, 2)", row.word), row.help);
    expect_help(fmt::format("medium _m() {{ density = {}  albedo = 1 }}", row.word), row.help);
  }
}

TEST(ForeignWords, KindsOfLightsAndCameras) {
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::light))
    expect_help(fmt::format("light {} {{ color: 1 }}", row.word), row.help);
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::camera)) {
    Case c;
    run_text("scene.tyn", fmt::format("camera {} {{ }}", row.word), c);
    ASSERT_GE(c.diagnostics.all().size(), 1u) << row.word;
    EXPECT_EQ(c.diagnostics.all()[0].help, row.help);
  }
}

// A thing for each row: the first in the table that has the parameter which the help names.
TEST(ForeignWords, Parameters) {
  syntax::Symbols symbols;
  const resolve::Statements statements(resolve::all_statements(), symbols);
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::parameter)) {
    bool told = false;
    for (const resolve::Statement& statement : statements.rows()) {
      if (!statement.list_names) continue;
      std::vector<std::string_view> known;
      statement.list_names(known);
      const bool has_it = std::find(known.begin(), known.end(), row.word) != known.end();
      if (has_it || syntax::find_foreign_parameter(row.word, known) != &row) continue;
      Case c;  // a scene of this thing alone, which may be its camera
      run_text("scene.tyn", fmt::format("{} {{ {}: 1 }}", statement.name, row.word), c);
      for (const Diagnostic& d : c.diagnostics.all()) told |= d.help == row.help;
    }
    EXPECT_TRUE(told) << row.word << ": nothing has a use for: " << row.help;
  }
}

TEST(ForeignWords, Outputs) {
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::output))
    expect_help(fmt::format("medium _m() {{ {} = 1  albedo = 1 }}", row.word), row.help);
}

TEST(ForeignWords, UnitsJoinedAndParted) {
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::unit)) {
    expect_help(fmt::format("let _a = 3{}", row.word), row.help);
    if (row.word != "in") {  // reserved
      expect_help(fmt::format("let _a = 3 {}", row.word), row.help);
    }
  }
}

TEST(ForeignWords, BetweenValues) {
  for (const ForeignWord& row : syntax::foreign_words(ForeignUse::between))
    for (const char* right : {"4", "#fff", "pi"})
      expect_help(fmt::format("let _a = 3 {} {}", row.word, right), row.help);
}

// No word of the language itself is in the tables for the same use.
TEST(ForeignWords, AreForeign) {
  syntax::Symbols symbols;
  const resolve::Statements statements(resolve::all_statements(), symbols);
  for (const resolve::Statement& row : statements.rows())
    EXPECT_EQ(syntax::help_for_foreign_word(ForeignUse::statement, row.name.substr(0, row.name.find(' '))),
              "")
        << row.name;
  const eval::Names names(symbols);
  for (const auto& builtin : names.builtins)
    EXPECT_EQ(syntax::help_for_foreign_word(ForeignUse::value, builtin->row->name), "") << builtin->row->name;
}

}  // namespace
}  // namespace tyndall
