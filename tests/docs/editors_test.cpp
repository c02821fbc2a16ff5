// The editor files are current, and the TextMate grammar sees in a scene what the lexer does.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "docs/generated.h"
#include "docs/words.h"
#include "syntax/parser.h"

namespace tyndall::docs {
namespace UNNAMED {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
const fs::path editors = root / "grammar/editors";

Json rule(const std::string& scope, const std::string& match) { return {{"name", scope}, {"match", match}}; }
std::string any_of(const std::set<std::string>& words) { return "\\b(?:" + joined(words, "|") + ")\\b"; }

Json textmate() {
  const Words words;
  const Json block_comment{{"name", "comment.block.tyndall"},
                           {"begin", "/\\*"},
                           {"end", "\\*/"},
                           {"patterns", Json::array({{{"include", "#block_comment"}}})}};
  const Json string{
      {"name", "string.quoted.double.tyndall"},
      {"begin", "\""},
      {"end", "\""},
      {"patterns",
       Json::array({rule("constant.character.escape.tyndall", "\\\\(?:[nt\"\\\\{}]|u\\{[0-9a-fA-F]{1,6}\\})"),
                    {{"name", "meta.interpolation.tyndall"},
                     {"begin", "\\{"},
                     {"end", "\\}"},
                     {"patterns", Json::array({{{"include", "#words"}}})}}})}};
  const Json plain = Json::array({
      {{"include", "#block_comment"}},
      rule("comment.line.double-slash.tyndall", "//.*"),
      {{"include", "#string"}},
      rule("constant.other.color.tyndall", "#(?:[0-9a-fA-F]{6}|[0-9a-fA-F]{3})\\b"),
      rule("constant.numeric.tyndall",
           "(?:\\b[0-9]+(?:\\.[0-9]+)?|\\.[0-9]+)(?:[eE][-+]?[0-9]+)?(?:deg|rad|mm|cm|km|ms|m|s|K|%)?"
           "(?![A-Za-z0-9_])"),
      rule("variable.parameter.tyndall", "\\b[A-Za-z_][A-Za-z0-9_]*(?=\\s*:)"),
      rule("constant.language.tyndall", any_of(words.constants)),
      rule("keyword.operator.word.tyndall", any_of(words.operators)),
      rule("storage.type.tyndall", any_of(words.definitions)),
      rule("keyword.control.tyndall", any_of(words.control)),
      rule("support.function.tyndall", any_of(words.builtins) + "(?=\\s*\\()"),
      rule("entity.name.function.tyndall", "\\b[A-Za-z_][A-Za-z0-9_]*(?=\\s*\\()"),
      rule("support.type.tyndall", any_of(words.statements) + "(?=\\s*(?:[A-Za-z_\"{]))"),
      rule("support.type.kind.tyndall", any_of(words.kinds) + "(?=\\s*\\{)"),
      rule("variable.language.tyndall", any_of(words.inputs)),
      rule("variable.other.tyndall", "\\b[A-Za-z_][A-Za-z0-9_]*"),
      rule("keyword.operator.tyndall", "\\.\\.<?|[<>=!]=|[-+*/^<>=]"),
  });
  return {{"$schema", "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json"},
          {"name", "Tyndall"},
          {"scopeName", "source.tyndall"},
          {"fileTypes", Json::array({"tyn"})},
          {"patterns", Json::array({{{"include", "#words"}}})},
          {"repository",
           {{"words", {{"patterns", plain}}}, {"string", string}, {"block_comment", block_comment}}}};
}

TEST(Editors, TextMateGrammarIsCurrent) {
  expect_file(editors / "vscode/syntaxes/tyndall.tmLanguage.json", textmate().dump(2) + "\n");
}

TEST(Editors, VimWordsAreCurrent) {
  const Words words;
  std::string text;
  const auto keywords = [&](const std::string& group, const std::set<std::string>& list) {
    text += "syntax keyword " + group + " " + joined(list, " ") + "\n";
  };
  keywords("tyndallConstant", words.constants);
  keywords("tyndallOperator", words.operators);
  keywords("tyndallDefinition", words.definitions);
  keywords("tyndallControl", words.control);
  keywords("tyndallInput", words.inputs);
  keywords("tyndallStatement", words.statements);
  text += "syntax match tyndallBuiltin /\\v<(" + joined(words.builtins, "|") + ")>\\ze\\s*\\(/\n";
  expect_part(editors / "vim/syntax/tyndall.vim", "words", text);
}

TEST(Editors, ExtensionNamesFilesThatExist) {
  const Json package = Json::parse(read_file(editors / "vscode/package.json"));
  const Json& contributes = package.at("contributes");
  const fs::path folder = editors / "vscode";
  EXPECT_TRUE(fs::exists(folder / contributes.at("grammars")[0].at("path").get<std::string>()));
  const std::string configuration = contributes.at("languages")[0].at("configuration");
  EXPECT_EQ(Json::parse(read_file(folder / configuration)).at("comments").at("lineComment"), "//");
}

// A matcher of TextMate grammars, as far as ours goes: the scope of every byte.
class Scopes {
 public:
  explicit Scopes(const Json& grammar) : grammar_(grammar) {}

  std::vector<std::string> of(const std::string& text) {
    std::vector<std::string> scopes(text.size());
    std::vector<const Json*> open;  // rules with an end
    for (std::size_t at = 0; at < text.size();) {
      std::smatch found;
      if (!open.empty() && match(text, at, (*open.back())["end"], found)) {
        fill(scopes, at, found, (*open.back())["name"]);
        open.pop_back();
      } else if (const Json* matched = first(open.empty() ? grammar_["patterns"] : (*open.back())["patterns"],
                                             text, at, found)) {
        fill(scopes, at, found, (*matched)["name"]);
        if (matched->contains("begin")) open.push_back(matched);
      } else {
        if (!open.empty()) scopes[at] = (*open.back())["name"];
        ++at;
        continue;
      }
      at += static_cast<std::size_t>(std::max<std::ptrdiff_t>(found.length(), 1));
    }
    return scopes;
  }

 private:
  static void fill(std::vector<std::string>& scopes, std::size_t at, const std::smatch& found,
                   const std::string& name) {
    for (std::ptrdiff_t i = 0; i < found.length(); ++i) scopes[at + static_cast<std::size_t>(i)] = name;
  }
  bool match(const std::string& text, std::size_t at, const std::string& pattern, std::smatch& found) {
    auto [it, made] = patterns_.try_emplace(pattern);
    if (made) it->second = std::regex(pattern);
    auto flags = std::regex_constants::match_continuous;
    if (at > 0) flags |= std::regex_constants::match_prev_avail;
    return std::regex_search(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), found, it->second,
                             flags) &&
           found.length() > 0;
  }
  const Json* first(const Json& rules, const std::string& text, std::size_t at, std::smatch& found) {
    for (const Json& r : rules) {
      if (r.contains("include")) {
        const Json& included = grammar_["repository"][r["include"].get<std::string>().substr(1)];
        if (included.contains("begin")) {
          if (match(text, at, included["begin"], found)) return &included;
        } else if (const Json* inner = first(included["patterns"], text, at, found)) {
          return inner;
        }
      } else if (match(text, at, r.contains("begin") ? r["begin"] : r["match"], found)) {
        return &r;
      }
    }
    return nullptr;
  }

  const Json& grammar_;
  std::map<std::string, std::regex> patterns_;
};

// The beginning of the scope that a token wants; empty when several are right.
std::string wanted_scope(const syntax::TokenList& list, std::size_t i, const Words& words,
                         const std::string& text) {
  using enum syntax::TokenKind;
  const syntax::Token& token = list.tokens[i];
  const syntax::TokenKind next = list.tokens[i + 1].kind;
  const std::string word = text.substr(token.span.begin, token.span.end - token.span.begin);
  if (token.kind == number) return "constant.numeric";
  if (token.kind == color) return "constant.other.color";
  if (token.kind == string || token.kind == string_head) return "string";
  if (!syntax::is_word(token.kind)) return "";
  if (next == colon) return "variable.parameter";
  if (words.constants.contains(word)) return "constant.language";
  if (words.operators.contains(word)) return "keyword.operator.word";
  if (words.definitions.contains(word)) return "storage";
  if (words.control.contains(word)) return "keyword.control";
  if (next == left_paren) return words.builtins.contains(word) ? "support.function" : "entity.name.function";
  return "";
}

TEST(Editors, TextMateGrammarSeesWhatTheLexerDoes) {
  const Json grammar = textmate();
  const Words words;
  Scopes scopes(grammar);
  std::size_t tokens = 0;
  for (const char* folder : {"scenes", "tests/language", "tests/fuzz/corpus/parse"})
    for (const auto& entry : fs::directory_iterator(root / folder)) {
      if (entry.path().extension() != ".tyn") continue;
      const std::string text = read_file(entry.path());
      Sources sources;
      Diagnostics diagnostics;
      const syntax::TokenList list = syntax::lex(sources, sources.add("a.tyn", text), diagnostics);
      if (diagnostics.has_errors()) continue;
      const std::vector<std::string> found = scopes.of(text);
      for (std::size_t i = 0; i + 1 < list.tokens.size(); ++i) {
        const std::string wanted = wanted_scope(list, i, words, text);
        for (std::uint32_t at = list.tokens[i].span.begin; at < list.tokens[i].span.end && !wanted.empty();
             ++at)
          ASSERT_TRUE(found[at].starts_with(wanted) || found[at].starts_with("constant.character.escape"))
              << entry.path() << " offset " << at << ": " << found[at] << ", wanted " << wanted;
        ++tokens;
      }
      for (const Span& comment : list.comments)
        for (std::uint32_t at = comment.begin; at < comment.end; ++at)
          ASSERT_TRUE(found[at].starts_with("comment"))
              << entry.path() << " offset " << at << ": " << found[at];
    }
  EXPECT_GT(tokens, 2000u);
}

}  // namespace
}  // namespace tyndall::docs
