// Mistakes, and what is said of them: the place, the message, the way out.
#include <gtest/gtest.h>

#include "run.h"
#include "support/filled.h"

namespace tyndall::eval {
namespace UNNAMED {

struct Mistake {
  const char* text;
  const char* place;     // the text that the error underlines
  const char* fragment;  // of "message | help"
};

void PrintTo(const Mistake& row, std::ostream* out) { *out << row.text; }

class Error : public testing::TestWithParam<Mistake> {};

TEST_P(Error, IsReportedOnceAtItsPlace) {
  SceneText run(GetParam().text);
  ASSERT_TRUE(run.parsed) << run.all_messages();
  run.scene();
  EXPECT_EQ(run.diagnostics.error_count(), 1) << run.all_messages();
  EXPECT_NE(run.first_error().find(GetParam().fragment), std::string::npos) << run.all_messages();
  EXPECT_EQ(run.first_error_text(), GetParam().place) << run.all_messages();
}

INSTANTIATE_TEST_SUITE_P(
    Names, Error,
    testing::Values(Mistake{"let radius = 1 let result = raduis * 2", "raduis", "did you mean 'radius'"},
                    Mistake{"let result = nosie((1, 2, 3))", "nosie", "did you mean 'noise'"},
                    Mistake{"let result = p.x", "p", "known only inside a medium or material"},
                    Mistake{"let result = sin", "sin", "'sin' is a function"},
                    Mistake{"let a = 1 let a = 2", "a", "defined twice"},
                    Mistake{"let time = 1", "time", "cannot be redefined"},
                    Mistake{"def f(frame) = 1", "frame", "cannot be redefined"},
                    Mistake{"def f(a, a) = 1", "a", "defined twice"},
                    Mistake{"medium m(p = 1) { albedo = 1 }", "p", "cannot be redefined"},
                    Mistake{"def f(x) = x + p", "p", "a function does not see 'p'"},
                    Mistake{"def f(x) = x + lenght(x)", "lenght", "did you mean 'length'"},
                    Mistake{"def f(x) = f(x - 1)", "f", "may not use itself"},
                    Mistake{"medium m() { albedo = 1 density = uv.x }", "uv", "a medium has no 'uv'"},
                    Mistake{"medium m() { albedo = colr }", "colr", "nothing is named 'colr'"},
                    Mistake{"let result = if true then 1 else wrong", "wrong", "nothing is named"},
                    Mistake{"let result = false and wrong", "wrong", "nothing is named"}));

INSTANTIATE_TEST_SUITE_P(
    Types, Error,
    testing::Values(Mistake{"let result = rotate_y(40)", "40", "40deg"},
                    Mistake{"let result = 1 + true", "1 + true", "'+' of a number and true or false"},
                    Mistake{"let result = (1, 2) + (1, 2, 3)", "(1, 2) + (1, 2, 3)", "'+' of a pair"},
                    Mistake{"let result = \"a\" + 1", "\"a\" + 1", "braces"},
                    Mistake{"let result = 45deg * 45deg", "45deg * 45deg", "1rad"},
                    Mistake{"let result = 1 / 45deg", "1 / 45deg", "1rad"},
                    Mistake{"let result = 45deg * (1, 2, 3)", "45deg * (1, 2, 3)", "'*' of an angle"},
                    Mistake{"let result = 1m + 2s", "1m + 2s", "a length and a time"},
                    Mistake{"let result = 1m < 2s", "1m < 2s", "a length and a time"},
                    Mistake{"let result = sqrt(45deg)", "45deg", "'x' of sqrt wants a number"},
                    Mistake{"let result = min(1, 45deg)", "45deg", "'b' of min wants"},
                    Mistake{"let result = min(45deg, 1)", "1", "wants an angle"},
                    Mistake{"let result = if 1 then 2 else 3", "1", "'if' wants true or false"},
                    Mistake{"let result = 1 and true", "1", "'and' wants true or false"},
                    Mistake{"let result = not 1", "not 1", "'not' wants"},
                    Mistake{"let result = (1, 2) < (3, 4)", "(1, 2) < (3, 4)", "'<' of a pair"},
                    Mistake{"let result = -true", "-true", "'-' wants"},
                    Mistake{"let result = (1, true)", "true", "a component wants a number"},
                    Mistake{"let result = (1, 45deg, 2)", "45deg", "divide by 1rad"},
                    Mistake{"let result = translate(1)", "1", "write all three"},
                    Mistake{"let result = dot((1, 2), (1, 2, 3))", "(1, 2, 3)", "wants a pair"},
                    Mistake{"let result = cross((1, 2), (3, 4, 5))", "(1, 2)", "wants a vec"},
                    Mistake{"let result = scale(1) * 2", "scale(1) * 2", "a transform"},
                    Mistake{"let result = \"{scale(1)}\"", "scale(1)", "cannot be written into a string"},
                    Mistake{"let result = blackbody(3m)", "3m", "3200K"}));

INSTANTIATE_TEST_SUITE_P(MembersAndElements, Error,
                         testing::Values(Mistake{"let result = (1, 2).z", "z", "components are x, y"},
                                         Mistake{"let result = (1, 2, 3).xq", "xq", "no component 'q'"},
                                         Mistake{"let result = (1, 2, 3).xyzx", "xyzx", "4 letters"},
                                         Mistake{"let a = 5 let result = a.x", "x", "a number has no 'x'"},
                                         Mistake{"let result = [1, 2][2]", "2", "indices run from 0 to 1"},
                                         Mistake{"let result = [1, 2][-1]", "-1", "index -1"},
                                         Mistake{"let result = [1, 2][0.5]", "0.5", "whole number"},
                                         Mistake{"let result = [][0]", "0", "the list is empty"},
                                         Mistake{"let a = 5 let result = a[0]", "a",
                                                 "only a list has elements"}));

INSTANTIATE_TEST_SUITE_P(
    Calls, Error,
    testing::Values(
        Mistake{"let a = 2 let result = a(3)", "a", "is a number, not a function"},
        Mistake{"def f(x) = x let result = f()", "f()", "'f' wants 'x'"},
        Mistake{"def f(x) = x let result = f(1, 2)", "2", "too many arguments"},
        Mistake{"def f(x) = x let result = f(y: 1)", "y", "'f' has no parameter 'y'"},
        Mistake{"def f(radius) = radius let result = f(raduis: 1)", "raduis", "did you mean 'radius'"},
        Mistake{"def f(x) = x let result = f(1, x: 2)", "x", "given twice"},
        Mistake{"let result = sin()", "sin()", "'sin' wants 'angle'"},
        Mistake{"let result = sin(30)", "30", "'angle' of sin wants an angle, found a number"},
        Mistake{"let result = cos(-30)", "-30", "cos(-30deg) or cos(-30rad)"},
        Mistake{"let result = tan((0))", "(0)", "tan(0deg)"},
        Mistake{"let result = sin(2m)", "2m", "wants an angle, found a length"},
        Mistake{"let result = sin(1, 2)", "2", "too many arguments"},
        Mistake{"let result = fbm((1, 2, 3), octavs: 2)", "octavs", "did you mean 'octaves'"},
        Mistake{"let result = fbm((1, 2, 3), octaves: 2.5)", "2.5", "whole number"},
        Mistake{"let result = fbm((1, 2, 3), octaves: 100)", "100", "1..32"},
        Mistake{"let result = noise(1)", "1", "'p' of noise wants a vec"},
        Mistake{"let result = random()", "random()", "wants an argument"},
        Mistake{"let result = keys(1)", "keys(1)", "at least one key"},
        Mistake{"let result = keys(0, [0, 1], [0, 2])", "[0, 2]", "must rise"},
        Mistake{"let result = keys(0, [0, 1], [1, 2], ease: soft)", "soft", "linear, smooth or hold"},
        Mistake{"let result = keys(0, [0, 1], 2)", "2", "write [0s, a]"},
        Mistake{"let result = hg(1)", "1", "[-0.9999, 0.9999]"},
        Mistake{"let result = mix(hg(0.1), hg(0.2), 2)", "2", "[0, 1]"},
        Mistake{"let result = rotate_y((1, 2, 3), 4, 5)", "rotate_y((1, 2, 3), 4, 5)", "3 arguments"},
        Mistake{"let result = rotate((0, 0, 0), 40deg)", "(0, 0, 0)", "length 0"},
        Mistake{"let result = look_at((0, 0, 0), (0, 0, 0))", "look_at((0, 0, 0), (0, 0, 0))", "same point"},
        Mistake{"def f(g) = g(g) let result = f(f)", "g(g)", "calls itself"},
        Mistake{"def t(x) { sphere { radius: x } } let result = t(1)", "t(1)", "places things"},
        Mistake{"medium m(a) { albedo = a } let result = m(b: 1)", "b", "no parameter 'b'"}));

INSTANTIATE_TEST_SUITE_P(
    NoValue, Error,
    testing::Values(Mistake{"let result = 1 / 0", "0", "division by zero"},
                    Mistake{"let a = 0 let result = 2 + 1 / a", "a", "division by zero"},
                    Mistake{"let result = (1, 2, 3) / (1, 0, 1)", "(1, 0, 1)", "division by zero"},
                    Mistake{"let result = sqrt(-1)", "sqrt(-1)", "not a number"},
                    Mistake{"let result = log(0)", "log(0)", "infinite"},
                    Mistake{"let result = 10^400", "10^400", "infinite"},
                    Mistake{"let result = (-8)^0.5", "(-8)^0.5", "not a number"},
                    Mistake{"let result = normalize((0, 0, 0))", "(0, 0, 0)", "no direction"},
                    Mistake{"let result = remap(1, 2, 2, 0, 1)", "remap(1, 2, 2, 0, 1)", "no width"},
                    Mistake{"let result = mod(1, 0)", "mod(1, 0)", "not a number"}));

INSTANTIATE_TEST_SUITE_P(
    Steps, Error,
    testing::Values(
        Mistake{"def f() = { let a = 1 a = 2 return a } let result = f()", "a", "define it with var"},
        Mistake{"def f() = { b = 2 return b } let result = 1", "b", "nothing is named 'b'"},
        Mistake{"def f() = { let _a = 1 } let result = f()", "f", "ends without a value"},
        Mistake{"def f() = { var a = 1 a = true return a } let result = f()", "a",
                "a variable keeps its kind"},
        Mistake{"var a = 1 def f() = { a = 2 return a } let result = f()", "a", "its own variables"},
        Mistake{"def f(n) = { for i in n { return i } return 0 } let result = f(3)", "n",
                "wants a range or a list"},
        Mistake{"def f() = { for i in 0..1000000 { let _a = i } return 0 } let result = f()", "0..1000000",
                "at most 100000 rounds"},
        Mistake{
            "def f() = { for _i in 0..9999 { for _j in 0..9999 { let _a = 1 } } return 0 } let result = f()",
            "0..9999", "more than 1000000 rounds"},
        Mistake{"def f() = { sphere { radius: 1 } return 0 } let result = f()", "sphere { radius: 1 }",
                "only computes"},
        Mistake{"let result = 0..1..0", "0", "the step of a range is 0"}));

// A mistake inside a function names the calls that led there, innermost first.
TEST(Notes, NameTheChainOfCalls) {
  SceneText run("def f(x) = 1 / x\ndef g(x) = f(x) + 1\nlet result = g(0)");
  run.scene();
  ASSERT_EQ(run.diagnostics.all().size(), 1u);
  const auto& notes = run.diagnostics.all()[0].notes;
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].message, "in this call of 'f'");
  EXPECT_EQ(run.sources.text(notes[0].span), "f(x)");
  EXPECT_EQ(notes[1].message, "in this call of 'g'");
  EXPECT_EQ(run.sources.text(notes[1].span), "g(0)");
}

// What was complained of once is silent where it is used.
TEST(Poison, IsSilent) {
  SceneText run(
      "let a = wrong let b = a + 1 let c = [b, 2] let d = sin(b) + (b, 1, 2).x def f(x) = x * a let result = "
      "f(1) + c[0] + d");
  run.scene();
  EXPECT_EQ(run.diagnostics.error_count(), 1) << run.all_messages();
}

// As deep as the language lets expressions and calls be: an answer or an error, never an overflow of the
// stack.
TEST(Depth, IsLimited) {
  std::string functions = "def f0(x) = x\n";
  for (int i = 1; i <= 80; ++i)
    functions +=
        support::filled("def f$I(x) = $OPEN f$BEFORE(x) $CLOSE\n", {{"I", i},
                                                                    {"OPEN", support::repeated("-(1+", 100)},
                                                                    {"BEFORE", i - 1},
                                                                    {"CLOSE", support::repeated(")", 100)}});
  SceneText shallow(functions + "let result = f3(1)"), deep(functions + "let result = f80(1)");
  EXPECT_EQ(shallow.scene().type, Type::number) << shallow.all_messages();
  deep.scene();
  EXPECT_NE(deep.first_error().find("nested too deeply"), std::string::npos) << deep.all_messages();
  SceneText calls(support::filled(R"(
def f0(x) = x
$OTHERS
let result = f80(1)
)",
                                  {{"OTHERS", support::numbered("def f$I(x) = f$BEFORE(x)\n", 80)}}));
  calls.scene();
  EXPECT_NE(calls.first_error().find("more than 64 functions"), std::string::npos) << calls.all_messages();
}

TEST(Unused, LetsOfTheMainFileAreWarnedOf) {
  SceneText run("let a = 1 let _b = 2 let c = 3 def f(x) = 1 let result = c");
  run.scene();
  run.scope->find(run.symbols.intern("result"));
  Evaluator(run.context).report_unused(*run.scope);
  ASSERT_EQ(run.diagnostics.all().size(), 2u) << run.all_messages();
  EXPECT_EQ(run.diagnostics.all()[0].message, "'a' is never used");
  EXPECT_EQ(run.diagnostics.all()[1].message, "'f' is never used");
}

}  // namespace UNNAMED
}  // namespace tyndall::eval
