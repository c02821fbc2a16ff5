// How errors are collected and shown, and what a mistyped word is taken for.
#include "base/diagnostics.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace UNNAMED {

// A source and a span of the first occurrence of `mark` in it.
struct Place {
  Sources sources;
  Span span;

  Place(std::string text, std::string_view mark) {
    const std::size_t begin = text.find(mark);
    const SourceId id = sources.add("scene.tyn", std::move(text));
    span = {id, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(begin + mark.size())};
  }
  std::string shown(std::string message, std::string help = {}) {
    return render_text(Diagnostic{Severity::error, span, std::move(message), std::move(help), {}}, sources,
                       false);
  }
};

TEST(Diagnostics, ShowsThePlaceTheLineAndTheWayOut) {
  Place place("medium fog() {\n  desnity = 2\n}\n", "desnity");
  EXPECT_EQ(place.shown("medium has no 'desnity'", "did you mean 'density'?"),
            "scene.tyn:2:3: error: medium has no 'desnity'\n"
            "    2 |   desnity = 2\n"
            "      |   ^~~~~~~\n"
            "      = help: did you mean 'density'?\n");
}

TEST(Diagnostics, TabsStayTabsSoThatTheCaretStandsRight) {
  Place place("\tlet\tx = 1", "x");
  EXPECT_EQ(place.shown("m"),
            "scene.tyn:1:6: error: m\n"
            "    1 | \tlet\tx = 1\n"
            "      | \t   \t^\n");
}

TEST(Diagnostics, ColumnsAreCharactersNotBytes) {
  Place place("\"äöü\" x", "x");
  EXPECT_EQ(place.shown("m"),
            "scene.tyn:1:7: error: m\n"
            "    1 | \"äöü\" x\n"
            "      |       ^\n");
}

TEST(Diagnostics, WhatWouldDisturbATerminalIsReplaced) {
  Place place("a\x1b[2J\xff x", "x");
  EXPECT_NE(place.shown("m").find("    1 | a\ufffd[2J\ufffd x\n      |        ^\n"), std::string::npos)
      << place.shown("m");
}

TEST(Diagnostics, LinesEndInThreeWays) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    Place place("let a = 1" + end + "let b = x" + end, "x");
    EXPECT_EQ(place.shown("m"),
              "scene.tyn:2:9: error: m\n"
              "    2 | let b = x\n"
              "      |         ^\n");
  }
}

TEST(Diagnostics, AByteOrderMarkIsNoPartOfTheLine) {
  Place place("\xef\xbb\xbfsphere x", "x");
  const std::string wanted = "    1 | sphere x\n";
  EXPECT_EQ(place.shown("m"), "scene.tyn:1:8: error: m\n" + wanted + "      |        ^\n");
  place.span.begin = place.span.end = 0;
  EXPECT_EQ(place.shown("m"), "scene.tyn:1:1: error: m\n" + wanted + "      | ^\n");
}

TEST(Diagnostics, LinesThatAreNoTextAreNotShown) {
  Place place("x" + std::string(20, '\x01') + "secret", "x");
  EXPECT_EQ(place.shown("m"), "scene.tyn:1:1: error: m\n");
}

TEST(Diagnostics, AnErrorAtTheEndOfALineOrFileHasACaretBehindIt) {
  Place place("let a =", "=");
  place.span.begin = place.span.end = 7;
  EXPECT_EQ(place.shown("m"), "scene.tyn:1:8: error: m\n    1 | let a =\n      |        ^\n");
}

TEST(Diagnostics, ASpanOfSeveralLinesIsUnderlinedOnItsFirst) {
  Place place("sphere {\n}\n", "sphere {\n}");
  EXPECT_EQ(place.shown("m"), "scene.tyn:1:1: error: m\n    1 | sphere {\n      | ^~~~~~~~\n");
}

TEST(Diagnostics, LongLinesAreCutAroundTheCaret) {
  for (const std::size_t before : {0u, 50u, 99u, 100u, 101u, 5000u}) {
    for (const std::size_t after : {0u, 1u, 60u, 5000u}) {
      Place place(std::string(before, 'a') + "!" + std::string(after, 'b'), "!");
      const std::string text = place.shown("m");
      const std::size_t first = text.find('\n') + 1, second = text.find('\n', first) + 1;
      const std::string line = text.substr(first, second - first - 1);
      const std::string carets = text.substr(second, text.find('\n', second) - second);
      EXPECT_LT(line.size(), 120u);
      // The caret stands under the mark; an ellipsis is three bytes and one column.
      const std::size_t cut = line.find("…");
      const std::size_t mark_column = line.find('!') - (cut < line.find('!') ? 2 : 0);
      EXPECT_EQ(carets.find('^'), mark_column) << text;
      EXPECT_EQ(line.find("…") != std::string::npos, before + 1 + after > 100) << text;
    }
  }
}

TEST(Diagnostics, NotesAndContextPointAtFurtherPlaces) {
  Place place("let a = 1\nlet a = 2\n", "a");
  Diagnostics diagnostics;
  diagnostics.push_context(place.span, "included here");
  diagnostics.error({place.span.source, 14, 15}, "'a' is defined twice", {},
                    {{place.span, "the first is here"}});
  diagnostics.pop_context();
  diagnostics.error({place.span.source, 16, 17}, "another");
  const std::string text = render_text(diagnostics, place.sources, false);
  EXPECT_NE(text.find("scene.tyn:2:5: error: 'a' is defined twice\n"), std::string::npos) << text;
  EXPECT_NE(text.find("scene.tyn:1:5: note: the first is here\n    1 | let a = 1\n      |     ^\n"
                      "scene.tyn:1:5: note: included here\n"),
            std::string::npos)
      << text;
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_TRUE(diagnostics.all()[1].notes.empty());
}

TEST(Diagnostics, KeepsTwentyErrorsAndCountsTheRest) {
  Place place(std::string(100, 'x'), "x");
  Diagnostics diagnostics;
  EXPECT_FALSE(diagnostics.has_errors());
  for (std::uint32_t i = 0; i < 57; ++i) {
    EXPECT_EQ(diagnostics.full(), i >= 20);
    diagnostics.error({place.span.source, i, i + 1}, "no x");
  }
  EXPECT_EQ(diagnostics.all().size(), 20u);
  EXPECT_EQ(diagnostics.error_count(), 57);
  const std::string text = render_text(diagnostics, place.sources, false);
  EXPECT_TRUE(text.ends_with("… and 37 more errors\n")) << text;
}

TEST(Diagnostics, TheSameMessageAtTheSamePlaceIsOne) {
  Place place("x", "x");
  Diagnostics diagnostics;
  for (int i = 0; i < 3; ++i) diagnostics.error(place.span, "no x");
  diagnostics.warning(place.span, "no x");
  EXPECT_EQ(diagnostics.error_count(), 1);
  EXPECT_EQ(diagnostics.all().size(), 2u);
}

TEST(Diagnostics, WarningsAreNoErrors) {
  Diagnostics diagnostics;
  diagnostics.warning({}, "unused");
  EXPECT_FALSE(diagnostics.has_errors());
  EXPECT_EQ(render_text(diagnostics, Sources(), false), "warning: unused\n");
}

TEST(Diagnostics, ErrorsAreShownInTheOrderOfTheText) {
  Place place("ab", "a");
  Diagnostics diagnostics;
  diagnostics.error({place.span.source, 1, 2}, "second");
  diagnostics.error({place.span.source, 0, 1}, "first");
  const std::string text = render_text(diagnostics, place.sources, false);
  EXPECT_LT(text.find("first"), text.find("second"));
}

TEST(Nearest, FindsWhatWasMeant) {
  const std::vector<std::string_view> known = {"density",  "albedo",       "scattering", "absorption",
                                               "emission", "phase",        "center",     "position",
                                               "rotate_x", "light_samples"};
  const std::pair<std::string_view, std::string_view> expected[] = {
      {"desnity", "density"},             // two letters swapped
      {"albeedo", "albedo"},              // one too many
      {"phas", "phase"},                  // one too few
      {"centre", "center"},               //
      {"Density", "density"},             // another case
      {"ABSORPTION", "absorption"},       //
      {"rotateX", "rotate_x"},            //
      {"lightSamples", "light_samples"},  //
      {"pos", "position"},                // the beginning of a longer word
      {"zebra", ""},                      // nothing like it
      {"x", ""},                          //
      {"", ""},                           //
      {"density", ""},                    // the word itself is no suggestion
  };
  for (const auto& [word, meant] : expected) EXPECT_EQ(nearest(word, known), meant) << word;
  EXPECT_EQ(nearest(std::string(1000000, 'a'), known), "");
}

TEST(Nearest, PrefersTheSmallerDistance) {
  EXPECT_EQ(nearest("shere", {"share", "sphere", "where"}), "share");
  EXPECT_EQ(nearest("spere", {"share", "sphere", "spear"}), "sphere");
  EXPECT_EQ(did_you_mean("spere", {"sphere"}), "did you mean 'sphere'?");
  EXPECT_EQ(did_you_mean("cube", {"sphere"}), "");
}

// Words of up to three letters are all alike: there only a slip of the hand is a mistyped word.
TEST(Nearest, DoesNotTakeShortWordsForEachOther) {
  const std::vector<std::string_view> known = {"sin", "min", "max", "abs", "pow",  "log",
                                               "exp", "mod", "tan", "mix", "dot",  "pi",
                                               "p",   "n",   "uv",  "hg",  "step", "fov"};
  for (const char* word :
       {"mie", "sign", "i",   "e",   "x",   "h",   "sun",  "fog", "rgb", "dog", "box", "max1", "ex",
        "hue", "u",    "hit", "pie", "mid", "sky", "tank", "lot", "mad", "it",  "an",  "of"})
    EXPECT_EQ(nearest(word, known), "") << word;
  const std::pair<std::string_view, std::string_view> slips[] = {
      {"sni", "sin"}, {"sinn", "sin"}, {"SIN", "sin"}, {"mxa", "max"},   {"ppi", "pi"},    {"PI", "pi"},
      {"pp", "p"},    {"abbs", "abs"}, {"gh", "hg"},   {"setp", "step"}, {"stpe", "step"}, {"sttep", "step"}};
  for (const auto& [word, meant] : slips) EXPECT_EQ(nearest(word, known), meant) << word;
}

// Longer words that share letters by chance.
TEST(Nearest, TakesOneLetterInThreeAtMost) {
  const std::vector<std::string_view> known = {"sphere", "focus", "floor",   "noise",
                                               "point",  "power", "distant", "quad"};
  for (const char* word : {"torus", "color", "round", "world", "mouse", "constant", "area", "while"})
    EXPECT_EQ(nearest(word, known), "") << word;
  const std::pair<std::string_view, std::string_view> mistyped[] = {
      {"shpere", "sphere"}, {"spheer", "sphere"}, {"focsu", "focus"},     {"flor", "floor"},
      {"nosie", "noise"},   {"piont", "point"},   {"distand", "distant"}, {"qaud", "quad"}};
  for (const auto& [word, meant] : mistyped) EXPECT_EQ(nearest(word, known), meant) << word;
}

TEST(DidYouMean, PrefersTheWordWithOneKeyStuck) {
  EXPECT_EQ(nearest("pp", {"up", "p"}), "p");
  EXPECT_EQ(nearest("patchh", {"patchy", "patch"}), "patch");
  EXPECT_EQ(nearest("lenght", {"length", "weight"}), "length");
}

}  // namespace
}  // namespace tyndall
