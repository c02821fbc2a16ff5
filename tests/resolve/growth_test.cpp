// Reading a scene takes time in proportion to its text, whatever there is much of. Judged by how the time of
// the processor grows from a text to one of sixteen times as much: 16-fold when it is linear, 256-fold when
// it is quadratic; what is above the middle of the two, on the scale of factors, fails.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <functional>

#include "resolved.h"

namespace tyndall {
namespace {

// `n` times a text; `{0}` in it is the number, `{1}` the one before.
std::string times(int n, std::string_view form) {
  std::string text;
  for (int i = 1; i <= n; ++i) fmt::format_to(std::back_inserter(text), fmt::runtime(form), i, i - 1);
  return text;
}

struct Kind {
  std::string_view name;
  int few;  // of the smaller text
  std::function<std::string(int)> text;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> table{
      {"names", 2000, [](int n) { return times(n, "let a{0} = 1 sphere {{ radius: a{0} }}\n"); }},
      {"unused_names", 4000, [](int n) { return times(n, "let a{0} = 1\n"); }},
      {"names_of_names", 4000, [](int n) { return "let a0 = 1\n" + times(n, "let a{0} = a{1} + a0\n"); }},
      {"variables", 4000, [](int n) { return times(n, "var a{0} = 1 a{0} = a{0} + 1\n"); }},
      {"functions", 2000, [](int n) { return times(n, "def f{0}(x) = x let _a{0} = f{0}(1)\n"); }},
      {"templates", 2000,
       [](int n) { return times(n, "def t{0}(r) {{ sphere {{ radius: r }} }} t{0}(1)\n"); }},
      {"objects", 2000, [](int n) { return times(n, "object o{0} {{ sphere {{ }} }} place o{0} {{ }}\n"); }},
      {"objects_that_see_variables", 1000,
       [](int n) {
         return times(n, "var a{0} = 1\n") +
                times(n, "object o{0} {{ sphere {{ radius: a{0} }} }} place o{0} {{ }}\n");
       }},
      {"media", 500,
       [](int n) {
         return times(
             n,
             "medium m{0}() {{ density = {0} albedo = 1 }} volume {{ in: sphere {{ }} medium: m{0}() }}\n");
       }},
      {"materials", 500,
       [](int n) {
         return times(n, "material m{0}() {{ base_color = 0.5 }} sphere {{ material: m{0}() }}\n");
       }},
      {"bodies_that_see_a_long_list", 500,
       [](int n) {
         return "let l = [" + times(n, "{0}, ") + "]\n" +
                times(n, "material m{0}() {{ base_color = 0 * l[0] }} sphere {{ material: m{0}() }}\n");
       }},
      {"a_body_that_sees_many_names", 1000,
       [](int n) {
         return times(n, "let a{0} = 1\n") + "material m() { var s = 0\n" + times(n, "s = s + a{0}\n") +
                "base_color = 0 * s }\nsphere { material: m() }\n";
       }},
      {"names_in_an_object", 4000,
       [](int n) { return "object _o { " + times(n, "let a{0} = 1 sphere {{ radius: a{0} }}\n") + "}\n"; }},
      {"names_in_a_function", 4000,
       [](int n) {
         return "def f() = { " + times(n, "let a{0} = 1 let _b{0} = a{0}\n") + "return 1 }\nlet _f = f()\n";
       }},
      {"parameters", 2000,
       [](int n) {
         return "def f(" + times(n, "p{0},") + ") = 1\nlet _a = f(" + times(n, "p{0}: 1,") + ")\n";
       }},
      {"long_lists", 8000, [](int n) { return "let _l = [" + times(n, "[{0}, 0], ") + "]\n"; }},
      {"long_sums", 8000, [](int n) { return "let _s = [" + times(n, "{0} + {0} * 2, ") + "]\n"; }},
      {"blocks_passed_over", 1000,
       [](int n) { return times(n, "group {{ let a = 1 if false {{ sphere {{ radius: a }} }} }}\n"); }},
      {"names_within_groups", 1000,
       [](int n) {
         return times(n, "let a{0} = 1\n") + "group { group { group {\n" +
                times(n, "group {{ let b = a{0} sphere {{ radius: b }} }}\n") + "} } }\n";
       }},
      {"uses_of_an_unknown_name", 2000,
       [](int n) { return times(n, "if true {{ sphere {{ radius: nothing }} }}\n"); }},
      {"unknown_names", 2000,
       [](int n) { return "def f() = { " + times(n, "let _b{0} = a{0}\n") + "return 1 }\n"; }},
      {"wrong_statements", 2000, [](int n) { return times(n, "sphere {{ raduis: 1 }}\n"); }},
      {"doubled_names", 2000, [](int n) { return times(n, "let a = 1\n"); }},
      {"parameters_that_are_none", 2000, [](int n) { return "sphere { " + times(n, "x{0}: 1\n") + "}\n"; }},
  };
  return table;
}

double seconds_of(const std::string& text) {
  const std::clock_t begin = std::clock();
  resolve_text(camera_and_light + text);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

class Growth : public testing::TestWithParam<Kind> {};

TEST_P(Growth, IsThatOfTheText) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "instrumented code takes minutes, and its time says nothing about the program's";
#endif
  constexpr double most = 64;
  constexpr int tries = 3;  // another process may have taken the caches
  const std::string small = GetParam().text(GetParam().few), large = GetParam().text(16 * GetParam().few);
  double growth = 0;
  for (int i = 0; i < tries; ++i) {
    double of_small = seconds_of(small);
    for (int k = 0; k < 2; ++k) of_small = std::max(of_small, seconds_of(small));
    growth = seconds_of(large) / std::max(of_small, 1e-4);
    if (growth < most) return;
  }
  EXPECT_LT(growth, most);
}

INSTANTIATE_TEST_SUITE_P(Language, Growth, testing::ValuesIn(kinds()),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace tyndall
