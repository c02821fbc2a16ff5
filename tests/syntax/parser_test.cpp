// What the parser makes of expressions and items: the printed tree is compared.
#include <gtest/gtest.h>

#include "reading.h"

namespace tyndall::syntax {
namespace UNNAMED {

// The printed tree of an expression.
std::string value(const std::string& text) {
  Reading r("let v = " + text);
  EXPECT_EQ(r.errors(), "") << text;
  const std::string printed = r.printed();
  const std::string before = "(file\n  (let v ";
  EXPECT_TRUE(printed.starts_with(before)) << printed;
  EXPECT_EQ(r.tree.list_of_items(r.tree[r.tree.file].items).size(), 1u) << printed;
  return printed.substr(before.size(), printed.size() - before.size() - 3);
}

// The printed items of a text.
std::string items(const std::string& text) {
  Reading r(text);
  EXPECT_EQ(r.errors(), "") << text;
  const std::string printed = r.printed();
  return printed.substr(5, printed.size() - 7);
}

TEST(Parser, Precedence) {
  const std::pair<const char*, const char*> rows[] = {
      {"1 + 2 * 3", "(+ 1 (* 2 3))"},
      {"1 * 2 + 3", "(+ (* 1 2) 3)"},
      {"1 - 2 - 3", "(- (- 1 2) 3)"},
      {"8 / 4 / 2", "(/ (/ 8 4) 2)"},
      {"(1 + 2) * 3", "(* (+ 1 2) 3)"},
      {"1 -2", "(- 1 2)"},
      {"a*-b", "(* a (- b))"},
      {"a - -b", "(- a (- b))"},
      {"-2^2", "(- (^ 2 2))"},
      {"2^3^2", "(^ 2 (^ 3 2))"},
      {"2^-1", "(^ 2 (- 1))"},
      {"2 * i^2", "(* 2 (^ i 2))"},
      {"-f(x).y", "(- (member (call f x) y))"},
      {"-a[1]^2", "(- (^ (index a 1) 2))"},
      {"a < b + 1", "(< a (+ b 1))"},
      {"not a == b", "(not (== a b))"},
      {"not not a", "(not (not a))"},
      {"not a and b or c and not d", "(or (and (not a) b) (and c (not d)))"},
      {"a or b or c", "(or (or a b) c)"},
      {"a != b and c >= d", "(and (!= a b) (>= c d))"},
      {"0..n - 1", "(.. 0 (- n 1))"},
      {"a..<b * 2", "(..< a (* b 2))"},
      {"10..1..-1", "(.. 10 1 (- 1))"},
      {"0..<10..2", "(..< 0 10 2)"},
      {"a..b == c", "(== (.. a b) c)"},
      {"if a then b else c + 1", "(if a b (+ c 1))"},
      {"if a or b then 1 else if c then 2 else 3", "(if (or a b) 1 (if c 2 3))"},
      {"if if a then b else c then 1 else 2", "(if (if a b c) 1 2)"},
      {"1 + (if a then b else c)", "(+ 1 (if a b c))"},
      {"f(1)(2)[3].xy", "(member (index (call (call f 1) 2) 3) xy)"},
      {"b (c)", "(call b c)"},
      {"b [c]", "(index b c)"},
      {"(if a then f else g)(x)", "(call (if a f g) x)"},
  };
  for (const auto& [text, tree] : rows) EXPECT_EQ(value(text), tree) << text;
}

TEST(Parser, Values) {
  const std::pair<const char*, const char*> rows[] = {
      {"(1, 2)", "(tuple 1 2)"},
      {"(1, 2, 3,)", "(tuple 1 2 3)"},
      {"(1)", "1"},
      {"[]", "(list)"},
      {"[1, [2], (3, 4),]", "(list 1 (list 2) (tuple 3 4))"},
      {"true", "true"},
      {"#f80", "#ff8800"},
      {"20ms", "0.02s"},
      {"\"leaf{i}.png\"", "(string \"leaf\" i \".png\")"},
      {"\"{a}{\"{b}\"}\"", "(string \"\" a \"\" (string \"\" b \"\") \"\")"},
      {"\"{f({ x = 1 })}\"", "(string \"\" (call f (thing _\n    (set x 1))) \"\")"},
      {"fbm(p * 2, octaves: 6, in: 3,)", "(call fbm (* p 2) octaves: 6 in: 3)"},
      {"keys(time, [0s, a], [1s, b], ease: smooth)", "(call keys time (list 0s a) (list 1s b) ease: smooth)"},
      {"sphere { radius: 1 }", "(thing sphere\n    (parameter radius 1))"},
      {"gltf \"jar.glb\" { node: \"Milk\" }", "(thing gltf \"jar.glb\"\n    (parameter node \"Milk\"))"},
      {"{ density = 0.1 albedo = 0.9 }", "(thing _\n    (set density 0.1)\n    (set albedo 0.9))"},
  };
  for (const auto& [text, tree] : rows) EXPECT_EQ(value(text), tree) << text;
}

TEST(Parser, AValueEndsAtTheNextWord) {
  EXPECT_EQ(
      items("let a = b let c = d e = f g { h: i j: -k, l: m (n) } o(p) if q { } for r in s { }"),
      "\n  (let a b)\n  (let c d)\n  (set e f)\n  (thing g\n    (parameter h i)\n    (parameter j (- k))\n"
      "    (parameter l (call m n)))\n  (place_call (call o p))\n  (if q)\n  (for r s)");
}

TEST(Parser, BeforeAColonAnyWordIsAName) {
  EXPECT_EQ(items("volume { in: a medium: b if: c for: d true: e let: f }"),
            "\n  (thing volume\n    (parameter in a)\n    (parameter medium b)\n    (parameter if c)\n"
            "    (parameter for d)\n    (parameter true e)\n    (parameter let f))");
}

TEST(Parser, Definitions) {
  EXPECT_EQ(items("def f(a, b = 2,) = a + b"), "\n  (function f (a, b = 2) (+ a b))");
  EXPECT_EQ(items("def f() = { return 1 }"), "\n  (function f ()\n    (return 1))");
  EXPECT_EQ(items("def f() { g() }"), "\n  (template f ()\n    (place_call (call g)))");
  EXPECT_EQ(items("medium f { density = 1 }"), "\n  (medium f ()\n    (set density 1))");
  EXPECT_EQ(items("material f(a = 1) { opacity = a }"), "\n  (material f (a = 1)\n    (set opacity a))");
  EXPECT_EQ(items("object o { box { } } place o { transform: t }"),
            "\n  (object o\n    (thing box))\n  (place o\n    (parameter transform t))");
}

TEST(Parser, TheBraceOfAHeaderOpensTheBody) {
  EXPECT_EQ(items("if a { b() } else if c == d { } else { e() }"),
            "\n  (if a\n    (place_call (call b))\n   else\n    (if (== c d)\n     else\n      (place_call "
            "(call e))))");
  EXPECT_EQ(items("for i in l { x = i }"), "\n  (for i l\n    (set x i))");
  // Inside brackets a thing may stand in a header too.
  EXPECT_EQ(items("if f(sphere { }) { }"), "\n  (if (call f (thing sphere)))");
  EXPECT_EQ(items("for s in [box { }, \"{a {}}\"] { }"),
            "\n  (for s (list (thing box) (string \"\" (thing a) \"\")))");
}

TEST(Parser, SpansCoverWhatWasWritten) {
  Reading r("let a = (b + c) * f(d)  let e = 1");
  const auto& items_read = r.tree.list_of_items(r.tree[r.tree.file].items);
  const auto& let = std::get<LetItem>(r.tree[items_read[0]].node);
  EXPECT_EQ(r.sources.text(r.tree[items_read[0]].span), "let a = (b + c) * f(d)");
  EXPECT_EQ(r.sources.text(r.tree[let.value].span), "(b + c) * f(d)");
  const auto& product = std::get<BinaryExpr>(r.tree[let.value].node);
  EXPECT_EQ(r.sources.text(r.tree[product.left].span), "(b + c)");
  EXPECT_EQ(r.sources.text(r.tree[product.right].span), "f(d)");
}

TEST(Parser, ReadsOneExpressionAlone) {
  const auto read = [](const std::string& text, bool good) {
    Sources sources;
    Diagnostics diagnostics;
    Symbols symbols;
    const SourceId source = sources.add("<command line>", text);
    const TokenList tokens = lex(sources, source, diagnostics);
    const ParsedExpression parsed = parse_expression(sources, source, tokens, symbols, diagnostics);
    EXPECT_TRUE(parsed.expr.valid());
    EXPECT_EQ(print(parsed.tree, symbols), "(file)\n");
    EXPECT_EQ(!diagnostics.has_errors(), good) << text;
  };
  read("1 + 2", true);
  read("(1, 2, 3)", true);
  read("", false);
  read("1 2", false);
  read("a let", false);
}

TEST(Symbols, EqualNamesHaveEqualNumbers) {
  Symbols symbols;
  std::vector<SymbolId> ids;
  for (int i = 0; i < 1000; ++i) ids.push_back(symbols.intern("name" + std::to_string(i)));
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(symbols.intern("name" + std::to_string(i)), ids[static_cast<std::size_t>(i)]);
    EXPECT_EQ(symbols.text(ids[static_cast<std::size_t>(i)]), "name" + std::to_string(i));
  }
}

}  // namespace
}  // namespace tyndall::syntax
