// The manual: its tables are those of the code, and its examples are good scenes.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>
#include <set>
#include <sstream>

#include "docs/generated.h"
#include "resolve/limits.h"
#include "resolve/resolve.h"
#include "resolve/statements/statements.h"
#include "syntax/parser.h"
#include "tools/reference.h"

namespace tyndall::docs {
namespace UNNAMED {

namespace fs = std::filesystem;
const fs::path manual = root / "docs/language.md";

// `|` ends a cell of a table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string in_code(std::string_view text) { return fmt::format("`{}`", cell(text)); }

std::string statements() {
  std::string text;
  for (const tools::ReferenceStatement& statement : tools::reference_statements()) {
    text += fmt::format("\n### {}\n\n", statement.name);
    if (!statement.documentation.empty()) text += fmt::format("{}\n\n", statement.documentation);
    text += "| parameter | is | default |\n| --- | --- | --- |\n";
    for (const tools::ReferenceParameter& p : statement.parameters) {
      const std::string standard = p.required           ? "required"
                                   : p.one_of_several   ? "exactly one of these"
                                   : p.standard.empty() ? ""
                                                        : in_code(p.standard);
      text += fmt::format("| {} | {} | {} |\n", in_code(p.name), cell(p.documentation), standard);
    }
  }
  return text;
}

std::string builtins() {
  std::string text = "\n| function | gives | |\n| --- | --- | --- |\n";
  for (const tools::ReferenceFunction& f : tools::reference_functions()) {
    std::string picture = tools::picture_of(f);
    if (!picture.empty()) picture = fmt::format(" ![{}]({})", f.name, picture.substr(5));  // from docs/
    text += fmt::format("| {} | {} | {} E.g. {}{} |\n", in_code(f.call), cell(f.result),
                        cell(f.documentation), in_code(f.example), picture);
  }
  return text + "\n";
}

std::string outputs(const std::vector<tools::ReferenceOutput>& list) {
  std::string text = "\n| output | is | default |\n| --- | --- | --- |\n";
  for (const tools::ReferenceOutput& output : list)
    text += fmt::format("| {} | {} | {} |\n", in_code(output.name), cell(output.documentation),
                        cell(output.standard));
  return text + "\n";
}

std::string limits() {
  std::string text = "\n| limit | is | of |\n| --- | --- | --- |\n";
  for (const resolve::Limit& limit : resolve::limits())
    text += fmt::format("| {} | {} | {} |\n", limit.name, limit.value, cell(limit.what));
  return text + "\n";
}

TEST(Manual, TablesAreCurrent) {
  expect_part(manual, "limits", limits());
  expect_part(manual, "statements", statements() + "\n");
  expect_part(manual, "builtins", builtins());
  expect_part(manual, "media", outputs(tools::reference_medium_outputs()));
  expect_part(manual, "materials", outputs(tools::reference_material_outputs()));
}

TEST(Manual, FunctionsThatArePicturesHaveOne) {
  std::set<fs::path> named, made;
  for (const tools::ReferenceFunction& f : tools::reference_functions())
    if (const std::string picture = tools::picture_of(f); !picture.empty()) named.insert(root / picture);
  for (const auto& entry : fs::directory_iterator(root / "docs/images/built-ins")) made.insert(entry.path());
  EXPECT_EQ(named, made) << "scripts/pictures makes them";
}

TEST(Manual, TheCheatSheetIsCurrent) { expect_file(root / "docs/cheat-sheet.md", tools::cheat_sheet()); }

TEST(Manual, EveryStatementHasATable) {
  std::set<std::string> keywords;
  for (const tools::ReferenceStatement& statement : tools::reference_statements())
    keywords.insert(statement.name.substr(0, statement.name.find(" \"")));
  syntax::Symbols symbols;
  const resolve::Statements table(resolve::all_statements(), symbols);
  for (const resolve::Statement& row : table.rows())
    if (row.run != nullptr) {
      EXPECT_TRUE(keywords.contains(std::string(row.name))) << row.name;
    }
}

// The message that the tutorial shows is what is said of its first scene with that mistake.
TEST(Manual, ShowsARealMessage) {
  const std::string text = read_file(manual);
  const std::size_t begin = text.find("```tyn\n") + 7;
  std::string scene = text.substr(begin, text.find("```", begin) - begin);
  const std::size_t unit = scene.find("40deg") + 2;
  ASSERT_LT(unit, scene.size());
  scene.erase(unit, 3);
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add("ball.tyn", scene);
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  resolve::resolve(tree, sources, symbols, {}, diagnostics);
  ASSERT_EQ(diagnostics.error_count(), 1);
  EXPECT_NE(text.find(render_text(diagnostics, sources, false)), std::string::npos)
      << render_text(diagnostics, sources, false);
}

// Examples: "tyn" blocks are whole scenes, "tyn part" blocks stand in one.
TEST(Manual, ExamplesAreGood) {
  std::istringstream lines(read_file(manual));
  std::string line, language, text;
  std::size_t examples = 0;
  bool inside = false;
  while (std::getline(lines, line)) {
    if (!line.starts_with("```")) {
      if (inside) text += line + "\n";
      continue;
    }
    inside = !inside;
    if (inside) {
      language = line.substr(3);
      text.clear();
      continue;
    }
    if (!language.starts_with("tyn")) continue;
    if (language == "tyn part")
      text += "\ncamera perspective { from: (0, 0, 5)  to: (0, 0, 0) }\nlight environment { radiance: 1 }\n";
    Sources sources;
    Diagnostics diagnostics;
    syntax::Symbols symbols;
    const SourceId source = sources.add((root / "scenes/example.tyn").string(), text);
    const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
    const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
    resolve::resolve(tree, sources, symbols, {}, diagnostics);
    EXPECT_EQ(diagnostics.error_count(), 0) << render_text(diagnostics, sources, false) << text;
    if (language == "tyn") {
      EXPECT_TRUE(diagnostics.all().empty()) << render_text(diagnostics, sources, false);
    }
    ++examples;
  }
  EXPECT_GE(examples, 7u);
}

}  // namespace UNNAMED
}  // namespace tyndall::docs
