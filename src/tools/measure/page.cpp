#include "tools/measure/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tools/html.h"
#include "tools/measure/percent.h"
#include "tools/measure/report_plots.h"

namespace tyndall::tools {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 1220px; padding: 0 1rem; color: #222; background: #fdfdfb; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2.2rem; } h3 { font-size: 1rem; margin: .4rem 0; }
table { border-collapse: collapse; font-size: .8rem; font-variant-numeric: tabular-nums; } .wide { overflow-x: auto; }
th, td { padding: .25rem .4rem; text-align: right; border-bottom: 1px solid #ddd; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } tr.front td:first-child { font-weight: 600; }
.plots, .pictures, #advice { display: grid; gap: 1.2rem; }
.plots { grid-template-columns: repeat(auto-fit, minmax(min(460px, 100%), 1fr)); align-items: end; }
.pictures { grid-template-columns: repeat(auto-fill, minmax(min(270px, 100%), 1fr)); }
.reference { grid-column: 1 / -1; width: min(270px, 100%); }
#advice { grid-template-columns: repeat(auto-fit, minmax(min(330px, 100%), 1fr)); } #advice p { margin: .3rem 0; }
figure { margin: 0; } figcaption { font-size: .87rem; color: #444; } svg { width: 100%; background: #fff; border: 1px solid #e4e4e0; }
.grid { stroke: #eee; } .tick { font-size: 11px; fill: #555; } .axis { font-size: 12px; fill: #222; }
.point { fill: #b3402a; stroke: #b3402a; stroke-width: 1.5; } .hollow { fill: #fff; } .interval { stroke: #b3402a; }
.front { fill: none; stroke: #b3402a; stroke-width: 1.5; } .family { fill: none; stroke: #a9a9a2; }
.expected { fill: none; stroke: #33618f; stroke-dasharray: 6 4; }
.pair { position: relative; display: block; } .pair img { width: 100%; display: block; image-rendering: pixelated; }
.pair img + img { position: absolute; inset: 0; clip-path: inset(0 0 0 var(--wipe, 50%)); }
pre { background: #f2f2ec; padding: .6rem .9rem; font-size: .87rem; white-space: pre-wrap; } input[type=range] { width: min(480px, 100%); }
)";

constexpr const char* script = R"(
document.getElementById('wipe').addEventListener('input', function (event) {
  document.body.style.setProperty('--wipe', event.target.value + '%');
});
)";

std::string row_html(const SettingRow& row) {
  std::string html = fmt::format("<tr{}><td>{}</td><td>{}</td>", row.on_front ? " class=\"front\"" : "",
                                 escaped_text(row.name), row.runs);
  const auto cell = [&html](const std::string& text) { html += "<td>" + escaped_text(text) + "</td>"; };
  if (row.runs > 0) {
    cell(three_digits(row.cost.seconds));
    cell(three_digits(row.cost.cpu_seconds));
  } else {
    html += "<td>-</td><td>-</td>";
  }
  if (row.accuracy) {
    const Accuracy& a = *row.accuracy;
    cell(percent_text(*error_of(row)));
    cell(percent_text(root(a.squared_bias)));
    cell(percent_text(root(a.noise)));
    cell(signed_percent_text(a.mean_bias));
    cell(fmt::format("{:.3g}", a.relmse.value));
  } else {
    html += "<td>-</td><td>-</td><td>-</td><td>-</td><td>-</td>";
  }
  cell(row.flip ? fmt::format("{:.3f}", *row.flip) : "-");
  const auto efficiency = efficiency_of(row);
  cell(efficiency ? three_digits(*efficiency) : "-");
  cell(row.runs > 0 ? fmt::format("{:.0f}", row.cost.peak_bytes / 1e6) : "-");
  return html + "</tr>\n";
}

std::string table_html(const MeasureReport& report) {
  std::string html =
      "<div class=\"wide\"><table id=\"settings\"><thead><tr><th>setting</th><th>renders</th><th>time "
      "s</th><th>CPU s</th>"
      "<th>error %</th><th>bias %</th><th>noise %</th><th>mean "
      "%</th><th>relMSE</th><th>FLIP</th><th>efficiency</th>"
      "<th>memory MB</th></tr></thead><tbody>\n";
  for (const SettingRow& row : report.rows) html += row_html(row);
  return html + "</tbody></table></div>\n";
}

std::string advice_html(const Advice& advice) {
  const std::string wanted = fmt::format("<div><h3>An error of {:g} %</h3>\n", 100 * advice.error);
  if (advice.setting.empty())
    return wanted + fmt::format("<p>{}</p></div>\n", escaped_text(why_not_reached(advice)));
  std::string html =
      wanted + fmt::format("<p>{}, {} samples, about {:.3g} s{}.</p>\n<pre>{}</pre>\n",
                           escaped_text(advice.setting), advice.samples, advice.seconds,
                           advice.is_measured ? "" : ", if noise falls as 1/samples from what was measured",
                           escaped_text(advice.render));
  if (!advice.options.empty())
    html += fmt::format("<p>with the options <code>{}</code></p>\n",
                        escaped_text(fmt::format("{}", fmt::join(advice.options, " "))));
  return html + "</div>\n";
}

std::string pair_html(const std::string& caption, const std::string& picture, const std::string& errors) {
  return fmt::format(
      "<figure><span class=\"pair\"><img src=\"{}\" alt=\"{}\"><img src=\"{}\" alt=\"its errors\"></span>"
      "<figcaption>{}</figcaption></figure>\n",
      picture, escaped_text(caption), errors, escaped_text(caption));
}

std::string pictures_html(const PagePictures& pictures) {
  if (pictures.reference.empty()) return {};
  std::string html = fmt::format(
      "<h2>Pictures</h2>\n<p>The slider moves the edge between each picture, on the left, and its error map. "
      "Black is no error; the lightest colour is an error of {} % of the pixel's own light, and more. One "
      "render shows bias and noise, the mean of all hardly more than bias.</p>\n<p><input id=\"wipe\" "
      "type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"picture or error map\"></p>\n"
      "<div class=\"pictures\">\n",
      percent_digits(pictures.most_error, 2));
  html += fmt::format(
      "<figure class=\"reference\"><span class=\"pair\"><img src=\"{}\" "
      "alt=\"reference\"></span><figcaption>reference"
      "</figcaption></figure>\n",
      pictures.reference);
  for (const SettingPictures& one : pictures.settings) {
    html += pair_html(one.name + ": one render", one.render, one.render_errors);
    html += pair_html(one.name + ": the mean of all", one.mean, one.mean_errors);
  }
  return html + "</div>\n<script>" + script + "</script>\n";
}

std::string features_html(const MeasureReport& report) {
  std::string used, unused;
  for (const auto& [name, is_used] : report.features) {
    std::string& list = is_used ? used : unused;
    list += (list.empty() ? "" : ", ") + name;
  }
  return fmt::format(
      "<h2>What the scene uses</h2>\n<p id=\"features\">{}.</p>\n<p>It does not use: {}.</p>\n",
      escaped_text(used.empty() ? "nothing" : used), escaped_text(unused.empty() ? "nothing" : unused));
}

// JSON in a page must not end its element.
std::string json_html(const MeasureReport& report) {
  const std::string json = to_json(report).dump(1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string text;
  for (const char c : json) text += c == '<' ? "\\u003c" : std::string(1, c);
  return "<script type=\"application/json\" id=\"measurements\">\n" + text + "\n</script>\n";
}

// What was measured of the settings.
std::string settings_html(const MeasureReport& report, const PagePictures& pictures) {
  if (report.rows.empty()) return {};
  std::string html =
      fmt::format("<p id=\"reference\">{}</p>\n", escaped_text(reference_text(report.reference)));
  html += "<h2>Recommended settings</h2>\n<div id=\"advice\">\n";
  for (const Advice& advice : report.advice) html += advice_html(advice);
  html += "</div>\n<h2>Plots</h2>\n<div class=\"plots\">\n";
  for (const Plot& plot : plots_of(report)) html += svg_of(plot);
  html +=
      "</div>\n<h2>Numbers</h2>\n<p>The error is the root of the relMSE, and its square the sum of the "
      "squares of bias "
      "and noise. Intervals hold the truth in 95 of 100 cases.</p>\n";
  return html + table_html(report) + pictures_html(pictures);
}

}  // namespace

std::string page_of(const MeasureReport& report, const PagePictures& pictures) {
  const std::string name = escaped_text(std::filesystem::path(report.scene).filename().string());
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}: speed and "
      "accuracy</title>\n"
      "<style>{1}</style></head><body>\n<h1>{0}: speed and accuracy</h1>\n"
      "<p>Frame {2}, {3} \u00d7 {4} pixels, {5} threads, Tyndall {6}. {7}</p>\n",
      name, style, report.frame, report.width, report.height, report.threads, TYNDALL_VERSION,
      report.complete ? "All was measured that was asked for."
                      : "Not all was measured that was asked for: the same "
                        "command goes on from here.");
  html += settings_html(report, pictures) + html_of(report.feature_costs) + features_html(report) +
          json_html(report);
  return html + "</body></html>\n";
}

}  // namespace tyndall::tools
