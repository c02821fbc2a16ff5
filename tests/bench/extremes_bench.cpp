// docs/extremes.md: what the scenes of tests/extremes give, and where numbers hold.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "bench.h"
#include "support/extremes.h"

namespace tyndall {

namespace {

using support::ExtremeCase, support::ExtremeOutcome;

constexpr std::string_view extremes_introduction =
    R"(# Numerical extremes

This page shows what scenes give whose numbers are at the ends of their ranges, or beyond them by mistake: millimetres for kilometres,
planets seen from eye height, extinctions from 1e-30 to 1e30, lights that touch the camera. The scenes are in `tests/extremes`; the head
of each derives its exact result. `scripts/bench extremes > docs/extremes.md` makes this page, and the tests run the same cases.

Each case renders right or explains: the mean of its picture differs from the exact one by at most four standard errors and the
share that is allowed, or the program says what is wrong, or both. A result without an exact one beside it is what is shown besides the
message.

Where numbers end:

- Distances are in double precision: what is thinner than 1e-13 of its distance from the camera is off, and not told (`thin-sheets`).
- The film counts light from 5e-20 to 2.7e11, coefficients of media end at 1e30, the radiance of a light that has a power at 1e30; all of
  these are told.
- Pictures have at most 16,384 pixels a side; larger ones are refused, with a crop as well.
- `bounces: 1024`, the default, cuts paths in white media of an optical depth of 100 and more, which is told.

| column | is |
| --- | --- |
| case | options of `render` |
| exact, result, ± | mean of the picture, and its standard error |
| error | of the result, in % of the exact one |
| allowed | beside four standard errors [%] |
| time, memory | CPU seconds and MB at most, of the whole run |
| says | the part of the message that is looked for |
)";

std::string first_sentence_of(const std::filesystem::path& scene) {
  std::string text, line;
  std::ifstream file(scene);
  while (std::getline(file, line) && line.starts_with("//") && !line.starts_with("// case:"))
    text += line.substr(2);
  return support::trimmed(text);
}

std::string in_table(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

void print_extreme(const ExtremeCase& one, const ExtremeOutcome& out) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.8g}", *value) : std::string("–");
  };
  const std::string error = one.truth && out.mean && *one.truth != 0
                                ? fmt::format("{:+.4f}", 100 * (*out.mean / *one.truth - 1))
                                : "–";
  const std::string allowed = one.truth ? fmt::format("{:g}", 100 * one.within) : "–";
  fmt::print(
      "| {} | {} | {} | {} | {} | {} | {:.2f} | {} | {} | {} |\n",
      one.options.empty() ? "as it is" : fmt::format("`{}`", in_table(one.options)), number(one.truth),
      number(out.mean), out.mean ? fmt::format("{:.1e}", out.standard_error) : "–", error, allowed,
      out.cpu_seconds, out.peak_bytes ? fmt::format("{:.0f}", *out.peak_bytes / 1e6) : "–",
      one.says.empty() ? "" : fmt::format("`{}`", in_table(one.says)),
      out.fault.empty() ? (out.status == 0 ? "right" : "explains") : "**" + in_table(out.fault) + "**");
  std::fflush(stdout);
}

}  // namespace

bool bench_extremes(std::string_view part) {
  std::string pattern = (std::filesystem::temp_directory_path() / "tyndall-extremes-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return false;
  if (part.empty()) fmt::print("{}", extremes_introduction);
  int cases = 0, faults = 0;
  for (const std::filesystem::path& scene : support::extreme_scenes()) {
    if (scene.stem().string().find(part) == std::string::npos) continue;
    fmt::print(
        "\n## {0}\n\n{1}\n([scene](../tests/extremes/{0}.tyn))\n\n"
        "| case | exact | result | ± | error | allowed | time | memory | says | |\n"
        "| --- | --: | --: | --: | --: | --: | --: | --: | --- | --- |\n",
        scene.stem().string(), first_sentence_of(scene));
    for (const ExtremeCase& one : support::cases_of(scene)) {
      const ExtremeOutcome out = support::render_extreme(one, pattern);
      print_extreme(one, out);
      ++cases;
      faults += !out.fault.empty();
    }
  }
  std::filesystem::remove_all(pattern);
  fmt::print("\n{} cases, {} of which are not as they should be.\n", cases, faults);
  return faults == 0;
}

}  // namespace tyndall
