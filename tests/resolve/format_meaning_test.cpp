// Formatting keeps the meaning: every scene, and every scene laid out at random, resolves to the same before
// and after.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "resolved.h"
#include "syntax/format.h"

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string formatted(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add("a.tyn", text);
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << render_text(diagnostics, sources, false) << text;
  return syntax::format(sources, source, tokens, tree);
}

std::size_t comments_in(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  return syntax::lex(sources, sources.add("a.tyn", text), diagnostics).comments.size();
}

// The scene's words with other gaps between them: blanks, line breaks, comments, or none where none is
// needed.
std::string laid_out_at_random(const std::string& text, std::uint32_t seed) {
  Sources sources;
  Diagnostics diagnostics;
  const syntax::TokenList list = syntax::lex(sources, sources.add("a.tyn", text), diagnostics);
  std::mt19937 random(seed);
  static constexpr const char* gaps[] = {" ",     " ", " ", "\n", "  ", "\t", " // told\n", " /* told */ ",
                                         "\n\n\n"};
  std::string out;
  bool in_string = false;
  for (std::size_t i = 0; i + 1 < list.tokens.size(); ++i) {
    const Span& span = list.tokens[i].span;
    out += text.substr(span.begin, span.end - span.begin);
    const syntax::TokenKind kind = list.tokens[i].kind;
    if (kind == syntax::TokenKind::string_head) in_string = true;
    if (kind == syntax::TokenKind::string_tail) in_string = false;
    // Inside of a string's braces there is no line break; and some gaps mean something: 5 m is no length.
    const std::uint32_t gap = list.tokens[i + 1].span.begin - span.end;
    if (in_string)
      out += text.substr(span.end, gap);
    else if (gap > 0 || random() % 4 == 0)
      out += gaps[random() % std::size(gaps)];
  }
  return out + "\n";
}

class FormattedScene : public testing::TestWithParam<std::string> {};

void expect_same_meaning(const std::string& text, const std::string& path) {
  const std::string once = formatted(text);
  ASSERT_EQ(formatted(once), once) << text;
  ASSERT_EQ(comments_in(once), comments_in(text)) << text;
  const Resolved before = resolve_text(text, {}, path), after = resolve_text(once, {}, path);
  ASSERT_EQ(before.diagnostics.error_count(), after.diagnostics.error_count()) << after.messages() << once;
  ASSERT_EQ(scene::print(before.scene), scene::print(after.scene)) << once;
}

TEST_P(FormattedScene, MeansTheSame) { expect_same_meaning(text_of_file(GetParam()), GetParam()); }

TEST_P(FormattedScene, MeansTheSameHoweverItWasLaidOut) {
  const std::string text = text_of_file(GetParam());
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    const std::string other = laid_out_at_random(text, seed);
    expect_same_meaning(other, GetParam());
    if (HasFatalFailure()) return;
  }
}

std::vector<std::string> scenes() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(TYNDALL_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".tyn") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  for (const char* name : {"correct", "library"})
    paths.push_back(std::string(TYNDALL_SOURCE_DIR "/tests/language/") + name + ".tyn");
  return paths;
}

INSTANTIATE_TEST_SUITE_P(Scenes, FormattedScene, testing::ValuesIn(scenes()), [](const auto& scene) {
  std::string name = fs::path(scene.param).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
}  // namespace tyndall
