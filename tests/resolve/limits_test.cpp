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

namespace tyndall {
namespace {

namespace fs = std::filesystem;

std::string repeated(std::string_view text, std::int64_t count) {
  std::string out;
  for (std::int64_t i = 0; i < count; ++i) out += text;
  return out;
}

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
    text += fmt::format("def t{}() {{ {}t{}() {}}}\n", i, repeated("group { ", groups), i - 1,
                        repeated("} ", groups));
    left -= groups + 1;
    if (left == 0) text += fmt::format("t{}()\n", i);
  }
  return text;
}

std::string calls(std::int64_t n, const fs::path&) {
  std::string text = "def f1(x) = x\n";
  for (std::int64_t i = 2; i <= n; ++i) text += fmt::format("def f{}(x) = f{}(x)\n", i, i - 1);
  return text + fmt::format("let _a = f{}(1)", n);
}

std::string rounds(std::string_view form, std::int64_t n) { return fmt::format(fmt::runtime(form), n); }

// One value that takes n calls: of one function, which calls another twice a round.
std::string many_calls(std::int64_t n) {
  std::string text = "def g(x) = x  def f() = { var s = 0 ";
  for (std::int64_t pairs = (n - 1) / 2; pairs > 0; pairs -= eval::max_loop_iterations)
    text += fmt::format("for i in 1..{} {{ s = s + g(i) + g(i) }} ",
                        std::min<std::int64_t>(pairs, eval::max_loop_iterations));
  return text + ((n - 1) % 2 ? "s = s + g(1) " : "") + "return s } let _a = f()";
}

// As many rounds as `n` in loops of at most `each`.
std::string many_loops(std::int64_t n, std::int64_t each, const char* form) {
  std::string loops;
  for (std::int64_t left = n; left > 0; left -= std::min(left, each))
    loops += fmt::format("for _i in 1..{} {{ s = s + 1 }} ", std::min(left, each));
  return fmt::format(fmt::runtime(form), loops);
}

// Objects of two each, and of them what makes `n` things in all.
std::string placed_things(std::int64_t n, const fs::path&) {
  std::string text = "object o0 { sphere { } }\n", places;
  std::vector<std::int64_t> brings{1};
  while (2 * brings.back() + 1 <= n) {
    text += fmt::format("object o{0} {{ place o{1} {{ }} place o{1} {{ }} }}\n", brings.size(),
                        brings.size() - 1);
    brings.push_back(2 * brings.back() + 1);
  }
  for (std::size_t i = brings.size(); i-- > 0;)
    for (; brings[i] <= n; n -= brings[i]) places += fmt::format("place o{} {{ }}\n", i);
  return text + places;
}

std::string nested_lists(std::int64_t n, const fs::path&) {
  std::string text = "let l1 = [0]\n";
  for (std::int64_t i = 2; i < n; ++i) text += fmt::format("let l{} = [l{}]\n", i, i - 1);
  return text + fmt::format("let _l = [l{}]\n", n - 1);
}

const std::map<std::string_view, Maker>& makers() {
  static const std::map<std::string_view, Maker> table{
      {"file size", file_of_size},
      {"name length", [](auto n, auto&) { return "let _" + std::string(std::size_t(n - 1), 'a') + " = 1"; }},
      // The block of the file is no level; the value in the innermost parentheses is one.
      {"nesting",
       [](auto n, auto&) { return "let _a = " + repeated("(", n - 1) + "1" + repeated(")", n - 1); }},
      {"list length", [](auto n, auto&) { return "let _a = [" + repeated("0,", n) + "]"; }},
      {"include depth", includes},
      {"template depth",
       [](auto n, auto&) { return fmt::format("def t(i) {{ if i < {} {{ t(i + 1) }} }} t(1)", n); }},
      {"block depth", blocks},
      {"repetitions", [](auto n, auto&) { return fmt::format("for _i in 1..{} {{ }}", n); }},
      {"placed things", placed_things},
      {"placed lights",
       [](auto n, auto&) {
         return fmt::format(
             "object a {{ light point {{ position: (0, 1, 0) power: 1 }} }} for _i in 1..{} {{ place a {{ }} "
             "}}",
             n);
       }},
      {"string length", [](auto n, auto&) { return "let _a = \"" + repeated("a", n) + "\""; }},
      {"list depth", nested_lists},
      {"light samples", [](auto n, auto&) { return fmt::format("render {{ light_samples: {} }}", n); }},
      {"call depth", calls},
      {"function calls", [](auto n, auto&) { return many_calls(n); }},
      {"function rounds",
       [](auto n, auto&) {
         return rounds("def f() = {{ var s = 0 for i in 1..{} {{ s = s + i }} return s }} let _a = f()", n);
       }},
      {"function rounds in all",
       [](auto n, auto&) {
         return many_loops(n, eval::max_loop_iterations, "def f() = {{ var s = 0 {}return s }} let _a = f()");
       }},
      {"body rounds",
       [](auto n, auto&) {
         return rounds("medium _m() {{ var s = 0 for i in 1..{} {{ s = s + 1 }} density = s albedo = 1 }}",
                       n);
       }},
      {"body rounds in all",
       [](auto n, auto&) {
         return many_loops(n, eval::max_unrolled_iterations,
                           "medium _m() {{ var s = 0 {}density = s albedo = 1 }}");
       }},
      {"octaves", [](auto n, auto&) { return fmt::format("let _a = fbm((1, 2, 3), octaves: {})", n); }},
  };
  return table;
}

class Limits : public testing::TestWithParam<resolve::Limit> {};

TEST_P(Limits, AreMetAndNotPassed) {
  const resolve::Limit& limit = GetParam();
  const auto maker = makers().find(limit.name);
  ASSERT_NE(maker, makers().end()) << "no test meets the limit of " << limit.name;
  for (const bool beyond : {false, true}) {
    const fs::path folder = fs::path(testing::TempDir()) / "tyndall_limits";
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
// file may have, or pictures, take a gigabyte (tests/syntax/lexer_test.cpp, tests/image/windows_test.cpp).
std::vector<resolve::Limit> limits_of_scenes() {
  constexpr std::string_view elsewhere[] = {"evaluation depth", "errors told", "words", "pictures",
                                            "curve points"};
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

// `n` lines of a form, each with its number and the one before.
std::string lines(std::string_view form, int n) {
  std::string text;
  for (int i = 1; i <= n; ++i) text += fmt::format(fmt::runtime(form), i, i - 1);
  return text;
}

TEST(Floods, ObjectsThatDoubleAreCountedBeforeTheyAreWrittenOut) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"sphere { }", "more than 10000000 things placed by objects"},
      {"volume { in: sphere { } medium: { density = 1 albedo = 1 } }",
       "more than 10000000 things placed by objects"},
      {"light point { position: (0, 0, 0) power: 1 }", "more than 1000000 lights placed by objects"}};
  for (const auto& [in, message] : cases) {
    const std::string text = fmt::format("object o0 {{ {} }}\n", in) +
                             lines("object o{0} {{ place o{1} {{ }} place o{1} {{ }} }}\n", 60) +
                             "place o60 { }\n";
    const Resolved r = resolve_text(camera_and_light + text);
    ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
    const Diagnostic& d = r.diagnostics.all()[0];
    EXPECT_EQ(d.message, message);
    EXPECT_TRUE(r.sources.text(d.span).size() == 3) << r.messages();
  }
}

// What holds itself many times over is gone through once, whatever is done with it.
TEST(Floods, ListsOfListsCostWhatTheyAreWrittenWith) {
  const std::string doubled = lines("let a{0} = [a{1}, a{1}, a{1}, a{1}, a{1}, a{1}, a{1}, a{1}]\n", 100);
  const std::string in_bodies =
      "material m() { base_color = 0.1 * length(a100) }\nsphere { material: m() }\n";
  resolve_clean("let a0 = [1]\n" + doubled + in_bodies);
  resolve_clean("def a0(x) = x\n" + doubled + in_bodies);
  const Resolved r = resolve_text(camera_and_light + "let a0 = [1]\n" + doubled + "let _s = \"{a100}\"\n");
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_EQ(r.diagnostics.all()[0].message, "a string of more than 65536 bytes");
}

TEST(Floods, StringsThatGrowTenfold) {
  const Resolved r = resolve_text(
      camera_and_light + "let s0 = \"xxxxxxxxxx\"\n" +
      lines("let s{0} = \"{{s{1}}}{{s{1}}}{{s{1}}}{{s{1}}}{{s{1}}}{{s{1}}}\"\n", 12) + "let _a = s12\n");
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_EQ(r.diagnostics.all()[0].message, "a string of more than 65536 bytes");
  EXPECT_EQ(r.sources[r.diagnostics.all()[0].span.source].locate(r.diagnostics.all()[0].span.begin).line, 7u);
}

TEST(Floods, StrandsOfTheSamePointsAreCountedBeforeTheyAreCopied) {
  const Resolved r = resolve_text(camera_and_light + "let a = [" + repeated("(0, 0, 0), ", 10'000) +
                                  "]\ncurves { points: [" + repeated("a, ", 10'000) + "] radius: 1 }\n");
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages().substr(0, 1000);
  EXPECT_EQ(r.diagnostics.all()[0].message, "more than 10000000 points of curves");
}

}  // namespace
}  // namespace tyndall
