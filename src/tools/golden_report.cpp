// What golden tests found, as a page for people and as XML for CI systems.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "image/false_colors.h"
#include "tools/golden.h"
#include "tools/html.h"

namespace tyndall::tools {
namespace {

std::string figure(const std::optional<image::Image>& picture, const image::View& view,
                   std::string_view caption) {
  if (!picture) return {};
  std::vector<unsigned char> bytes;
  if (const std::string problem = image::encode_png(*picture, view, bytes); !problem.empty())
    return fmt::format("<figure><figcaption>{}: {}</figcaption></figure>\n", caption, escaped_text(problem));
  return fmt::format(
      "<figure><img src=\"data:image/png;base64,{}\" alt=\"{}\" width=\"{}\" height=\"{}\"><figcaption>{}"
      "</figcaption></figure>\n",
      base64(bytes), caption, picture->width, picture->height, caption);
}

bool is_good(const GoldenResult& result) {
  return result.outcome != GoldenOutcome::differs && result.outcome != GoldenOutcome::problem;
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : std::string("–");
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// All of a message stands in the section below.
std::string row(const GoldenResult& result) {
  std::string notes;
  for (const std::string& note : result.notes)
    notes += fmt::format("<br><small>{}</small>", escaped_text(note));
  return fmt::format(
      "<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f} s</td><td>{}{}</td></tr>\n",
      is_good(result) ? "good" : "bad", name(result.outcome), escaped_text(result.golden.scene),
      number(result.relative_mse), number(result.flip), result.seconds,
      escaped_text(first_line(result.message)), notes);
}

// The pictures of a test that did not pass, as far as there are any.
std::string section(const GoldenResult& result) {
  if (is_good(result)) return {};
  std::string text = fmt::format("<section><h2>{}</h2>\n<pre>{}</pre>\n", escaped_text(result.golden.scene),
                                 escaped_text(result.message));
  text += figure(result.reference, result.view, "reference") + figure(result.picture, result.view, "result");
  if (result.errors)
    text += figure(image::in_false_colors(*result.errors), image::View::of_numbers(),
                   "error (FLIP, from 0 dark to 1 light)");
  return text + "</section>\n";
}

constexpr std::string_view style = R"(
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 75em; padding: 0 1em; color: #222; background: #fafafa }
table { border-collapse: collapse; width: 100% }
th, td { text-align: left; padding: .3em .6em; border-bottom: 1px solid #ddd; vertical-align: top }
td:nth-child(n+3):nth-child(-n+5) { white-space: nowrap }
tr.bad td:first-child { color: #b00020; font-weight: bold }
tr.good td:first-child { color: #1b7f3b }
section { margin-top: 2em }
figure { display: inline-block; margin: 0 1% 1em 0; width: 32%; vertical-align: top }
img { width: 100%; height: auto; image-rendering: pixelated; background: #000 }
figcaption, small { color: #666; font-size: 13px }
pre { white-space: pre-wrap }
@media (prefers-color-scheme: dark) { body { color: #ddd; background: #1c1c20 } th, td { border-color: #444 } }
)";

std::string told_count(std::size_t good, std::size_t all) {
  return good == all ? fmt::format("all {} good", all)
                     : fmt::format("{} of {} did not pass", all - good, all);
}

}  // namespace

std::string golden_html(const GoldenArguments& arguments, const std::vector<GoldenResult>& results,
                        const std::string& machine) {
  const auto good = static_cast<std::size_t>(std::count_if(results.begin(), results.end(), is_good));
  std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>Golden tests: {0}</title>\n"
      "<style>{1}</style></head><body>\n<h1>Golden tests: {0}</h1>\n<p>{2}. {3}.</p>\n",
      told_count(good, results.size()), style,
      arguments.update        ? "References were renewed"
      : arguments.statistical ? "Statistical: rendered with other seeds, compared by z-tests"
                              : "Rendered with the seeds of the references, compared pixel by pixel",
      escaped_text(machine));
  text +=
      "<table><tr><th>outcome</th><th>scene</th><th>relmse</th><th>FLIP</th><th>time</th><th>found</th></"
      "tr>\n";
  for (const GoldenResult& result : results) text += row(result);
  text += "</table>\n";
  for (const GoldenResult& result : results) text += section(result);
  return text + "</body></html>\n";
}

std::string golden_junit(const std::vector<GoldenResult>& results, const std::string& machine) {
  std::size_t failures = 0, errors = 0;
  double seconds = 0;
  std::string cases;
  for (const GoldenResult& result : results) {
    const std::filesystem::path scene = result.golden.scene;
    seconds += result.seconds;
    cases +=
        fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" time=\"{:.3f}\">\n",
                    escaped_text(scene.parent_path().generic_string()), escaped_text(scene.stem().string()),
                    escaped_text(scene.generic_string()), result.seconds);
    std::string all = result.message;
    for (const std::string& note : result.notes) all += "\n" + note;
    const bool differs = result.outcome == GoldenOutcome::differs;
    failures += differs ? 1 : 0;
    errors += result.outcome == GoldenOutcome::problem ? 1 : 0;
    if (is_good(result))
      cases += fmt::format("      <system-out>{}</system-out>\n", escaped_text(all));
    else
      cases += fmt::format("      <{0} message=\"{1}\">{2}</{0}>\n", differs ? "failure" : "error",
                           escaped_text(first_line(result.message)), escaped_text(all));
    cases += "    </testcase>\n";
  }
  const std::string counts = fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\"",
                                         results.size(), failures, errors, seconds);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n  <testsuite name=\"tyndall golden\" "
      "{0}>\n"
      "    <properties>\n      <property name=\"machine\" value=\"{1}\"/>\n    </properties>\n{2}"
      "  </testsuite>\n</testsuites>\n",
      counts, escaped_text(machine), cases);
}

}  // namespace tyndall::tools
