// `help`: every word of the language is known to it.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/run_program.h"
#include "syntax/token.h"
#include "tools/reference.h"

namespace tyndall::test {
namespace UNNAMED {

using Help = CliTest;

TEST_F(Help, SaysWhatAFunctionIs) {
  const Outcome outcome = tyndall({"help", "smoothstep"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("smoothstep(")) << outcome.out;
  EXPECT_NE(outcome.out.find("For example: smoothstep("), std::string::npos) << outcome.out;
}

TEST_F(Help, SaysWhatStatementsAndTheirParametersAre) {
  const Outcome of_words = tyndall({"help", "light", "sphere"});
  EXPECT_TRUE(of_words.out.starts_with("light sphere { … }\n")) << of_words.out;
  EXPECT_EQ(of_words.out.find("material"), std::string::npos) << of_words.out;
  const Outcome of_kind = tyndall({"help", "sphere"});  // the shape and the light
  EXPECT_TRUE(of_kind.out.starts_with("light sphere { … }\n")) << of_kind.out;
  EXPECT_NE(of_kind.out.find("\nsphere { … }\n"), std::string::npos) << of_kind.out;
  EXPECT_NE(tyndall({"help", "fov"}).out.find("  camera perspective: "), std::string::npos);
  EXPECT_NE(tyndall({"help", "albedo"}).out.find("an output of a medium"), std::string::npos);
}

TEST_F(Help, GuessesWhatIsMisspelt) {
  const Outcome outcome = tyndall({"help", "smothstep"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("did you mean 'smoothstep'?"), std::string::npos) << outcome.err;
}

TEST_F(Help, WithoutAWordIsTheCheatSheet) { EXPECT_EQ(tyndall({"help"}).out, tools::cheat_sheet()); }

TEST_F(Help, KnowsEveryWord) {
  for (const tools::ReferenceFunction& function : tools::reference_functions()) {
    EXPECT_FALSE(function.documentation.empty()) << function.name;
    EXPECT_FALSE(function.example.empty()) << function.name;
  }
  for (const tools::ReferenceStatement& statement : tools::reference_statements())
    for (const tools::ReferenceParameter& parameter : statement.parameters)
      EXPECT_FALSE(parameter.documentation.empty()) << statement.name << ": " << parameter.name;
  for (int kind = static_cast<int>(syntax::TokenKind::kw_let);
       kind <= static_cast<int>(syntax::TokenKind::kw_false); ++kind) {
    const std::string_view word = syntax::spelling(static_cast<syntax::TokenKind>(kind));
    const auto words = tools::reference_words();
    EXPECT_TRUE(std::any_of(words.begin(), words.end(), [&](const auto& row) { return row.word == word; }))
        << word;
  }
  for (const auto* outputs : {&tools::reference_medium_outputs(), &tools::reference_material_outputs()})
    for (const tools::ReferenceOutput& output : *outputs)
      EXPECT_FALSE(output.documentation.empty()) << output.name;
}

}  // namespace UNNAMED
}  // namespace tyndall::test
