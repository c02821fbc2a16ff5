// Reading a scene takes time in proportion to its text, whatever there is much of. Judged by how the time of
// the processor grows from a text to one of sixteen times as much: 16-fold when it is linear, 256-fold when
// it is quadratic; what is above the middle of the two, on the scale of factors, fails.
#include <algorithm>
#include <ctime>
#include <functional>

#include "resolved.h"
#include "support/filled.h"

namespace tyndall {
namespace UNNAMED {

using support::filled;
using support::numbered;

struct Kind {
  std::string_view name;
  int few;  // of the smaller text
  std::function<std::string(int)> text;
};

// A text of which there is nothing but many, each with its number.
std::function<std::string(int)> many(std::string_view form) {
  return [form](int n) { return numbered(form, n); };
}

// A text within which something is there many times: `each`, in place of `$ALL`.
std::function<std::string(int)> with_many(std::string_view each, std::string_view form) {
  return [each, form](int n) { return filled(form, {{"ALL", numbered(each, n)}}); };
}

// The same of two things.
std::function<std::string(int)> with_many(std::string_view each, std::string_view other,
                                          std::string_view form) {
  return [each, other, form](int n) {
    return filled(form, {{"ALL", numbered(each, n)}, {"OTHERS", numbered(other, n)}});
  };
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> table{
      {"names", 2000, many("let a$I = 1 sphere { radius: a$I }\n")},
      {"unused_names", 4000, many("let a$I = 1\n")},
      {"names_of_names", 4000, with_many("let a$I = a$BEFORE + a0\n", "let a0 = 1\n$ALL")},
      {"variables", 4000, many("var a$I = 1 a$I = a$I + 1\n")},
      {"functions", 2000, many("def f$I(x) = x let _a$I = f$I(1)\n")},
      {"templates", 2000, many("def t$I(r) { sphere { radius: r } } t$I(1)\n")},
      {"objects", 2000, many("object o$I { sphere { } } place o$I { }\n")},
      {"objects_that_see_variables", 1000,
       with_many("var a$I = 1\n", "object o$I { sphere { radius: a$I } } place o$I { }\n", "$ALL$OTHERS")},
      {"media", 500,
       many("medium m$I() { density = $I albedo = 1 } volume { in: sphere { } medium: m$I() }\n")},
      {"materials", 500, many("material m$I() { base_color = 0.5 } sphere { material: m$I() }\n")},
      {"bodies_that_see_a_long_list", 500,
       with_many("$I, ", "material m$I() { base_color = 0 * l[0] } sphere { material: m$I() }\n",
                 "let l = [$ALL]\n$OTHERS")},
      {"a_body_that_sees_many_names", 1000, with_many("let a$I = 1\n", "s = s + a$I\n", R"(
$ALL
material m() {
  var s = 0
  $OTHERS
  base_color = 0 * s
}
sphere { material: m() }
)")},
      {"names_in_an_object", 4000, with_many("let a$I = 1 sphere { radius: a$I }\n", "object _o { $ALL }\n")},
      {"names_in_a_function", 4000, with_many("let a$I = 1 let _b$I = a$I\n", R"(
def f() = {
  $ALL
  return 1
}
let _f = f()
)")},
      {"parameters", 2000, with_many("p$I,", "p$I: 1,", R"(
def f($ALL) = 1
let _a = f($OTHERS)
)")},
      {"long_lists", 8000, with_many("[$I, 0], ", "let _l = [$ALL]\n")},
      {"long_sums", 8000, with_many("$I + $I * 2, ", "let _s = [$ALL]\n")},
      {"blocks_passed_over", 1000, many("group { let a = 1 if false { sphere { radius: a } } }\n")},
      {"names_within_groups", 1000,
       with_many("let a$I = 1\n", "group { let b = a$I sphere { radius: b } }\n", R"(
$ALL
group { group { group { $OTHERS } } }
)")},
      {"uses_of_an_unknown_name", 2000, many("if true { sphere { radius: nothing } }\n")},
      {"unknown_names", 2000, with_many("let _b$I = a$I\n", "def f() = { $ALL return 1 }\n")},
      {"wrong_statements", 2000, many("sphere { raduis: 1 }\n")},
      {"doubled_names", 2000, many("let a = 1\n")},
      {"parameters_that_are_none", 2000, with_many("x$I: 1\n", "sphere { $ALL }\n")},
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

}  // namespace UNNAMED
}  // namespace tyndall
