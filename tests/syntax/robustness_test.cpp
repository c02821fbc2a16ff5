// Whatever the text, reading it ends, with a tree that can be printed; and depth is bounded, not crashed
// upon.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <random>
#include <sstream>

#include "reading.h"
#include "support/filled.h"

namespace tyndall::syntax {
namespace UNNAMED {

using support::filled;
using support::repeated;

// A form with something opened this many times, for `$OPEN`, and closed as often.
std::string nested(std::string_view form, std::string_view open, std::string_view close, int times) {
  return filled(form, {{"OPEN", repeated(open, times)}, {"CLOSE", repeated(close, times)}});
}

// Nothing is demanded of these but an end: the sanitizers and the parser's own checks do the rest.
void read(const std::string& text) {
  const Reading r(text);
  EXPECT_FALSE(r.printed().empty());
  r.errors();
}

TEST(Robustness, DeepNestingIsOneError) {
  struct Deep {
    std::string_view form, open, close = "";  // each of the two stands there ten thousand times
  };
  const Deep deep[] = {
      {"let a = $OPEN 1 $CLOSE", "(", ")"},
      {"let a = $OPEN $CLOSE", "["},
      {"let a = $OPEN $CLOSE", "f("},
      {"let a = $OPEN 1 $CLOSE", "-"},
      {"let a = $OPEN b $CLOSE", "not "},
      {"let a = $OPEN 1 $CLOSE", "2^"},
      {"let a = $OPEN 1 $CLOSE", "1+"},
      {"let a = b $OPEN $CLOSE", ".x"},
      {"let a = b $OPEN $CLOSE", "(1)"},
      {"let a = b $OPEN $CLOSE", "[1]"},
      {"let a = $OPEN d $CLOSE", "if b then c else "},
      {"let a = $OPEN $CLOSE", "if "},
      {"let a = $OPEN $CLOSE", "s { t: "},
      {"$OPEN $CLOSE", "group { "},
      {"$OPEN $CLOSE", "if a { "},
      {"$OPEN { } $CLOSE", "if a { } else "},
      {"$OPEN $CLOSE", "def f() { "},
      {"medium m() { d = $OPEN 1 $CLOSE }", "(a * ", ")"},
  };
  for (const Deep& d : deep) {
    const std::string text = nested(d.form, d.open, d.close, 10000);
    const Reading r(text);
    ASSERT_EQ(r.diagnostics.error_count(), 1) << text.substr(0, 30) << "\n" << r.errors();
    EXPECT_EQ(r.diagnostics.all()[0].message, "nested too deeply: at most 256 levels are read")
        << text.substr(0, 30);
    r.printed();
  }
}

TEST(Robustness, ModerateNestingIsRead) {
  EXPECT_EQ(Reading(nested("let a = $OPEN 1 $CLOSE", "(", ")", 250)).errors(), "");
  EXPECT_EQ(Reading(nested("let a = $OPEN 1 $CLOSE", "1+", "", 250)).errors(), "");
  EXPECT_EQ(Reading(nested("$OPEN $CLOSE", "group { ", "}", 250)).errors(), "");
  EXPECT_EQ(Reading(nested("let a = $OPEN 1 $CLOSE", "(1+", ")", 120)).errors(), "");
}

TEST(Robustness, DeepStringsAreTwoErrorsAtMost) {
  const Reading r(filled("let a = $OPEN", {{"OPEN", repeated("\"{", 10000)}}));
  EXPECT_LE(r.diagnostics.error_count(), 2);
  r.printed();
}

TEST(Robustness, FiveMegabytesOnOneLine) {
  std::string text;
  while (text.size() < 5'000'000) text += "let a = (1, 2.5, fbm(p * 3)) sphere { radius: 3cm center: a } ";
  const auto begin = std::chrono::steady_clock::now();
  const Reading r(text);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(r.errors(), "");
  EXPECT_LT(seconds, 20);  // about half a second; what grows with the square of the length takes minutes
  EXPECT_GT(r.tree.items.size(), 100000u);
}

TEST(Robustness, AMegabyteOfMistakes) {
  for (const char* piece :
       {"( ", "} ", "a ", "\"", "let ", "1 2 ", "# ", "\"{", "/* ", "{ ", ": = ", "\xff ", "a ( ",
        "include a ; ", "include a.", "a { medium b(\n", "a { b 1 ", "if a b { ", "a { b < "}) {
    std::string text;
    while (text.size() < 1'000'000) text += piece;
    const Reading r(text);
    EXPECT_TRUE(r.diagnostics.has_errors());
    r.errors();
  }
}

constexpr std::string_view soup[] = {
    "let",  "var", "def", "return", "medium", "material", "object", "place", "include", "if",     "then",
    "else", "for", "in",  "and",    "or",     "not",      "true",   "false", "(",       ")",      "[",
    "]",    "{",   "}",   ",",      ":",      ".",        "=",      "+",     "-",       "*",      "/",
    "^",    "<",   "<=",  ">",      "==",     "!=",       "..",     "..<",   "a",       "sphere", "b",
    "1",    "2.5", "3cm", "#fff",   "\"s\"",  "\"a{",     "}b\"",   "\n",    "\"{",     ";",      "&&",
    "!",    "=>",  "//",  "/*",     "*/",     "f(",       "x: ",    "y = ",  "@",       "\xff",
};

TEST(Robustness, RandomTokens) {
  std::mt19937 random(1);
  for (int round = 0; round < 4000; ++round) {
    std::string text;
    const std::size_t length = random() % 120;
    for (std::size_t i = 0; i < length; ++i) {
      text += soup[random() % std::size(soup)];
      text += ' ';
    }
    SCOPED_TRACE(text);
    read(text);
  }
}

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Robustness, MutatedScenes) {
  std::mt19937 random(2);
  for (const char* name : {"definitions", "statements", "grid", "scene", "values", "mistakes"}) {
    const std::string scene =
        file_text(std::string(TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/parse/") + name + ".tyn");
    for (int round = 0; round < 500; ++round) {
      std::string text = scene;
      for (std::size_t edits = 1 + random() % 4; edits > 0; --edits) {
        const std::size_t at = random() % (text.size() + 1);
        const std::size_t length = random() % 20;
        switch (random() % 4) {
          case 0:
            text.erase(at, length);
            break;
          case 1:
            text.insert(at, soup[random() % std::size(soup)]);
            break;
          case 2:
            text.insert(at, text.substr(random() % (text.size() + 1), length));
            break;
          case 3:
            text.insert(at, 1, static_cast<char>(random()));
            break;
        }
      }
      SCOPED_TRACE(text);
      read(text);
    }
  }
}

TEST(Robustness, EveryBeginningOfAScene) {
  const std::string scene = file_text(TYNDALL_SOURCE_DIR "/tests/fuzz/corpus/parse/scene.tyn");
  for (std::size_t length = 0; length <= scene.size(); ++length) read(scene.substr(0, length));
}

// Reading ends after a thousand errors, whichever there are and wherever they stand.
TEST(Robustness, ErrorsWithoutEndEndTheReading) {
  for (const std::string_view mistake : {"@",
                                         "<",
                                         "&& ",
                                         "'a' ",
                                         "let let ",
                                         "f(,) ",
                                         "a b ",
                                         "[1 2] ",
                                         "sphere { , } ",
                                         "if { ",
                                         "x = = 1 ",
                                         "(1,2,3,4) ",
                                         "let a = (1,,2) ",
                                         "def f(1) ",
                                         "\"{1 1}\" ",
                                         "for in ",
                                         "medium { } ",
                                         "a: 1 ",
                                         "let a = <1,2,3> ",
                                         "1..2..3..4 ",
                                         "let a == 1 ",
                                         "t() = 1 ",
                                         "p.x = 1 ",
                                         "return if ",
                                         "é ",
                                         "\"\\q\" ",
                                         "let a = 1 < 2 < 3 ",
                                         "**",
                                         "let if = 3 "})
    for (const std::string_view open :
         {"", "sphere { ", "let a = [", "let a = f(", "medium m() { ", "def f() = { "}) {
      std::string text(open);
      for (int i = 0; i < 3000; ++i) text += mistake;
      Sources sources;
      Symbols symbols;
      Diagnostics diagnostics;
      const SourceId source = sources.add("a.tyn", text);
      const TokenList tokens = lex(sources, source, diagnostics);
      parse(sources, source, tokens, symbols, diagnostics);
      EXPECT_GT(diagnostics.error_count(), 0) << open << mistake;
      EXPECT_LE(diagnostics.error_count(), 1010) << open << mistake;
    }
}

}  // namespace UNNAMED
}  // namespace tyndall::syntax
