// Expressions of scene code and the values they have, as strings print them.
#include <gtest/gtest.h>

#include "run.h"

namespace tyndall::eval {
namespace UNNAMED {

struct Row {
  const char* expression;
  const char* text;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.expression; }

class Expression : public testing::TestWithParam<Row> {};

TEST_P(Expression, HasTheValue) {
  SceneText run(std::string("let result = ") + GetParam().expression, 0.5, 12);
  const Value value = run.scene();
  EXPECT_EQ(run.all_messages(), "");
  EXPECT_EQ(text_of(value), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(Arithmetic, Expression,
                         testing::Values(Row{"1 + 2 * 3", "7"}, Row{"(1 + 2) * 3", "9"}, Row{"-2^2", "-4"},
                                         Row{"2^3^2", "512"}, Row{"2^-1", "0.5"}, Row{"10 - 4 - 3", "3"},
                                         Row{"24 / 4 / 2", "3"}, Row{"1 -2", "-1"},
                                         Row{"0.1 + 0.2", "0.30000000000000004"}, Row{"1e3", "1000"},
                                         Row{".5", "0.5"}, Row{"50%", "0.5"}, Row{"2cm", "0.02"},
                                         Row{"1km + 1m", "1001"}, Row{"-0", "0"},
                                         Row{"1/3", "0.3333333333333333"}, Row{"time", "0.5"},
                                         Row{"frame", "12"}, Row{"pi > 3.14159 and pi < 3.1416", "true"}));

INSTANTIATE_TEST_SUITE_P(Vectors, Expression,
                         testing::Values(Row{"(1, 2) + (3, 4)", "(4, 6)"}, Row{"(1, 2, 3) * 2", "(2, 4, 6)"},
                                         Row{"2 / (1, 2, 4)", "(2, 1, 0.5)"},
                                         Row{"(1, 2, 3) * (4, 5, 6)", "(4, 10, 18)"},
                                         Row{"(1, 2) - 1", "(0, 1)"}, Row{"-(1, -2, 3)", "(-1, 2, -3)"},
                                         Row{"(2, 3, 4) ^ 2", "(4, 9, 16)"}, Row{"(1, 2, 3).x", "1"},
                                         Row{"(1, 2, 3).zyx", "(3, 2, 1)"}, Row{"(1, 2, 3).bg", "(3, 2)"},
                                         Row{"(1, 2).yyx", "(2, 2, 1)"}, Row{"(1, 2, 3).xz.y", "3"},
                                         Row{"#fff", "(1, 1, 1)"}, Row{"#ff0000", "(1, 0, 0)"},
                                         Row{"(1, 2, 3) == (1, 2, 3)", "true"},
                                         Row{"(1, 2) != (1, 3)", "true"}, Row{"(1, 2) == (1, 3)", "false"}));

INSTANTIATE_TEST_SUITE_P(Logic, Expression,
                         testing::Values(Row{"1 < 2", "true"}, Row{"2 <= 2", "true"}, Row{"1 > 2", "false"},
                                         Row{"2 >= 3", "false"}, Row{"1 == 1", "true"},
                                         Row{"1 != 1", "false"}, Row{"not 1 < 2", "false"},
                                         Row{"true and false", "false"}, Row{"true or false", "true"},
                                         Row{"not true or true", "true"}, Row{"false and 1 / 0 > 1", "false"},
                                         Row{"true or 1 / 0 > 1", "true"}, Row{"if 1 < 2 then 3 else 4", "3"},
                                         Row{"if 1 > 2 then 1 / 0 else 4", "4"},
                                         Row{"if false then 1 else if true then 2 else 3", "2"},
                                         Row{"\"a\" == \"a\"", "true"}, Row{"\"a\" != \"a\"", "false"},
                                         Row{"true == false", "false"}));

INSTANTIATE_TEST_SUITE_P(
    Lists, Expression,
    testing::Values(
        Row{"[i * i for i in 0..<4]", "[0, 1, 4, 9]"}, Row{"[i for i in 0..<0]", "[]"},
        Row{"[s for s in [\"a\", \"b\"]]", "[a, b]"}, Row{"[i for i in 0..9 if i > 6]", "[7, 8, 9]"},
        Row{"[(a, b) for a in 0..1 for b in 0..2]", "[(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2)]"},
        Row{"[10 * a + b for a in 1..3 if a != 2 for b in a..3 if b > 1]", "[12, 13, 33]"},
        Row{"[[i for i in 0..<n] for n in 1..3]", "[[0], [0, 1], [0, 1, 2]]"},
        Row{"[if i < 1 then -1 else i for i in 0..2]", "[-1, 1, 2]"}, Row{"[1, 2] + [3]", "[1, 2, 3]"},
        Row{"[] + []", "[]"}, Row{"append([1], [2])", "[1, [2]]"}, Row{"append([], 3)", "[3]"},
        Row{"sum([1, 2, 3])", "6"}, Row{"sum([])", "0"}, Row{"sum([(1, 2), (3, 4)])", "(4, 6)"},
        Row{"sum([30deg, 60deg])", "90deg"}, Row{"min([3, 1, 2])", "1"}, Row{"max([3])", "3"},
        Row{"max([(1, 5), (3, 2)])", "(3, 5)"}, Row{"max([1, (0, 2)])", "(1, 2)"},
        Row{"min([90deg, 30deg])", "30deg"}, Row{"sort([3, 1, 2])", "[1, 2, 3]"},
        Row{"sort([\"b\", \"a\", \"aa\"])", "[a, aa, b]"}, Row{"sort([])", "[]"},
        Row{"keys(0.5, [[0, 10], [1, 20]])", "15"}, Row{"keys(2, points: [0, 1, 3], values: [0, 4, 8])", "6"},
        Row{"keys(0.5, [[i, i * i] for i in 0..3])", "0.5"},
        Row{"length([i for i in 1..100000 if mod(i, 2) == 0])", "50000"}));

INSTANTIATE_TEST_SUITE_P(Formats, Expression,
                         testing::Values(Row{"\"{1 / 3:.2}\"", "0.33"}, Row{"\"{7:03}\"", "007"},
                                         Row{"\"{1.5:06.2}\"", "001.50"}, Row{"\"{-2:04}\"", "-002"},
                                         Row{"\"{12345:03}\"", "12345"},
                                         Row{"\"{(1, 2.25):.1}\"", "(1.0, 2.2)"},
                                         Row{"\"{45deg:.1}\"", "45.0deg"},
                                         Row{"\"a{1:02}b{2:.1}c\"", "a01b2.0c"}, Row{"\"{0.5:.0}\"", "0"},
                                         Row{"\"{-0.4:.0}\"", "0"}, Row{"\"{-0.04:.1}\"", "0.0"}));

// language.md "Values": angle ± angle, angle × or ÷ number, -angle and min max mix clamp abs mod keys of
// angles are angles; angle ÷ angle, and an angle meeting a number under + - ==, are numbers in radians.
INSTANTIATE_TEST_SUITE_P(
    Angles, Expression,
    testing::Values(Row{"30deg + 60deg", "90deg"}, Row{"90deg - 30deg", "60deg"}, Row{"2 * 45deg", "90deg"},
                    Row{"45deg * 2", "90deg"}, Row{"90deg / 2", "45deg"}, Row{"-90deg", "-90deg"},
                    Row{"90deg / 30deg == 3 or abs(90deg / 30deg - 3) < 0.000001", "true"},
                    Row{"1rad / 1rad", "1"}, Row{"1rad + 1", "2"}, Row{"1 - 3rad", "-2"},
                    Row{"1rad == 1", "true"}, Row{"2 != 2rad", "false"}, Row{"90deg < 100deg", "true"},
                    Row{"min(30deg, 60deg)", "30deg"}, Row{"max(30deg, 60deg)", "60deg"},
                    Row{"mix(0deg, 90deg, 0.5)", "45deg"}, Row{"clamp(100deg, 0deg, 90deg)", "90deg"},
                    Row{"abs(-30deg)", "30deg"}, Row{"mod(370deg, 360deg)", "10deg"},
                    Row{"keys(0.5, [0, 0deg], [1, 90deg])", "45deg"}, Row{"sin(90deg)", "1"},
                    Row{"sin(0 * 1)", "0"}, Row{"cos(0deg)", "1"}, Row{"atan2(1, 1)", "45deg"},
                    Row{"asin(1)", "90deg"}, Row{"acos(0) + atan(1)", "135deg"},
                    Row{"if true then 90deg else 0deg", "90deg"}));

INSTANTIATE_TEST_SUITE_P(
    BuiltIns, Expression,
    testing::Values(
        Row{"mod(-1, 3)", "2"}, Row{"mod(1, -3)", "-2"}, Row{"floor(-1.5)", "-2"},
        Row{"ceil((1.2, -1.2))", "(2, -1)"}, Row{"fract(2.25)", "0.25"}, Row{"clamp(5, 0, 1)", "1"},
        Row{"mix((0, 0, 0), (1, 2, 3), 0.5)", "(0.5, 1, 1.5)"}, Row{"min((1, 5), 3)", "(1, 3)"},
        Row{"step(0.5, 0.7)", "1"}, Row{"smoothstep(1, 0, 0.5)", "0.5"}, Row{"smoothstep(0, 1, 2)", "1"},
        Row{"remap(5, 0, 10, 20, 40)", "30"}, Row{"sqrt(16)", "4"}, Row{"pow(2, 10)", "1024"},
        Row{"exp(0)", "1"}, Row{"log(1)", "0"}, Row{"length((3, 4))", "5"}, Row{"length((1, 2, 2))", "3"},
        Row{"length([1, 2, 3])", "3"}, Row{"distance((1, 1), (4, 5))", "5"},
        Row{"dot((1, 2, 3), (4, 5, 6))", "32"}, Row{"cross((1, 0, 0), (0, 1, 0))", "(0, 0, 1)"},
        Row{"normalize((0, 3, 4))", "(0, 0.6, 0.8)"}, Row{"reflect((1, -1, 0), (0, 1, 0))", "(1, 1, 0)"},
        Row{"checker((0.5, 0.5)) == checker((1.5, 1.5))", "true"},
        Row{"checker((0.5, 0.5)) == checker((1.5, 0.5))", "false"}, Row{"sd_sphere((0, 3, 0), 1)", "2"},
        Row{"sd_box((3, 0, 0), (1, 1, 1))", "2"}, Row{"sd_box((0, 0, 0), 1)", "-1"},
        Row{"sd_torus((3, 0, 0), 2, 0.5)", "0.5"},
        Row{"sd_capsule((2, 0.5, 0), (0, 0, 0), (0, 1, 0), 0.5)", "1.5"},
        Row{"sd_cylinder((2, 0.5, 0), (0, 0, 0), (0, 1, 0), 0.5)", "1.5"},
        Row{"sd_cylinder((0, 0.25, 0), (0, 0, 0), (0, 1, 0), 0.5)", "-0.25"},
        Row{"sd_cone((0, 3, 0), (0, 0, 0), (0, 1, 0), 0.5)", "2"},
        Row{"sd_cone((0, -1, 0), (0, 0, 0), (0, 1, 0), 0.5, 0.25)", "1"},
        Row{"sd_ellipsoid((4, 0, 0), (2, 1, 1))", "2"}, Row{"sd_ellipsoid((0, 0, 0), (2, 1, 4))", "-1"},
        Row{"sd_plane((5, 3, 7), (0, 2, 0), 1)", "2"}, Row{"smooth_max(1, 5, 0.5)", "5"},
        Row{"smooth_max(1, 1, 1)", "1.25"}, Row{"smooth_subtract(1, -1, 1)", "1.25"},
        Row{"smooth_subtract(-2, 8, 0)", "-2"}, Row{"hsv(0deg, 1, 1)", "(1, 0, 0)"},
        Row{"hsv(480deg, 1, 1)", "(0, 1, 0)"}, Row{"hsv(77deg, 0, 1)", "(1, 1, 1)"},
        Row{"sd_capsule((2, 0, 0), (0, 0, 0), (0, 0, 0), 0.5)", "1.5"}, Row{"smooth_union(1, 5, 0.5)", "1"},
        Row{"smooth_union(1, 1, 1)", "0.75"}, Row{"random(3) == random(3)", "true"},
        Row{"random(3) == random(4)", "false"},
        Row{"random((1, 2, 3), 4, 5) == random(1, 2, 3, 4, 5)", "true"},
        Row{"abs(luminance(blackbody(3200K)) - 1) < 0.001", "true"},
        Row{"fbm((1, 2, 3), octaves: 4) == fbm(p: (1, 2, 3), octaves: 4, seed: 0)", "true"},
        Row{"fbm((1.5, 2.2, 3), octaves: 4) == fbm((1.5, 2.2, 3), octaves: 4, seed: 1)", "false"},
        Row{"noise((1.5, 2.2, 3)) == noise((1.5, 2.2, 3), time: 0.3)", "false"}));

INSTANTIATE_TEST_SUITE_P(ListsRangesStrings, Expression,
                         testing::Values(Row{"[1, 2, 3][1]", "2"}, Row{"[[1, 2], [3]][1][0]", "3"},
                                         Row{"[1, (2, 3), 4deg]", "[1, (2, 3), 4deg]"},
                                         Row{"\"leaf{3}.png\"", "leaf3.png"}, Row{"\"{0.5}\"", "0.5"},
                                         Row{"\"{1 / 4} of {10 / 2}\"", "0.25 of 5"},
                                         Row{"\"{(1, 2)} {true} {90deg}\"", "(1, 2) true 90deg"},
                                         Row{"\"{\"in\"}side\"", "inside"}));

INSTANTIATE_TEST_SUITE_P(
    Transforms, Expression,
    testing::Values(
        Row{"translate((1, 2, 3)) * (1, 1, 1)", "(2, 3, 4)"}, Row{"scale(2) * (1, 2, 3)", "(2, 4, 6)"},
        Row{"scale((1, 2, 3)) * (1, 1, 1)", "(1, 2, 3)"},
        Row{"translate((1, 0, 0)) * scale(2) * (1, 1, 1)", "(3, 2, 2)"},
        Row{"direction(translate((1, 0, 0)) * scale(2), (1, 1, 1))", "(2, 2, 2)"},
        Row{"distance(rotate_y(90deg) * (0, 0, 1), (1, 0, 0)) < 0.000001", "true"},
        Row{"distance(rotate_x(90deg) * (0, 1, 0), (0, 0, 1)) < 0.000001", "true"},
        Row{"distance(rotate_z(90deg) * (1, 0, 0), (0, 1, 0)) < 0.000001", "true"},
        Row{"distance(rotate_y((1, 2, 3), 40deg), rotate_y(40deg) * (1, 2, 3)) < 0.000001", "true"},
        Row{"distance(rotate_x((1, 2, 3), 40deg), rotate_x(40deg) * (1, 2, 3)) < 0.000001", "true"},
        Row{"distance(rotate_z((1, 2, 3), 40deg), rotate((0, 0, 2), 40deg) * (1, 2, 3)) < 0.000001", "true"},
        Row{"distance(look_at((0, 1, 6), (0, 1, 0)) * (0, 0, -6), (0, 1, 0)) < 0.000001", "true"},
        Row{"matrix((1, 0, 0), (0, 2, 0), (0, 0, 3), (4, 5, 6)) * (1, 1, 1)", "(5, 7, 9)"}));

// Linear passage, rest outside, and a turn the short way at a steady rate.
INSTANTIATE_TEST_SUITE_P(
    Keys, Expression,
    testing::Values(
        Row{"keys(0.25, [0, 0], [1, 4])", "1"}, Row{"keys(-1, [0, 3], [1, 4])", "3"},
        Row{"keys(9, [0, 3], [1, 4])", "4"}, Row{"keys(1.5, [0, 0], [1, 4], [2, 0])", "2"},
        Row{"keys(0.5, [0, 0], [1, 4], ease: smooth)", "2"},
        Row{"keys(0.25, [0, 0], [1, 4], ease: smooth)", "0.625"},
        Row{"keys(0.99, [0, 0], [1, 4], ease: hold)", "0"}, Row{"keys(1, [0, 0], [1, 4], ease: hold)", "4"},
        Row{"keys(0.5, [0, (0, 0, 0)], [1, (1, 2, 3)])", "(0.5, 1, 1.5)"},
        Row{"keys(0.5, [0, 1], [1, (1, 2, 3)])", "(1, 1.5, 2)"}, Row{"keys(time, [0s, 0], [1s, 4])", "2"},
        Row{"keys(0.5, [0, translate((0, 0, 0))], [1, translate((2, 0, 0))]) * (1, 0, 0)", "(2, 0, 0)"},
        Row{"distance(keys(0.5, [0, rotate_y(0deg)], [1, rotate_y(90deg)]) * (0, 0, 1), "
            "rotate_y(45deg) * (0, 0, 1)) < 0.000001",
            "true"},
        Row{"distance(keys(0.25, [0, rotate_y(10deg)], [1, rotate_y(330deg)]) * (0, 0, 1), "
            "rotate_y(0deg) * (0, 0, 1)) < 0.000001",
            "true"},
        Row{"distance(keys(0.5, [0, scale(1)], [1, scale(3) * rotate_x(90deg)]) * (0, 0, 1), "
            "2 * (rotate_x(45deg) * (0, 0, 1))) < 0.000001",
            "true"}));

// Definitions with several steps: the file is evaluated, the let named result compared.
class Definitions : public testing::TestWithParam<Row> {};

TEST_P(Definitions, GiveTheValue) {
  SceneText run(GetParam().expression, 0.5);
  const Value value = run.scene();
  EXPECT_EQ(run.all_messages(), "");
  EXPECT_EQ(text_of(value), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Functions, Definitions,
    testing::Values(
        Row{"let a = 2 let result = a * a", "4"}, Row{"def f(x) = x * x let result = f(3)", "9"},
        Row{"def f(x, y = x + 1) = x * y let result = [f(3), f(3, 2), f(y: 5, x: 1)]", "[12, 6, 5]"},
        Row{"def f(x) = { var s = 0 for i in 0..<4 { s = s + x^i } return s } let result = f(2)", "15"},
        Row{"def f(x) = { if x > 1 { return 10 } return 20 } let result = [f(2), f(0)]", "[10, 20]"},
        Row{"def f(x) = { var a = 1 if x { a = 2 } else { a = 3 } return a } let result = [f(true), "
            "f(false)]",
            "[2, 3]"},
        Row{"def f(x) = { for v in x { if v > 2 { return v } } return 0 } let result = f([1, 3, 5])", "3"},
        Row{"def twice(f, x) = f(f(x)) def inc(x) = x + 1 let result = twice(inc, 3)", "5"},
        Row{"def f() = time * 2 let result = f()", "1"}, Row{"def p(p) = p * 2 let result = p(3)", "6"},
        Row{"def f(x) = { def g(y) = x + y return g(1) } let result = f(5)", "6"},
        Row{"let noise = 3 let result = noise * 2", "6"}, Row{"let pi = 3 let result = pi", "3"},
        Row{"def f(v) = v + 1 let result = [f(1), f((1, 2)), f((1, 2, 3))]", "[2, (2, 3), (2, 3, 4)]"},
        Row{"def f(a) = { var n = 0 for i in a { n = n + 1 } return n } let result = "
            "[f(0..4), f(0..<4), f(5..1), f(5..1..-2), f(0..1..0.1), f(0..<1..0.1), f([7, 8])]",
            "[5, 4, 0, 3, 11, 10, 2]"},
        Row{"var a = 1 def f() = a let result = f()", "1"},
        Row{"def f() = { var l = [1, 2, 3]  l[1] = 5  return l } let result = f()", "[1, 5, 3]"},
        Row{"def f() = { var l = [1, 2]  let m = l  l[0] = 9  return [l, m] } let result = f()",
            "[[9, 2], [1, 2]]"},
        Row{"def f(c) = { var l = [0, 0]  if c { l[0] = 1 } else { l[1] = 2 }  return l } "
            "let result = [f(true), f(false)]",
            "[[1, 0], [0, 2]]"},
        Row{"def f() = { var l = [1]  l[0] = [2]  l[0] = l  return l } let result = f()", "[[[2]]]"},
        Row{"def primes(n) = { var is = [true for i in 0..n]  for i in 2..n { if is[i] { "
            "for k in i * i..n..i { is[k] = false } } }  return [i for i in 2..n if is[i]] } "
            "let result = primes(30)",
            "[2, 3, 5, 7, 11, 13, 17, 19, 23, 29]"},
        Row{"let c = (1, 2, 3) let result = \"{c.bgr}\"", "(3, 2, 1)"}));

// A sum as long as the parser reads.
TEST(Depth, LongSumsAreFine) {
  std::string text = "let result = 1";
  for (int i = 0; i < 200; ++i) text += "+1";
  SceneText run(text);
  ASSERT_TRUE(run.parsed);
  EXPECT_EQ(run.scene().as_number(), 201);
}

TEST(Seeds, AreWholeNumbers) {
  for (const char* seed : {"0", "4294967295", "17"}) {
    SceneText run(std::string("let result = noise((0.5, 0.3, 0.1), seed: ") + seed + ")");
    EXPECT_EQ(run.scene().type, Type::number);
    EXPECT_EQ(run.all_messages(), "");
  }
}

// Random numbers fill [0, 1) evenly: the mean of n has the standard error 1/sqrt(12 n); 4.5 of it, seed
// fixed.
TEST(Random, IsEvenlyDistributed) {
  SceneText run(
      "def f(n) = { var s = 0 for i in 0..<n { s = s + random(i, 7) } return s / n } let result = f(40000)");
  EXPECT_NEAR(run.scene().as_number(), 0.5, 4.5 / std::sqrt(12 * 40000.0));
}

}  // namespace UNNAMED
}  // namespace tyndall::eval
