// A misspelt word in a good scene is one error, at its place, that names the right word: tried with every
// name of every scene in scenes/.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unordered_set>

#include "resolved.h"

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;
using syntax::TokenKind;

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Where names are defined: their uses are looked at, not they.
std::unordered_set<std::uint32_t> definitions(const syntax::SyntaxTree& tree) {
  std::unordered_set<std::uint32_t> places;
  for (const syntax::Parameter& parameter : tree.parameters) places.insert(parameter.name.span.begin);
  for (const syntax::Comprehension& list : tree.comprehensions) places.insert(list.name.span.begin);
  for (const syntax::Item& item : tree.items) {
    const auto add = [&](const syntax::Name& name) { places.insert(name.span.begin); };
    if (const auto* let = std::get_if<syntax::LetItem>(&item.node)) add(let->name);
    if (const auto* var = std::get_if<syntax::VarItem>(&item.node)) add(var->name);
    if (const auto* function = std::get_if<syntax::FunctionItem>(&item.node)) add(function->name);
    if (const auto* form = std::get_if<syntax::TemplateItem>(&item.node)) add(form->name);
    if (const auto* body = std::get_if<syntax::BodyItem>(&item.node)) add(body->name);
    if (const auto* object = std::get_if<syntax::ObjectItem>(&item.node)) add(object->name);
    if (const auto* loop = std::get_if<syntax::ForItem>(&item.node)) add(loop->name);
  }
  return places;
}

// The places of all names that are used: words of the language and the scene's own. Reserved words count
// where they are names of parameters.
std::vector<Span> names_used(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add("scene.tyn", text);
  const syntax::TokenList list = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, list, symbols, diagnostics);
  const std::unordered_set<std::uint32_t> defined = definitions(tree);
  std::vector<Span> places;
  for (std::size_t i = 0; i + 1 < list.tokens.size(); ++i) {
    const syntax::Token& token = list.tokens[i];
    const bool is_swizzle = i > 0 && list.tokens[i - 1].kind == TokenKind::dot;
    const bool is_parameter = syntax::is_word(token.kind) && list.tokens[i + 1].kind == TokenKind::colon;
    if ((token.kind == TokenKind::name || is_parameter) && !is_swizzle && !defined.contains(token.span.begin))
      places.push_back(token.span);
  }
  return places;
}

// Typing mistakes: the last letter twice, two letters exchanged, a letter of the middle wrong.
std::vector<std::string> misspellings(const std::string& word) {
  std::vector<std::string> all{word + word.back()};
  if (word.size() < 5) return all;
  std::string exchanged = word, wrong = word;
  std::swap(exchanged[word.size() / 2], exchanged[word.size() / 2 - 1]);
  wrong[word.size() / 2] = 'q';
  for (const std::string& other : {exchanged, wrong})
    if (other != word) all.push_back(other);
  return all;
}

class Misspelling : public testing::TestWithParam<std::string> {};

TEST_P(Misspelling, IsOneErrorThatNamesTheRightWord) {
  const std::string text = text_of_file(GetParam());
  const std::vector<Span> places = names_used(text);
  ASSERT_GT(places.size(), 10u);
  std::unordered_set<std::string> words;
  for (const Span& place : places) words.insert(text.substr(place.begin, place.end - place.begin));
  for (const Span& place : places) {
    const std::string word = text.substr(place.begin, place.end - place.begin);
    for (const std::string& wrong : misspellings(word)) {
      if (words.contains(wrong)) continue;
      std::string broken = text;
      broken.replace(place.begin, word.size(), wrong);
      const Resolved r = resolve_text(broken, {}, GetParam());
      ASSERT_EQ(r.diagnostics.all().size(), 1u) << wrong << "\n" << r.messages();
      const Diagnostic& d = r.diagnostics.all()[0];
      ASSERT_EQ(d.severity, Severity::error) << r.messages();
      ASSERT_EQ(d.span.begin, place.begin) << wrong << "\n" << r.messages();
      ASSERT_EQ(d.help, "did you mean '" + word + "'?") << wrong << "\n" << r.messages();
    }
  }
}

std::vector<std::string> scenes() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(TYNDALL_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".tyn") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  for (const char* name : {"correct", "library"})
    paths.push_back(fmt::format("{}/tests/language/{}.tyn", TYNDALL_SOURCE_DIR, name));
  return paths;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Misspelling, testing::ValuesIn(scenes()), [](const auto& scene) {
  std::string name = fs::path(scene.param).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace tyndall
