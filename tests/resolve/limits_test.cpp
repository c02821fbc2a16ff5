// Each limit of the language: a scene that just keeps it is read, one beyond it is refused with one error
// that says so.
#include "resolve/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <vector>

#include "resolved.h"
#include "support/filled.h"
#include "support/test_folder.h"

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

using support::filled;
using support::numbered;
using support::repeated;

// A text that meets the number `n` of something limited; files that it includes are made in `folder`.
using Maker = std::function<std::string(std::int64_t n, const fs::path& folder)>;

std::string file_of_size(std::int64_t n, const fs::path& folder) {
  std::ofstream(folder / "large.tyn") << "// ";
  fs::resize_file(folder / "large.tyn", static_cast<std::uintmax_t>(n));  // sparse: zeros, in a comment
  return "include \"large.tyn\"";
}

std::string includes(std::int64_t n, const fs::path& folder) {
  for (std::int64_t i = 0; i < n; ++i)
    std::ofstream(folder / fmt::format("f{}.tyn", i))
        << (i + 1 < n ? fmt::format("include \"f{}.tyn\"", i + 1) : "");
  return "include \"f0.tyn\"";
}

// Blocks within blocks, in calls of templates that each hold a few.
std::string blocks(std::int64_t n, const fs::path&) {
  constexpr std::int64_t each = 100;
  std::string text;
  std::int64_t left = n - 1;  // the file is one
  text += "def t0() { }\n";
  --left;
  for (std::int64_t i = 1; left > 0; ++i) {
    const std::int64_t groups = std::min(each, left) - 1;
    text += filled("def t$I() { $OPEN t$BEFORE() $CLOSE }\n", {{"I", i},
                                                               {"BEFORE", i - 1},
                                                               {"OPEN", repeated("group { ", groups)},
                                                               {"CLOSE", repeated("} ", groups)}});
    left -= groups + 1;
    if (left == 0) text += fmt::format("t{}()\n", i);
  }
  return text;
}

std::string calls(std::int64_t n, const fs::path&) {
  return filled(R"(
def f1(x) = x
$OTHERS
let _a = f$LAST(1)
)",
                {{"OTHERS", numbered("def f$I(x) = f$BEFORE(x)\n", n, 2)}, {"LAST", n}});
}

// One value that takes n calls: of one function, which calls another twice a round.
std::string many_calls(std::int64_t n, const fs::path&) {
  std::string loops;
  for (std::int64_t pairs = (n - 1) / 2; pairs > 0; pairs -= eval::max_loop_iterations)
    loops += filled("for i in 1..$LAST { s = s + g(i) + g(i) }\n",
                    {{"LAST", std::min<std::int64_t>(pairs, eval::max_loop_iterations)}});
  return filled(R"(
def g(x) = x
def f() = {
  var s = 0
  $LOOPS
  $REST
  return s
}
let _a = f()
)",
                {{"LOOPS", loops}, {"REST", (n - 1) % 2 ? "s = s + g(1)" : ""}});
}

// As many rounds as `n` in loops of at most `each`, which stand for `$LOOPS`.
// One value for which lists are made with n entries in all.
std::string many_lists(std::int64_t n, const fs::path&) {
  std::string lists;
  for (; n > 0; n -= eval::max_list_entries)
    lists +=
        filled("a = [i for i in 1..$LAST]\n", {{"LAST", std::min<std::int64_t>(n, eval::max_list_entries)}});
  return filled(R"(
def f() = {
  var a = [0]
  $LISTS
  return length(a)
}
let _a = f()
)",
                {{"LISTS", lists}});
}

// Lists in many statements, with n entries in all: a long one is doubled, once for each million.
std::string lists_of_a_scene(std::int64_t n, const fs::path&) {
  std::string lists = "let a = [i for i in 1..500000]\nvar b = a\n";
  n -= 500'000;
  for (; n >= eval::max_list_entries; n -= eval::max_list_entries) lists += "b = a + a\n";
  return lists + "let _b = b\n" + filled("let _rest = [i for i in 1..$N]", {{"N", n}});
}

Maker many_loops(std::int64_t each, std::string_view form) {
  return [each, form](std::int64_t n, const fs::path&) {
    std::string loops;
    for (std::int64_t left = n; left > 0; left -= std::min(left, each))
      loops += filled("for _i in 1..$LAST { s = s + 1 }\n", {{"LAST", std::min(left, each)}});
    return filled(form, {{"LOOPS", loops}});
  };
}

// Objects of two each, and of them what makes `n` things in all.
std::string placed_things(std::int64_t n, const fs::path&) {
  std::string text = "object o0 { sphere { } }\n", places;
  std::vector<std::int64_t> brings{1};
  while (2 * brings.back() + 1 <= n) {
    text += filled("object o$I { place o$BEFORE { } place o$BEFORE { } }\n",
                   {{"I", brings.size()}, {"BEFORE", brings.size() - 1}});
    brings.push_back(2 * brings.back() + 1);
  }
  for (std::size_t i = brings.size(); i-- > 0;)
    for (; brings[i] <= n; n -= brings[i]) places += filled("place o$I { }\n", {{"I", i}});
  return text + places;
}

// Of objects with a thousand each, and what is left by itself.
std::string volumes(std::int64_t n, const fs::path&) {
  return filled(
      R"(
medium m() { density = 1 albedo = 1 }
object a { for _i in 1..1000 { volume { in: sphere { } medium: m } } }
for _i in 1..$THOUSANDS { place a { } }
$REST
)",
      {{"THOUSANDS", n / 1000}, {"REST", repeated("volume { in: sphere { } medium: m }\n", n % 1000)}});
}

std::string nested_lists(std::int64_t n, const fs::path&) {
  return filled(R"(
let l1 = [0]
$OTHERS
let _l = [l$LAST]
)",
                {{"OTHERS", numbered("let l$I = [l$BEFORE]\n", n - 1, 2)}, {"LAST", n - 1}});
}

// The number itself, less what the text meets besides, for `$N`.
Maker number_in(std::string_view form, std::int64_t besides = 0) {
  return [=](std::int64_t n, const fs::path&) { return filled(form, {{"N", n - besides}}); };
}

// As many of `each`, less what the text meets besides, for `$ALL`.
Maker many_in(std::string_view form, std::string_view each, std::int64_t besides = 0) {
  return [=](std::int64_t n, const fs::path&) {
    return filled(form, {{"ALL", repeated(each, n - besides)}});
  };
}

// The block of the file is no level; the value in the innermost parentheses is one.
std::string parentheses(std::int64_t n, const fs::path&) {
  return filled("let _a = $OPEN 1 $CLOSE", {{"OPEN", repeated("(", n - 1)}, {"CLOSE", repeated(")", n - 1)}});
}

const std::map<std::string_view, Maker>& makers() {
  static const std::map<std::string_view, Maker> table{
      {"file size", file_of_size},
      {"name length", many_in("let _$ALL = 1", "a", 1)},
      {"nesting", parentheses},
      {"list length", many_in("let _a = [$ALL]", "0,")},
      {"include depth", includes},
      {"template depth", number_in("def t(i) { if i < $N { t(i + 1) } } t(1)")},
      {"block depth", blocks},
      {"repetitions", number_in("for _i in 1..$N { }")},
      {"placed things", placed_things},
      // One of them is the sky of all texts.
      {"lights",
       number_in("object a { light point { position: (0, 1, 0) power: 1 } } for _i in 1..$N { place a { } }",
                 1)},
      {"volumes", volumes},
      {"objects", number_in("for _i in 1..$N { object o { sphere { } } place o { } }")},
      {"strings", many_in("let _a = [$ALL]", "\"\",")},
      {"string length", many_in("let _a = \"$ALL\"", "a")},
      {"list depth", nested_lists},
      {"light samples", number_in("render { light_samples: $N }")},
      {"combined parts", number_in("union { for _i in 1..$N { sphere { } } }")},
      {"combination depth",
       [](std::int64_t n, const fs::path&) {
         return filled("$OPEN sphere { } $CLOSE",
                       {{"OPEN", repeated("union { ", n)}, {"CLOSE", repeated("} ", n)}});
       }},
      {"call depth", calls},
      {"function calls", many_calls},
      {"made list", number_in("let _a = [i for i in 1..$N]")},
      {"made lists in all", many_lists},
      {"made lists of a scene", lists_of_a_scene},
      {"function rounds",
       number_in("def f() = { var s = 0 for i in 1..$N { s = s + i } return s } let _a = f()")},
      {"function rounds in all", many_loops(eval::max_loop_iterations, R"(
def f() = {
  var s = 0
  $LOOPS
  return s
}
let _a = f()
)")},
      {"body rounds",
       number_in("medium _m() { var s = 0 for i in 1..$N { s = s + 1 } density = s albedo = 1 }")},
      {"body rounds in all", many_loops(eval::max_unrolled_iterations, R"(
medium _m() {
  var s = 0
  $LOOPS
  density = s
  albedo = 1
}
)")},
      {"outline points", number_in("lathe { profile: [(1, i) for i in 1..$N] segments: 3 }")},
      {"facets",
       [](std::int64_t n, const fs::path&) {
         return filled("lathe { profile: [(1, i) for i in 0..1000] segments: $N }",
                       {{"N", (n + 999) / 1000}});
       }},
      {"octaves", number_in("let _a = fbm((1, 2, 3), octaves: $N)")},
  };
  return table;
}

class Limits : public testing::TestWithParam<resolve::Limit> {};

TEST_P(Limits, AreMetAndNotPassed) {
  const resolve::Limit& limit = GetParam();
  const auto maker = makers().find(limit.name);
  ASSERT_NE(maker, makers().end()) << "no test meets the limit of " << limit.name;
  for (const bool beyond : {false, true}) {
    const fs::path folder = test_folder() / "limits";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const std::string text = camera_and_light + maker->second(limit.value + (beyond ? 1 : 0), folder);
    const Resolved r = resolve_text(text, {}, (folder / "main.tyn").string());
    fs::remove_all(folder);
    if (limit.name == "file size") {  // zeros are no text, but the file was read
      ASSERT_EQ(r.diagnostics.error_count(), 1);
      EXPECT_EQ(r.diagnostics.all()[0].message.find("it is larger than 256 MB") != std::string::npos, beyond)
          << r.diagnostics.all()[0].message;
      continue;
    }
    ASSERT_EQ(r.diagnostics.error_count(), beyond ? 1 : 0)
        << limit.name << (beyond ? " passed\n" : " met\n") << r.messages().substr(0, 2000);
    if (!beyond) continue;
    // The message names the number, or the number that was too large.
    const std::string said = r.diagnostics.all()[0].message + r.diagnostics.all()[0].help;
    EXPECT_TRUE(said.find(std::to_string(limit.value)) != std::string::npos) << said;
  }
}

// Some are met elsewhere: how deep evaluation goes depends on what is evaluated (tests/eval/error_test.cpp),
// how many errors are shown is no limit of scenes (tests/base/diagnostics_test.cpp), and as many words as a
// file may have, or pictures and grids, take a gigabyte (tests/syntax/lexer_test.cpp,
// tests/image/windows_test.cpp).
std::vector<resolve::Limit> limits_of_scenes() {
  constexpr std::string_view elsewhere[] = {"evaluation depth", "errors shown", "words",
                                            "pictures",         "grids",        "curve points"};
  std::vector<resolve::Limit> list;
  for (const resolve::Limit& limit : resolve::limits())
    if (std::find(std::begin(elsewhere), std::end(elsewhere), limit.name) == std::end(elsewhere))
      list.push_back(limit);
  return list;
}

INSTANTIATE_TEST_SUITE_P(Language, Limits, testing::ValuesIn(limits_of_scenes()), [](const auto& row) {
  std::string name(row.param.name);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST(Floods, ObjectsThatDoubleAreCountedBeforeTheyAreWrittenOut) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"sphere { }", "more than 10000000 things placed by objects"},
      {"volume { in: sphere { } medium: { density = 1 albedo = 1 } }",
       "more than 1000000 volumes in a scene"},
      {"light point { position: (0, 0, 0) power: 1 }", "more than 1000000 lights in a scene"}};
  for (const auto& [in, message] : cases) {
    const std::string text =
        filled(R"(
object o0 { $IN }
$OTHERS
place o60 { }
)",
               {{"IN", std::string(in)},
                {"OTHERS", numbered("object o$I { place o$BEFORE { } place o$BEFORE { } }\n", 60)}});
    const Resolved r = resolve_text(camera_and_light + text);
    ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
    const Diagnostic& d = r.diagnostics.all()[0];
    EXPECT_EQ(d.message, message);
    EXPECT_TRUE(r.sources.text(d.span).size() == 3) << r.messages();
  }
}

// Calls and rounds that the text alone multiplies are told before the first one is run, at the outermost.
TEST(Floods, CallsThatDoubleAreCountedBeforeTheyAreRun) {
  const std::string_view places[] = {
      "sphere { }", "volume { in: sphere { } medium: { density = 1 albedo = 1 } }",
      "light point { position: (0, 0, 0) power: 1 }", "object o { sphere { } } place o { }", ""};
  const std::string_view doubles[] = {
      "def t$I() { t$BEFORE() t$BEFORE() }\n",
      "def t$I() { for _i in 0..<2 { t$BEFORE() } }\n",
      "def t$I() { for _i in [1, 2] { t$BEFORE() } }\n",
      "def t$I() { group { t$BEFORE() } if 1 < 2 { t$BEFORE() } else { t$BEFORE() } }\n",
  };
  for (const std::string_view in : places)
    for (const std::string_view form : doubles) {
      const std::string text = filled(R"(
def t0() { $IN }
$OTHERS
t30()
)",
                                      {{"IN", std::string(in)}, {"OTHERS", numbered(form, 30)}});
      const Resolved r = resolve_text(camera_and_light + text);
      ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
      const Diagnostic& d = r.diagnostics.all()[0];
      EXPECT_EQ(d.message, "more than 10000000 rounds of loops and calls of templates, and facets of shapes");
      EXPECT_EQ(r.sources.text(d.span), "t30()");
      EXPECT_TRUE(r.scene.shapes.empty() && r.scene.volumes.empty() && r.scene.prototypes.empty());
    }
  const std::string million = filled(R"(
def t0() { sphere { } }
$OTHERS
for _i in 0..<10 { t20() }
)",
                                     {{"OTHERS", numbered("def t$I() { t$BEFORE() t$BEFORE() }\n", 20)}});
  const Resolved r = resolve_text(camera_and_light + million);
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_EQ(r.sources.text(r.diagnostics.all()[0].span), "0..<10");
  EXPECT_TRUE(r.scene.shapes.empty());
}

// Only what is sure to run is foreseen: conditions, and names that mean something else inside.
TEST(Floods, CallsThatAreNotRunDoNotCount) {
  const std::string doubled = "def t0() { }\n" + numbered("def t$I() { t$BEFORE() t$BEFORE() }\n", 30);
  for (const std::string_view body :
       {"if 1 > 2 { t30() }", "for _i in [] { t30() }", "for _i in 0..<0 { t30() }",
        "for _i in 5..2 { t30() }", "def t30() { } t30()"})
    resolve_clean(filled(R"(
$DOUBLED
light point { position: (0, 1, 0) power: 1 }
def _u() { $BODY }
_u()
)",
                         {{"DOUBLED", doubled}, {"BODY", std::string(body)}}));
  resolve_clean(doubled + "def u(t30) { t30() } u(t0)");
}

// What holds itself many times over is gone through once, whatever is done with it.
TEST(Floods, ListsOfListsCostWhatTheyAreWrittenWith) {
  const std::string doubled = numbered(
      "let a$I = [a$BEFORE, a$BEFORE, a$BEFORE, a$BEFORE, a$BEFORE, a$BEFORE, a$BEFORE, a$BEFORE]\n", 100);
  const std::string in_bodies =
      "material m() { base_color = 0.1 * length(a100) }\nsphere { material: m() }\n";
  resolve_clean("let a0 = [1]\n" + doubled + in_bodies);
  resolve_clean("def a0(x) = x\n" + doubled + in_bodies);
  const Resolved r = resolve_text(camera_and_light + "let a0 = [1]\n" + doubled + "let _s = \"{a100}\"\n");
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_EQ(r.diagnostics.all()[0].message, "a string of more than 65536 bytes");
}

TEST(Floods, StringsThatGrowTenfold) {
  const std::string text =
      filled(R"(let s0 = "xxxxxxxxxx"
$OTHERS
let _a = s12
)",
             {{"OTHERS", numbered(R"(let s$I = "{s$BEFORE}{s$BEFORE}{s$BEFORE}{s$BEFORE}{s$BEFORE}{s$BEFORE}"
)",
                                  12)}});
  const Resolved r = resolve_text(camera_and_light + text);
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_EQ(r.diagnostics.all()[0].message, "a string of more than 65536 bytes");
  EXPECT_EQ(r.sources[r.diagnostics.all()[0].span.source].locate(r.diagnostics.all()[0].span.begin).line, 7u);
}

TEST(Floods, StrandsOfTheSamePointsAreCountedBeforeTheyAreCopied) {
  const std::string text =
      filled(R"(
let a = [$POINTS]
curves { points: [$LISTS] radius: 1 }
)",
             {{"POINTS", repeated("(0, 0, 0), ", 10'000)}, {"LISTS", repeated("a, ", 10'000)}});
  const Resolved r = resolve_text(camera_and_light + text);
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages().substr(0, 1000);
  EXPECT_EQ(r.diagnostics.all()[0].message, "more than 10000000 points of curves");
}

}  // namespace UNNAMED
}  // namespace tyndall
