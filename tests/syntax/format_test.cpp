// The laws of formatting: meaning and comments kept, a second round changes nothing. And what it looks like.
#include "syntax/format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "reading.h"
#include "support/filled.h"

namespace tyndall::syntax {
namespace {

namespace fs = std::filesystem;

std::string formatted(const Reading& r) { return format(r.sources, r.tree.source, r.tokens, r.tree); }

// The comments, without blanks at the ends of their lines.
std::string comments_of(const Reading& r) {
  std::string out;
  for (const Span& comment : r.tokens.comments) {
    std::istringstream lines{std::string(r.sources.text(comment))};
    for (std::string line; std::getline(lines, line);)
      out += line.substr(0, line.find_last_not_of(" \t\r") + 1) + "\n";
  }
  return out;
}

// Holds a text without errors to the laws; gives it formatted.
std::string lawful(const std::string& text) {
  const Reading before(text);
  EXPECT_EQ(before.errors(), "") << text;
  if (before.diagnostics.has_errors()) return {};
  const std::string once = formatted(before);
  const Reading after(once);
  EXPECT_EQ(after.errors(), "") << once;
  EXPECT_EQ(after.printed(), before.printed()) << text << "\n-- became\n" << once;
  EXPECT_EQ(comments_of(after), comments_of(before)) << text;
  if (!after.diagnostics.has_errors()) {
    EXPECT_EQ(formatted(after), once) << text << "\n-- became\n" << once;
  }
  return once;
}

std::vector<fs::path> scenes() {
  std::vector<fs::path> paths;
  for (const char* folder : {"/scenes", "/tests/language", "/tests/fuzz/corpus/parse"})
    for (const auto& entry : fs::recursive_directory_iterator(TYNDALL_SOURCE_DIR + std::string(folder)))
      if (entry.path().extension() == ".tyn") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Format, ScenesKeepTheirMeaningAndComments) {
  std::size_t read = 0;
  for (const fs::path& path : scenes()) {
    const std::string text = file_text(path);
    if (Reading(text).diagnostics.has_errors()) continue;
    SCOPED_TRACE(path);
    lawful(text);
    ++read;
  }
  EXPECT_GE(read, 20u);
}

// Whatever blanks and comments stand between the words of a scene.
TEST(Format, AnyBlanksAndComments) {
  constexpr std::string_view gaps[] = {" ",
                                       "  ",
                                       "\n",
                                       "\n\n\n",
                                       "\n   ",
                                       " // a\n",
                                       "\n// b\n",
                                       "\n\n  // c\n",
                                       " /* d */ ",
                                       "\n/* e */\n",
                                       " /* f */",
                                       "\t\r\n",
                                       "\n/* g\n  h\n*/ ",
                                       " // i\n\n// j\n"};
  for (const fs::path& path : scenes()) {
    std::mt19937 random(3);
    const Reading original(file_text(path));
    if (original.diagnostics.has_errors()) continue;
    SCOPED_TRACE(path);
    for (int round = 0; round < 40 && !testing::Test::HasFailure(); ++round) {
      const std::size_t rarity = 2 + random() % 12;
      std::string text;
      const std::vector<Token>& tokens = original.tokens.tokens;
      for (std::size_t i = 0; i < tokens.size(); ++i) {
        text += random() % rarity == 0 ? gaps[random() % std::size(gaps)] : " ";
        const std::size_t first = i;
        for (int open = tokens[i].kind == TokenKind::string_head ? 1 : 0; open > 0;) {
          ++i;
          if (tokens[i].kind == TokenKind::string_head) ++open;
          if (tokens[i].kind == TokenKind::string_tail) --open;
        }
        text += original.sources.text(join(tokens[first].span, tokens[i].span));
      }
      const std::string once = lawful(text);
      EXPECT_EQ(Reading(once).printed(), original.printed()) << text;
    }
  }
}

// A parameter with a block is joined to the one before where both have room on the line, the comment between
// counted.
TEST(Format, ACommentInAParameterCountsForTheWidth) {
  for (std::size_t zeros = 0; zeros < 40; ++zeros)
    lawful(support::filled(R"(sphere {
  center: (-1.25, 0.6, -0.2)  radius: 0.6$ZEROS material /* f */ : { base_color = 0.5 }
}
)",
                           {{"ZEROS", std::string(zeros, '0')}}));
}

struct Example {
  const char *written, *wanted;
};

TEST(Format, LooksLikeThis) {
  const Example examples[] = {
      {"", ""},
      {"\n\n// alone", "// alone\n"},
      {"let a=1", "let a = 1\n"},
      {"let a=-1+2*-b^-2 let c=f( x ,y )[ 0 ].xz", "let a = -1 + 2 * -b^-2\nlet c = f(x, y)[0].xz\n"},
      {"sphere{radius:1 center:(0,1,2)}", "sphere { radius: 1  center: (0, 1, 2) }\n"},
      {"sphere{radius:1,center:(0,1,2,),}", "sphere { radius: 1  center: (0, 1, 2) }\n"},
      {"sphere\n{\nradius:1\n\n\n\n  center:(0,1,2) }", "sphere {\n  radius: 1\n\n  center: (0, 1, 2)\n}\n"},
      {"sphere {\n  center: a   radius: 1\n}", "sphere {\n  center: a  radius: 1\n}\n"},
      {"place a { }  place b {\n}", "place a {}\nplace b {}\n"},
      {"for i in 0 .. 4 {f(i)}", "for i in 0..4 { f(i) }\n"},
      {"for i in n-1..n+1..2 {}", "for i in n - 1 .. n + 1 .. 2 {}\n"},
      {"for i in (n-1)..(n+1) {}", "for i in (n - 1)..(n + 1) {}\n"},
      {"let r = 0.. .5", "let r = 0.. .5\n"},
      {"if a{f()}else if not(b) {g()} else{h()}", "if a { f() } else if not (b) { g() } else { h() }\n"},
      {"if a {\nf() } else {g()}", "if a {\n  f()\n} else {\n  g()\n}\n"},
      {"let a = if b then c else d", "let a = if b then c else d\n"},
      {"let l = [\n1,\n2,\n]", "let l = [\n  1,\n  2,\n]\n"},
      {"let a = f(1,\n       2)", "let a = f(1,\n  2)\n"},
      {"let a = 1 +\n 2", "let a = 1 +\n  2\n"},
      {"let a = \"x{ 1+2 }y\"", "let a = \"x{ 1+2 }y\"\n"},
      {"let a = 1 // one\n// two\n\n\n// three\nlet b = 2",
       "let a = 1  // one\n// two\n\n// three\nlet b = 2\n"},
      {"group { // here\n a()\n // end\n}", "group {  // here\n  a()\n  // end\n}\n"},
      {"medium m(){density=1 albedo=0.5}", "medium m() { density = 1  albedo = 0.5 }\n"},
      {"volume { in: sphere { radius: 1 } medium: { density = 1 albedo = 0.5 phase = hg(0.12345678901234) } "
       "step: "
       "0.1 "
       "}",
       "volume {\n  in: sphere { radius: 1 }\n  medium: { density = 1  albedo = 0.5  phase = "
       "hg(0.12345678901234) "
       "}\n  "
       "step: 0.1\n}\n"},
      {"a { b: x, and: y }", "a { b: x, and: y }\n"},
  };
  for (const Example& example : examples) EXPECT_EQ(lawful(example.written), example.wanted);
}

TEST(Format, KeepsTheAuthorsTables) {
  const Example examples[] = {
      {"let a   = 1\nlet bcd = 2\n", "let a   = 1\nlet bcd = 2\n"},
      {"let a = 1\nlet bcd = 2\n", "let a = 1\nlet bcd = 2\n"},
      {"let a    = 1\nlet bcd  = 2\n", "let a   = 1\nlet bcd = 2\n"},
      {"let a   = 1\n\nlet bcd = 2\n", "let a = 1\n\nlet bcd = 2\n"},
      {"render    { samples: 1 }\nanimation { fps: 1 }", "render    { samples: 1 }\nanimation { fps: 1 }\n"},
      {"disk { center: (0, 0, 0)    u: 1 }\ndisk { center: (-2.4, 1, 0) u: 2 }",
       "disk { center: (0, 0, 0)     u: 1 }\ndisk { center: (-2.4, 1, 0)  u: 2 }\n"},
      {"f(1)    // a\ng(1,2)  // b\n", "f(1)     // a\ng(1, 2)  // b\n"},
      {"box {\n  min:   a\n  maxim: b\n}", "box {\n  min:   a\n  maxim: b\n}\n"},
  };
  for (const Example& example : examples) EXPECT_EQ(lawful(example.written), example.wanted);
}

}  // namespace
}  // namespace tyndall::syntax
