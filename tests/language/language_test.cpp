// Runs every scene of this folder against the errors and warnings that comments on its lines expect:
//
//   sphere { raduis: 1 }   // error: no parameter 'raduis' … did you mean 'radius'
//
// Each reported problem must be expected on its line and each expected one reported. `…` stands for any text.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases.h"

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

struct Expectation {
  std::string file;
  std::uint32_t line;
  Severity severity;
  std::string fragments;
  bool met = false;
};

std::uint32_t lines_of(const Source& s) { return s.locate(static_cast<std::uint32_t>(s.text().size())).line; }

// The expectations in a line's comments.
void read_expectations(const Source& source, std::uint32_t line, std::vector<Expectation>& expectations) {
  std::string_view rest = source.line(line);
  while (true) {
    const std::size_t error = rest.find("// error: "), warning = rest.find("// warning: "),
                      note = rest.find("// note: ");
    const std::size_t at = std::min({error, warning, note});
    if (at == std::string_view::npos) return;
    rest = rest.substr(rest.find(": ", at) + 2);
    std::string_view fragments = rest.substr(0, rest.find(" // "));
    while (fragments.ends_with(' ')) fragments.remove_suffix(1);
    expectations.push_back({source.name(), line,
                            at == error     ? Severity::error
                            : at == warning ? Severity::warning
                                            : Severity::note,
                            std::string(fragments)});
  }
}

// Whether the fragments stand in the text in this order.
bool matches(std::string_view text, std::string_view fragments) {
  constexpr std::string_view any = "…";
  while (true) {
    const std::size_t end = fragments.find(any);
    std::string_view fragment = fragments.substr(0, end);
    while (fragment.starts_with(' ')) fragment.remove_prefix(1);
    while (fragment.ends_with(' ')) fragment.remove_suffix(1);
    const std::size_t at = text.find(fragment);
    if (at == std::string_view::npos) return false;
    if (end == std::string_view::npos) return true;
    text = text.substr(at + fragment.size());
    fragments = fragments.substr(end + any.size());
  }
}

class Language : public testing::TestWithParam<std::string> {};

TEST_P(Language, ReportsWhatTheCommentsSay) {
  Case c;
  run_case(GetParam(), c);
  const Sources& sources = c.sources;
  const Diagnostics& diagnostics = c.diagnostics;

  std::vector<Expectation> expectations;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Source& s = sources[SourceId(i)];
    for (std::uint32_t line = 1; line <= lines_of(s); ++line)
      if (!s.line(line).starts_with(set_mark)) read_expectations(s, line, expectations);
  }
  for (const Diagnostic& d : diagnostics.all()) {
    ASSERT_TRUE(d.span.valid()) << d.message;
    const Source& s = sources[d.span.source];
    const std::uint32_t line = s.locate(d.span.begin).line;
    bool expected = false;
    for (Expectation& e : expectations) {
      if (expected || e.met || e.file != s.name() || e.line != line || e.severity != d.severity) continue;
      expected = e.met = matches(text_of(d), e.fragments);
    }
    EXPECT_TRUE(expected) << "not expected:\n" << render_text(d, sources, false);
  }
  for (const Expectation& e : expectations)
    EXPECT_TRUE(e.met) << fmt::format("{}:{}: expected, not reported: {}", e.file, e.line, e.fragments);
  EXPECT_EQ(
      diagnostics.error_count(),
      static_cast<int>(std::count_if(expectations.begin(), expectations.end(),
                                     [](const Expectation& e) { return e.severity == Severity::error; })));
}

// The scenes hold enough: many cases, each an expectation.
TEST(Cases, AreMany) {
  std::size_t errors = 0, warnings = 0;
  for (const std::string& path : case_files()) {
    Sources sources;
    std::ifstream file(path, std::ios::binary);
    const SourceId source = sources.add(path, std::string{std::istreambuf_iterator<char>(file), {}});
    std::vector<Expectation> expectations;
    for (std::uint32_t line = 1; line <= lines_of(sources[source]); ++line)
      read_expectations(sources[source], line, expectations);
    for (const Expectation& e : expectations) ++(e.severity == Severity::error ? errors : warnings);
  }
  EXPECT_GE(errors, 300u);
  EXPECT_GE(warnings, 10u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Language, testing::ValuesIn(case_files()),
                         [](const auto& scene) { return fs::path(scene.param).stem().string(); });

}  // namespace UNNAMED
}  // namespace tyndall
