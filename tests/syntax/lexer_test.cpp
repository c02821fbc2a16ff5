// Words, numbers, strings and comments, and the errors for what is none of them.
#include <gtest/gtest.h>

#include <numbers>

#include "reading.h"

namespace tyndall::syntax {
namespace UNNAMED {

// The tokens of a text without their places, on one line.
std::string words(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  const TokenList tokens = lex(sources, sources.add("scene.tyn", text), diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << render_text(diagnostics, sources, false);
  std::string out;
  for (const Token& token : tokens.tokens) {
    if (token.kind == TokenKind::end_of_file) break;
    if (!out.empty()) out += ' ';
    out += sources.text(token.span);
  }
  return out;
}

// The only number of a text.
Token number(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  const TokenList tokens = lex(sources, sources.add("scene.tyn", text), diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << render_text(diagnostics, sources, false);
  EXPECT_EQ(tokens.tokens.size(), 2u) << text;
  EXPECT_EQ(tokens.tokens[0].kind, TokenKind::number) << text;
  return tokens.tokens[0];
}

// The errors of a text as "line:column message [help]" lines.
std::string errors(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  lex(sources, sources.add("scene.tyn", text), diagnostics);
  std::string out;
  for (const Diagnostic& d : diagnostics.all()) {
    const LineColumn at = sources[d.span.source].locate(d.span.begin);
    out += std::to_string(at.line) + ":" + std::to_string(at.column) + " " + d.message;
    if (!d.help.empty()) out += " [" + d.help + "]";
    out += '\n';
  }
  return out;
}

TEST(Lexer, PrintsOneTokenALine) {
  Reading r("let a = 5cm // five\n  \"x{a}y\" #f80");
  EXPECT_EQ(print(r.tokens, r.sources),
            "1:1 let\n"
            "1:5 name a\n"
            "1:7 =\n"
            "1:9 number 0.05m\n"
            "2:3 a string with values \"x\"\n"
            "2:6 name a\n"
            "2:7 the rest of a string \"y\"\n"
            "2:11 color #ff8800\n"
            "2:15 the end of the file\n");
}

TEST(Lexer, MarksArePartedGreedily) {
  EXPECT_EQ(words("a<=b>=c==d!=e<f>g..h..<i.j"), "a <= b >= c == d != e < f > g .. h ..< i . j");
  EXPECT_EQ(words("(a,b)[c]{d:e=f}+g-h*i/j^k"), "( a , b ) [ c ] { d : e = f } + g - h * i / j ^ k");
  EXPECT_EQ(words("a - -b"), "a - - b");
}

TEST(Lexer, ADotCountsOnlyBeforeADigit) {
  EXPECT_EQ(words("0..10"), "0 .. 10");
  EXPECT_EQ(words("0..<4"), "0 ..< 4");
  EXPECT_EQ(words("10..1..-1"), "10 .. 1 .. - 1");
}

TEST(Lexer, NumbersAndUnits) {
  struct Row {
    const char* text;
    double value;
    Unit unit;
  };
  const Row rows[] = {
      {"0", 0, Unit::none},
      {"12", 12, Unit::none},
      {"1.25", 1.25, Unit::none},
      {".5", 0.5, Unit::none},
      {"1e3", 1000, Unit::none},
      {"1E+3", 1000, Unit::none},
      {"25e-2", 0.25, Unit::none},
      {".5e1", 5, Unit::none},
      {"007", 7, Unit::none},
      {"50%", 0.5, Unit::none},
      {"2m", 2, Unit::length},
      {"5cm", 0.05, Unit::length},
      {"3mm", 0.003, Unit::length},
      {"4km", 4000, Unit::length},
      {"1e3mm", 1, Unit::length},
      {"3s", 3, Unit::time},
      {"20ms", 0.02, Unit::time},
      {"3200K", 3200, Unit::temperature},
      {"0.6rad", 0.6, Unit::angle},
      {"180deg", std::numbers::pi, Unit::angle},
      {"90deg", std::numbers::pi / 2, Unit::angle},
  };
  for (const Row& row : rows) {
    const Token token = number(row.text);
    EXPECT_EQ(token.number, row.value) << row.text;
    EXPECT_EQ(token.unit, row.unit) << row.text;
  }
}

TEST(Lexer, LettersJoinedToANumberAreWhollyAUnit) {
  EXPECT_EQ(errors("2e"), "1:2 'e' is not a unit [digits follow the e: write 1e3]\n");
  EXPECT_EQ(errors("30degs"), "1:3 'degs' is not a unit [write 30deg]\n");
  EXPECT_EQ(errors("0x10"), "1:2 'x10' is not a unit [numbers are decimal]\n");
  EXPECT_EQ(errors("0xff8000"), "1:2 'xff8000' is not a unit [a colour is written #ff8000]\n");
  EXPECT_EQ(errors("3x10"), "1:2 'x10' is not a unit [a pair is written (3, 10), a product 3 * 10]\n");
  EXPECT_EQ(errors("1_000"), "1:2 '_000' is not a unit [digits stand together: write 1000]\n");
  EXPECT_EQ(words("2 m"), "2 m");  // a number and a name
}

TEST(Lexer, NumbersThatNoDoubleHolds) {
  for (const char* text : {"1e999", "1e-999", "1e308km"})
    EXPECT_EQ(errors(text), "1:1 this number is too large or too small to be represented\n") << text;
  EXPECT_EQ(errors("1. "), "1:1 a dot belongs to a number only before a digit [write 1 or 1.0]\n");
}

TEST(Lexer, ColorsHaveThreeOrSixDigits) {
  const auto rgb = [](const std::string& text) {
    Sources sources;
    Diagnostics diagnostics;
    const TokenList tokens = lex(sources, sources.add("scene.tyn", text), diagnostics);
    EXPECT_EQ(tokens.tokens[0].kind, TokenKind::color) << text;
    return tokens.tokens[0].text;
  };
  EXPECT_EQ(rgb("#ff8800"), 0xff8800u);
  EXPECT_EQ(rgb("#f80"), 0xff8800u);
  EXPECT_EQ(rgb("#ABCdef"), 0xabcdefu);
  EXPECT_EQ(errors("#ff88"),
            "1:1 a colour has 3 or 6 hexadecimal digits after '#' [there is no alpha: use opacity]\n");
  EXPECT_EQ(errors("#fffffg"),
            "1:1 a colour has 3 or 6 hexadecimal digits after '#' [as in #f80 or #ff8800]\n");
  EXPECT_EQ(errors("# a comment\nx"), "1:1 '#' begins a colour [a comment begins with '//']\n");
}

TEST(Lexer, CommentsNest) {
  EXPECT_EQ(words("a /* b /* c */ d */ e // f\ng"), "a e g");
  EXPECT_EQ(words("a/**/b//"), "a b");
  EXPECT_EQ(errors("a /* b"), "1:3 this comment is never closed [close it with '*/']\n");
  EXPECT_EQ(errors("a /* b /* c"), "1:3 this comment is never closed [comments nest: 2 '*/' are missing]\n");
  EXPECT_EQ(errors("a */"), "1:3 no comment is open here ['/*' opens one]\n");
}

TEST(Lexer, EscapesOfStrings) {
  Reading r(R"(let a = "\n\t\"\\\{\}\u{e9}\u{1f32b} ü")");
  EXPECT_EQ(r.errors(), "");
  ASSERT_EQ(r.tokens.strings.size(), 1u);
  EXPECT_EQ(r.tokens.strings[0], "\n\t\"\\{}é\U0001f32b ü");
  EXPECT_EQ(errors(R"("\q\q")"),
            "1:2 unknown escape [a backslash is written '\\\\'; folders are parted by '/']\n");
  for (const char* text :
       {R"("\u")", R"("\u{}")", R"("\u{d800}")", R"("\u{110000}")", R"("\u{1234567}")", R"("\u{12")"})
    EXPECT_EQ(errors(text).substr(0, 37), "1:2 this escape names no character [w") << text;
}

TEST(Lexer, InterpolationsHaveTheirPlacesInTheFile) {
  Reading r("let s = \"leaf{ i + f({ }) }.{\"in{j}ner\"}\"");
  std::string names;
  for (const Token& token : r.tokens.tokens)
    if (token.kind == TokenKind::name)
      names += std::string(r.sources.text(token.span)) + "@" + std::to_string(token.span.begin) + " ";
  EXPECT_EQ(names, "s@4 i@15 f@19 j@33 ");
  EXPECT_EQ(r.errors(), "");
}

TEST(Lexer, StringsEndOnTheirLine) {
  EXPECT_EQ(errors("\"abc\nx"), "1:1 this string is never closed [close it with '\"' on the same line]\n");
  EXPECT_EQ(errors("\"abc"), "1:1 this string is never closed [close it with '\"' on the same line]\n");
  EXPECT_EQ(errors("\"a{b\nx"),
            "1:3 this '{' of a string is never closed [close it with '}' on the same line; a brace as such "
            "is written '\\{']\n");
  EXPECT_EQ(errors("\"a{\"b{c"),
            "1:3 this '{' of a string is never closed [close it with '}' on the same line; a brace as such "
            "is written '\\{']\n");
}

TEST(Lexer, SpellingsOfOtherLanguagesSayWhatToWrite) {
  const std::pair<const char*, const char*> rows[] = {
      {"#declare a = 1", "1:1 '#declare' is not of this language [write let name = value]\n"},
      {"a && b", "1:3 '&&' is written 'and'\n"},
      {"a || b", "1:3 '||' is written 'or'\n"},
      {"!a", "1:1 '!' is written 'not'\n"},
      {"a ** b", "1:3 a power is written with '^'\n"},
      {"a => b",
       "1:3 '=>' means nothing here ['greater or equal' is '>='; a parameter takes ':', a definition '=']\n"},
      {"a += b", "1:3 there is no such assignment [write a = a + b]\n"},
      {"a % b", "1:3 '%' is joined to a number (50%) [a remainder is mod(a, b)]\n"},
      {"a ? b", "1:3 '?' means nothing here [a choice is written: if a then b else c]\n"},
      {"1...5", "1:2 a range is written with two dots [write a..b (both ends) or a..<b (without b)]\n"},
      {"'a.png'", "1:1 strings are written in double quotes\n"},
      {"“a.png”",
       "1:1 curly quotes are not of this language [strings are written in straight quotes: \"…\"]\n"},
      {"a − b", "1:3 '−' is not of this language [write '-']\n"},
      {"30°", "1:3 '°' is not of this language [write 30deg]\n"},
      {"größe", "1:1 a name has only the letters A to Z, a to z, digits and _\n"},
      {"a @ b", "1:3 '@' means nothing here [leave it out: a name has letters, digits and _]\n"},
  };
  for (const auto& [text, expected] : rows) EXPECT_EQ(errors(text), expected);
}

TEST(Lexer, HabitsAreToldOnce) {
  EXPECT_EQ(errors("a;\nb;\nc;"),
            "1:2 ';' ends nothing here (3 places in this file) [leave it out: statements need no mark at "
            "their end]\n");
  EXPECT_EQ(
      errors("a\u00a0b\u00a0c"),
      "1:2 an invisible character that is no plain space (2 places in this file) [replace it by a space]\n");
}

TEST(Lexer, BytesThatAreNoTextGiveOneError) {
  EXPECT_EQ(errors("let a = 1 // " + std::string(3000, 'x') + "\n" + std::string(200, '\xff') + " let b = 2"),
            "2:1 these bytes are not UTF-8 text [save the file as UTF-8]\n");
  EXPECT_EQ(errors(std::string("a = \0\0\0 1", 9)),
            "1:5 a control character or NUL byte [remove it: scenes are plain text]\n");
  EXPECT_EQ(errors("\"a\xff"
                   "b\xfe"
                   "c\""),
            "1:3 these bytes are not UTF-8 text (2 places in this file) [save the file as UTF-8]\n");
  EXPECT_EQ(errors("\xff\xfel\0e\0"),
            "1:1 this file is not UTF-8 text [it seems to be UTF-16: save it as UTF-8]\n");
  std::string binary;
  for (int i = 0; i < 5000; ++i) binary += static_cast<char>(i * i * 31 + i);
  EXPECT_EQ(errors(binary), "1:1 this file is not text [a scene is plain UTF-8 text]\n");
  EXPECT_EQ(words("\xef\xbb\xbfsphere"), "sphere");  // a byte order mark is no error
  EXPECT_EQ(words(""), "");
}

TEST(Lexer, ANameHasABound) {
  EXPECT_EQ(words(std::string(256, 'a')), std::string(256, 'a'));
  EXPECT_EQ(errors(std::string(257, 'a')), "1:1 this name has 257 characters [a name may have 256]\n");
}

TEST(Lexer, CommentsAreText) {
  EXPECT_EQ(Reading("// é\tà\r\nlet a = 1 /* ☁\n */").brief(), "");
  EXPECT_EQ(Reading("let a = 1 // \xe9").brief(),
            "1:14 these bytes are not UTF-8 text [save the file as UTF-8]\n");
  EXPECT_EQ(Reading("/*\n\x01 */").brief(),
            "2:1 a control character or NUL byte [remove it: scenes are plain text]\n");
}

// LF, CR LF and CR alone end lines, and what goes to the end of a line.
TEST(Lexer, LinesEndInThreeWays) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    EXPECT_EQ(words("// a" + end + "b // c" + end + "d"), "b d");
    EXPECT_EQ(errors("a" + end + end + " \xff\xfe"),
              "3:2 these bytes are not UTF-8 text [save the file as UTF-8]\n");
    EXPECT_EQ(errors("a = \"b" + end + "c"),
              "1:5 this string is never closed [close it with '\"' on the same line]\n");
  }
}

TEST(Lexer, AFileHasABound) {
  Sources sources;
  const SourceId source = sources.add("a.tyn", "a b c\nd e");
  for (const std::size_t most : {4, 5}) {
    Diagnostics diagnostics;
    const TokenList tokens = lex(sources, source, diagnostics, most);
    ASSERT_EQ(diagnostics.error_count(), most == 4 ? 1 : 0);
    EXPECT_EQ(tokens.tokens.back().kind, TokenKind::end_of_file);
    if (most == 4) {
      EXPECT_EQ(diagnostics.all()[0].message, "more than 4 words, marks and comments");
      EXPECT_EQ(sources[source].locate(diagnostics.all()[0].span.begin).line, 2u);
    }
  }
}

// However many brackets are never closed, few of them become tokens.
TEST(Lexer, BracketsPastAllBoundsEndTheReading) {
  for (const std::string open : {"(", "[", "{", "\"{"}) {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += open;
    Sources sources;
    const SourceId source = sources.add("a.tyn", text);
    Diagnostics diagnostics;
    EXPECT_LT(lex(sources, source, diagnostics).tokens.size(), 40'000u);
  }
}

}  // namespace
}  // namespace tyndall::syntax
