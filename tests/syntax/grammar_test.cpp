// The grammar as it is written holds: its names and words are those of the code, its sentences are read, and
// broken ones are reported inside the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "reading.h"
#include "support/ebnf.h"
#include "support/sentences.h"
#include "syntax/format.h"

namespace tyndall::syntax {
namespace UNNAMED {

namespace fs = std::filesystem;
using test::Ebnf;
using test::EbnfNode;

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// The grammar, and which of its productions are words.
struct Grammar {
  std::string text = file_text(TYNDALL_SOURCE_DIR "/grammar/tyndall.ebnf");
  Ebnf ebnf{text};
  std::vector<std::string> lexical, syntactic;
  Grammar() {
    for (const std::string& name : ebnf.names()) {
      // "file" is the first of the items.
      (name == "file" || !syntactic.empty() ? syntactic : lexical).push_back(name);
    }
  }
};
const Grammar& grammar() {
  static const Grammar g;
  return g;
}

void collect(const EbnfNode& node, std::set<std::string>& terminals, std::set<std::string>& names) {
  if (node.kind == EbnfNode::Kind::terminal) terminals.insert(node.text);
  if (node.kind == EbnfNode::Kind::name) names.insert(node.text);
  for (const EbnfNode& part : node.parts) collect(part, terminals, names);
}

TEST(Grammar, EveryNameHasAProductionAndIsUsed) {
  std::set<std::string> terminals, used{"file", "comment"};
  for (const std::string& name : grammar().ebnf.names()) collect(grammar().ebnf[name], terminals, used);
  for (const std::string& name : used) EXPECT_TRUE(grammar().ebnf.has(name)) << name;
  for (const std::string& name : grammar().ebnf.names()) EXPECT_TRUE(used.contains(name)) << name;
}

TEST(Grammar, TerminalsAreTheTokens) {
  std::set<std::string> written, names, spelled;
  for (const std::string& name : grammar().syntactic) collect(grammar().ebnf[name], written, names);
  for (int k = static_cast<int>(TokenKind::kw_let); k <= static_cast<int>(TokenKind::dot_dot_less); ++k)
    spelled.insert(std::string(spelling(static_cast<TokenKind>(k))));
  EXPECT_EQ(written, spelled);

  std::set<std::string> reserved, reserved_spelled;
  collect(grammar().ebnf["reserved"], reserved, names);
  for (int k = static_cast<int>(TokenKind::kw_let); k <= static_cast<int>(TokenKind::kw_false); ++k)
    reserved_spelled.insert(std::string(spelling(static_cast<TokenKind>(k))));
  EXPECT_EQ(reserved, reserved_spelled);
}

// Productions that the parser's comments write out ("// name = …"), and its functions.
TEST(Grammar, ProductionsAreTheFunctionsOfTheParser) {
  std::set<std::string> written, functions;
  const std::regex production(R"((?:^// (?:.*: )?|;  ?)([a-z_]+) = )"),
      function(R"(Parser::([a-z_]+?)(?:_item)?\()");
  for (const auto& entry : fs::directory_iterator(TYNDALL_SOURCE_DIR "/src/syntax")) {
    if (!entry.path().filename().string().starts_with("parse_")) continue;
    std::istringstream lines(file_text(entry.path()));
    for (std::string line; std::getline(lines, line);) {
      const bool comment = line.starts_with("// ");
      const std::regex& wanted = comment ? production : function;
      for (std::sregex_iterator it(line.begin(), line.end(), wanted), end; it != end; ++it)
        (comment ? written : functions).insert((*it)[1]);
    }
  }
  for (const std::string& name : written)
    EXPECT_TRUE(grammar().ebnf.has(name)) << "only in the parser: " << name;
  for (const std::string& name : grammar().syntactic)
    EXPECT_TRUE(written.contains(name) || functions.contains(name)) << "only in the grammar: " << name;
}

// Words joined by blanks, line breaks and comments, whatever the generator's numbers say.
std::string joined(const std::vector<std::string>& words, test::Sentences& sentences) {
  static constexpr const char* gaps[] = {" ", " ", " ", " ", " ", "\n", "  ", " // a\n", " /* b /* c */ */ "};
  std::string text;
  for (const std::string& word : words) text += word + gaps[sentences.below(std::size(gaps))];
  return text;
}

// Every message has a place in the file, and a value that could not be read has a message.
void expect_sound(const Reading& r) {
  const std::size_t size = r.sources[r.tree.source].text().size();
  for (const Diagnostic& d : r.diagnostics.all()) {
    ASSERT_TRUE(d.span.valid());
    ASSERT_LE(d.span.begin, d.span.end);
    ASSERT_LE(d.span.end, size);
    ASSERT_FALSE(d.message.empty());
  }
  const bool unread = r.printed().find("<error>") != std::string::npos;
  ASSERT_TRUE(r.diagnostics.has_errors() || !unread);
}

constexpr std::uint32_t seed = 20;
constexpr int sentence_count = 10000;

TEST(Grammar, SentencesAreReadAndFormatted) {
  test::Sentences sentences(grammar().ebnf, grammar().lexical, seed);
  std::size_t words = 0;
  for (int i = 0; i < sentence_count; ++i) {
    const std::vector<std::string> sentence = sentences.next();
    words += sentence.size();
    const std::string text = joined(sentence, sentences);
    const Reading r(text);
    ASSERT_EQ(r.errors(), "") << "sentence " << i << ":\n" << text;
    const std::string once = format(r.sources, r.tree.source, r.tokens, r.tree);
    const Reading again(once);
    ASSERT_EQ(again.errors(), "") << text << "\n-- became\n" << once;
    ASSERT_EQ(again.printed(), r.printed()) << text << "\n-- became\n" << once;
    ASSERT_EQ(again.tokens.comments.size(), r.tokens.comments.size()) << text;
    ASSERT_EQ(format(again.sources, again.tree.source, again.tokens, again.tree), once) << text;
  }
  EXPECT_GT(words, 20u * sentence_count);
}

void break_words(std::vector<std::string>& words, test::Sentences& sentences) {
  const std::size_t at = sentences.below(words.size()), other = sentences.below(words.size());
  switch (sentences.below(4)) {
    case 0:
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(at));
      return;
    case 1:
      words.insert(words.begin() + static_cast<std::ptrdiff_t>(at), words[other]);
      return;
    case 2:
      std::swap(words[at], words[other]);
      return;
    case 3:
      words[at] = std::string(spelling(
          static_cast<TokenKind>(static_cast<std::size_t>(TokenKind::kw_let) +
                                 sentences.below(1 + static_cast<std::size_t>(TokenKind::dot_dot_less) -
                                                 static_cast<std::size_t>(TokenKind::kw_let)))));
  }
}

TEST(Grammar, BrokenSentencesAreReportedInsideTheFile) {
  test::Sentences sentences(grammar().ebnf, grammar().lexical, seed + 1);
  int refused = 0;
  for (int i = 0; i < sentence_count; ++i) {
    std::vector<std::string> words = sentences.next();
    for (std::size_t edits = 1 + sentences.below(3); edits > 0 && !words.empty(); --edits)
      break_words(words, sentences);
    std::string text = joined(words, sentences);
    if (i % 3 == 0 && !text.empty())
      text[sentences.below(text.size())] ^= static_cast<char>(1 << sentences.below(8));
    SCOPED_TRACE(text);
    const Reading r(text);
    expect_sound(r);
    if (HasFatalFailure()) return;
    refused += r.diagnostics.has_errors() ? 1 : 0;
  }
  EXPECT_GT(refused, sentence_count / 2);
}

}  // namespace
}  // namespace tyndall::syntax
