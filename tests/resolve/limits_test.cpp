// Each limit of the language: a scene that just keeps it is read, one beyond it is refused with one error
// that says so.
#include "resolve/limits.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

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

// As many rounds as `n` in loops of at most `each`.
std::string many_loops(std::int64_t n, std::int64_t each, const char* form) {
  std::string loops;
  for (std::int64_t left = n; left > 0; left -= std::min(left, each))
    loops += fmt::format("for _i in 1..{} {{ s = s + 1 }} ", std::min(left, each));
  return fmt::format(fmt::runtime(form), loops);
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
      {"call depth", calls},
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

// Two are met elsewhere: how deep evaluation goes depends on what is evaluated (tests/eval/error_test.cpp),
// and how many errors are shown is no limit of scenes (tests/base/diagnostics_test.cpp).
std::vector<resolve::Limit> limits_of_scenes() {
  std::vector<resolve::Limit> list;
  for (const resolve::Limit& limit : resolve::limits())
    if (limit.name != "evaluation depth" && limit.name != "errors told") list.push_back(limit);
  return list;
}

INSTANTIATE_TEST_SUITE_P(Language, Limits, testing::ValuesIn(limits_of_scenes()), [](const auto& row) {
  std::string name(row.param.name);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

}  // namespace
}  // namespace tyndall
