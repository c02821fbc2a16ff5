// Mistakes of grammar: where they are told, what is said, and that one mistake is one error.
#include <gtest/gtest.h>

#include "reading.h"

namespace tyndall::syntax {
namespace UNNAMED {

std::string brief(const std::string& text) { return Reading(text).brief(); }

TEST(Mistakes, ColonAndEqualsMixedUp) {
  EXPECT_EQ(brief("let a: 3"),
            "1:6 a name is defined with '=' [write a = value; ':' gives a value to a parameter]\n");
  EXPECT_EQ(brief("def f(a: 3) = a"), "1:8 a default is given with '=' [write a = value]\n");
  EXPECT_EQ(brief("let b = f(a = 3)"),
            "1:13 an argument is given with ':' [write a: value; '=' defines or sets a name]\n");
  EXPECT_EQ(
      brief("medium m() { density: 3 }"),
      "1:21 'density' is set with '=' here [write density = value; ':' gives a value to a parameter]\n");
  EXPECT_EQ(brief("sphere { material = m }"), "1:19 a parameter is given with ':' [write material: value]\n");
  EXPECT_EQ(brief("radius: 3"),
            "1:7 'radius:' gives a value to a parameter, and nothing here has one [to define a name write "
            "let radius = value]\n");
}

TEST(Mistakes, MissingCommas) {
  EXPECT_EQ(brief("let a = (1 2, 3)"),
            "1:12 a ',' is missing before '2' [values in '( )' are parted by commas]\n");
  EXPECT_EQ(brief("let a = fbm(p octaves: 3)"),
            "1:15 a ',' is missing before 'octaves' [values in '( )' are parted by commas]\n");
  EXPECT_EQ(brief("let a = [(1, 2) (3, 4)]"),
            "1:17 a ',' is missing before '(' [values in '[ ]' are parted by commas]\n");
  EXPECT_EQ(brief("let a = [0s [1, 2]]"),
            "1:13 an index is one value, here are 2 [if a list is meant, a ',' is missing before '[']\n");
  EXPECT_EQ(brief("let a = (1,, 2)"), "1:12 a value is missing before this ','\n");
}

TEST(Mistakes, CommasTooMany) {
  EXPECT_EQ(brief("let a = 1, let b = 2"),
            "1:10 no ',' is needed here [commas may part 'name: value' pairs only]\n");
}

TEST(Mistakes, BracketsNameTheirOpeningPlace) {
  Reading paren("sphere { center: (0, 1, 0  radius: 5cm }\nbox { }");
  EXPECT_EQ(paren.errors(),
            "scene.tyn:1:28: error: expected ',' or ')' before 'radius'\n"
            "    1 | sphere { center: (0, 1, 0  radius: 5cm }\n"
            "      |                            ^~~~~~\n"
            "      = help: '(' is not closed\n"
            "scene.tyn:1:18: note: the '(' is here\n"
            "    1 | sphere { center: (0, 1, 0  radius: 5cm }\n"
            "      |                  ^\n");
  EXPECT_EQ(brief("let a = (1, 2]"), "1:14 expected ')' to close '('\n");
  EXPECT_EQ(brief("group {\n  sphere { }\n"),
            "1:7 this '{' is never closed [a '}' is missing, here or in a block inside]\n");
  EXPECT_EQ(brief("sphere { } }\nbox { }"), "1:12 '}' closes nothing\n");
  EXPECT_EQ(brief("let a = 1)"), "1:10 ')' closes nothing\n");
  EXPECT_EQ(
      brief("sphere radius: 1 }"),
      "1:8 expected '{' after 'sphere', found 'radius' [parameters stand in braces: { name: value }]\n");
}

TEST(Mistakes, IndentationTellsTheMissingBrace) {
  Reading r("group {\n  sphere {\n    radius: 1\n  box { }\n}\nbox { }\n");
  ASSERT_EQ(r.diagnostics.all().size(), 1u);
  ASSERT_EQ(r.diagnostics.all()[0].notes.size(), 1u);
  EXPECT_EQ(r.sources[r.tree.source].locate(r.diagnostics.all()[0].notes[0].span.begin).line, 2u);
}

TEST(Mistakes, ItemsBeginWithAWord) {
  EXPECT_EQ(brief("let a = 3 4"), "1:9 one value belongs here [write (3, 4)]\n");
  EXPECT_EQ(brief("* 3"), "1:1 expected a statement, found '*' [statements begin with a word]\n");
  EXPECT_EQ(brief("else { }"), "1:1 'else' without 'if' [it follows the '}' of an 'if']\n");
  EXPECT_EQ(brief("f(x) = x"),
            "1:6 expected a statement, found '=' [a function or template is defined with def f(…)]\n");
  EXPECT_EQ(
      brief("foo"),
      "1:1 'foo' does nothing here: expected '{', '(', ':' or '=' after it, found the end of the file\n");
  EXPECT_EQ(brief("f(x).y"), "1:1 this value is not used [give it a name with 'let']\n");
}

TEST(Mistakes, ReservedWordsAreNoNames) {
  EXPECT_EQ(brief("let in = 3"), "1:5 'in' is a reserved word and cannot be a name\n");
  EXPECT_EQ(brief("let a = then"), "1:9 expected a value, found the reserved word 'then'\n");
  EXPECT_EQ(brief("then = 3"), "1:1 'then' is a reserved word and cannot be set\n");
}

TEST(Mistakes, Expressions) {
  EXPECT_EQ(brief("let a = 1 < 2 < 3"), "1:15 comparisons cannot be chained [write a < b and b < c]\n");
  EXPECT_EQ(brief("let a = <1, 2, -3>"), "1:9 a vec is written in parentheses [write (x, y, z)]\n");
  EXPECT_EQ(brief("let a = ()"), "1:9 there is no value in these parentheses\n");
  EXPECT_EQ(brief("let a = (1, 2, 3, 4)"),
            "1:9 4 values in parentheses: a pair has 2, a vec 3 [a list is written in square brackets]\n");
  EXPECT_EQ(brief("let a = 1 + if b then c else d"),
            "1:13 'if' inside an operation needs parentheses [write a + (if b then c else d)]\n");
  EXPECT_EQ(brief("let a = if b { c } else d"),
            "1:14 expected 'then', found '{' [a choice of values is written: if a then b else c]\n");
  EXPECT_EQ(brief("let a = if b then c let d = 1"),
            "1:21 expected 'else', found 'let' [a choice of values is written: if a then b else c]\n");
  EXPECT_EQ(brief("let a = f(b: 1, 2)"),
            "1:17 a positional argument after a named one [positional arguments come first]\n");
  EXPECT_EQ(brief("let a = \"{}\""), "1:11 expected a value, found the rest of a string\n");
  EXPECT_EQ(brief("let a = \"{b c}d\" let e = 1"),
            "1:13 expected '}' after the value in a string, found 'c'\n");
}

TEST(Mistakes, Headers) {
  EXPECT_EQ(brief("for i on 0..3 { let a = 1 }"),
            "1:7 expected 'in', found 'on' [a loop is written: for i in 0..<10 { … }]\n");
  EXPECT_EQ(brief("for (i in 0..3) { }"),
            "1:5 expected a name after 'for', found '(' [a loop is written: for i in 0..<10 { … }]\n");
  EXPECT_EQ(brief("if a then { }"), "1:6 no 'then' in a statement [write if condition { … } else { … }]\n");
  EXPECT_EQ(brief("volume { medium { density = 1 } }"),
            "1:17 a medium that is defined needs a name [write medium name() { … }; as a parameter, medium: "
            "{ … }]\n");
}

TEST(Mistakes, SeveralAreToldInOneRunWithoutFollowers) {
  EXPECT_EQ(brief("let a = )\n"
                  "sphere { radius: * center: (1, ], 2) }\n"
                  "let b = (1, 2\n"
                  "medium m( { density = 1 }\n"
                  "for i in { let c = }\n"
                  "box { }\n"),
            "1:9 expected a value, found ')'\n"
            "2:18 expected a value, found '*'\n"
            "2:32 expected a value, found ']'\n"
            "4:1 expected ',' or ')' before 'medium' ['(' is not closed]\n"
            "4:11 expected the name of a parameter, found '{'\n"
            "5:10 expected a value, found '{'\n"
            "5:20 expected a value, found '}'\n");
}

TEST(Mistakes, WhatWasReadBesidesThemIsInTheTree) {
  EXPECT_EQ(Reading("let a = )\nsphere { radius: * center: 1 }\nlet b = 2").printed(),
            "(file\n  (let a <error>)\n  (thing sphere\n    (parameter radius <error>)\n    (parameter "
            "center 1))\n  (let b 2))\n");
}

}  // namespace
}  // namespace tyndall::syntax
