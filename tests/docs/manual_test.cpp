// The manual: its tables are those of the code, and its examples are good scenes.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>
#include <set>
#include <sstream>

#include "docs/generated.h"
#include "eval/names.h"
#include "resolve/limits.h"
#include "resolve/parameters.h"
#include "resolve/resolve.h"
#include "resolve/statements.h"
#include "shader/material_outputs.h"
#include "syntax/parser.h"

namespace tyndall::docs {
namespace {

const std::filesystem::path manual = root / "docs/language.md";

// `|` ends a cell of a table.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string in_code(std::string_view text) { return fmt::format("`{}`", cell(text)); }

// A default as it would be written; empty where there is none to write.
std::string shown(double value) { return fmt::format("{}", value); }
std::string shown(int value) { return fmt::format("{}", value); }
std::string shown(std::uint64_t value) { return fmt::format("{}", value); }
std::string shown(bool value) { return value ? "true" : "false"; }
std::string shown(const scene::Step& value) { return scene::describe(value); }
std::string shown(const scene::MultipleScattering& value) { return scene::describe(value); }
std::string shown(Angle value) { return fmt::format("{:.4g}deg", value.radians * 180 / 3.14159265358979); }
std::string shown(const Vec3d& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }
std::string shown(const Pair<int>& p) { return fmt::format("({}, {})", p.x, p.y); }
template <class T>
std::string shown(const T&) {
  return {};
}

template <class T>
void add_rows(std::string& out) {
  T::fields([&](auto member, const FieldInfo& info) {
    const T given{};
    const std::string value = shown(given.*member);
    const std::string standard = info.presence == required ? "required"
                                 : !info.one_of.empty()    ? "exactly one of these"
                                 : value.empty()           ? ""
                                                           : in_code(value);
    out += fmt::format("| {} | {} | {} |\n", in_code(info.name), cell(info.documentation), standard);
  });
}

// The parameters of a shape as a scene gives them.
template <class T>
struct AsWritten {
  using Type = T;
};
template <>
struct AsWritten<scene::Mesh> {
  using Type = resolve::MeshParameters;
};

template <>
struct AsWritten<scene::Curves> {
  using Type = resolve::CurvesParameters;
};

class Tables {
 public:
  template <class T, class... Others>
  void add() {
    text += fmt::format("\n### {}\n\n| parameter | is | default |\n| --- | --- | --- |\n", T::keyword);
    keywords.emplace(T::keyword);
    if constexpr (std::is_same_v<T, optics::MeshLight>) add_rows<resolve::MeshLightParameters>(text);
    add_rows<T>(text);
    (add_rows<Others>(text), ...);
  }
  template <class... Ts, class... Others>
  void add_each(const std::variant<Ts...>*, const std::tuple<Others...>*) {
    (add<typename AsWritten<Ts>::Type, Others...>(), ...);
  }

  std::string text;
  std::set<std::string> keywords;
};

Tables statements() {
  using namespace resolve;
  Tables t;
  t.add<RenderParameters>();
  t.add<AnimationParameters>();
  t.add_each(static_cast<const scene::Camera*>(nullptr), static_cast<const std::tuple<Placement>*>(nullptr));
  t.add_each(static_cast<const optics::Light*>(nullptr), static_cast<const std::tuple<Placement>*>(nullptr));
  t.add_each(static_cast<const scene::Shape*>(nullptr),
             static_cast<const std::tuple<ShapePlacement>*>(nullptr));
  t.add<VolumeParameters>();
  t.add<GroupParameters>();
  t.add<PlaceParameters>();
  return t;
}

std::string builtins() {
  std::string text = "\n| function | gives | |\n| --- | --- | --- |\n";
  for (const auto rows : {vm::builtins(), eval::phase_builtins()})
    for (const vm::Builtin& row : rows) {
      std::string call(row.name);
      const char* before = "(";
      for (const vm::BuiltinParameter& parameter : row.parameters) {
        call += before + std::string(parameter.name);
        const bool optional = !parameter.default_value.empty();
        if (parameter.named)
          call += fmt::format(": {}", optional ? parameter.default_value : "…");
        else if (optional)
          call += fmt::format(" = {}", parameter.default_value);
        before = ", ";
      }
      call += row.parameters.empty() ? "()" : ")";
      text += fmt::format("| {} | {} | {} E.g. {} |\n", in_code(call), cell(row.result),
                          cell(row.documentation), in_code(row.example));
    }
  return text + "\n";
}

std::string materials() {
  std::string text = "\n| output | is | default |\n| --- | --- | --- |\n";
  for (const shader::OutputRule& rule : shader::material_outputs())
    text += fmt::format("| {} | {}{} | {} |\n", in_code(rule.name), cell(rule.documentation),
                        rule.range == "a direction" ? "" : fmt::format(", {}", cell(rule.range)),
                        cell(rule.standard));
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
  const Tables tables = statements();
  expect_part(manual, "statements", tables.text + "\n");
  expect_part(manual, "builtins", builtins());
  expect_part(manual, "materials", materials());
}

TEST(Manual, EveryStatementHasATable) {
  const Tables tables = statements();
  syntax::Symbols symbols;
  const resolve::Statements table(symbols);
  for (const resolve::Statement& row : table.rows())
    if (row.run != nullptr) {
      EXPECT_TRUE(tables.keywords.contains(std::string(row.name))) << row.name;
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

}  // namespace
}  // namespace tyndall::docs
