#include "tools/measure/report_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "tools/measure/percent.h"
#include "tools/numbers.h"

namespace tyndall::tools {
namespace {

PlotPoint point_of(double x, const Estimate& error, const std::string& label, bool filled = true) {
  return {x, 100 * error.value, 100 * error.low, 100 * error.high, label, filled};
}

std::string error_label(const SettingRow& row) {
  return fmt::format("{}: {} % in {:.3g} CPU s", row.name, percent_text(*error_of(row)),
                     row.cost.cpu_seconds);
}

// Lines from left to right.
PlotLine line_through(std::vector<PlotPoint> points, const char* kind) {
  std::stable_sort(points.begin(), points.end(),
                   [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  return {std::move(points), kind};
}

Plot error_plot(const MeasureReport& report) {
  Plot plot{"error-time",
            "Error against time: filled points are the Pareto front, no other is as fast and more accurate",
            "CPU seconds of a render", "error (root of relMSE) in %"};
  std::vector<PlotPoint> front;
  for (const SettingRow& row : report.rows) {
    if (!row.accuracy) continue;
    Estimate error = *error_of(row);
    if (error.value == 0) error.value = error.low = error.high;  // lost in the noise of the reference
    plot.points.push_back(point_of(row.cost.cpu_seconds, error, error_label(row), row.on_front));
    if (row.on_front) front.push_back(plot.points.back());
  }
  plot.lines.push_back(line_through(std::move(front), "front"));
  return plot;
}

// The settings that differ in one parameter alone, by what they have in common.
std::string without(const SettingRow& row, const std::string& parameter) {
  std::string name;
  for (const auto& [other, value] : row.swept)
    if (other != parameter) name += other + " " + value + " ";
  return name;
}

// Bias against a parameter, where its values are numbers. Where the interval has 0 the point is its upper
// end.
Plot bias_plot(const MeasureReport& report, const std::string& parameter) {
  Plot plot{
      "bias-" + parameter,
      fmt::format("Bias against {}: hollow points are upper limits, where no bias was found", parameter),
      parameter, "bias in %"};
  std::map<std::string, std::vector<PlotPoint>> families;
  for (const SettingRow& row : report.rows) {
    if (!row.accuracy) continue;
    for (const auto& [name, value] : row.swept) {
      const auto number = name == parameter ? read_decimal<double>(value) : std::nullopt;
      if (!number) continue;
      Estimate bias = root(row.accuracy->squared_bias);
      const bool is_found = bias.low > 0;
      const std::string label = fmt::format("{}: bias {} %", row.name, percent_text(bias));
      if (!is_found) bias.value = bias.low = bias.high;
      plot.points.push_back(point_of(*number, bias, label, is_found));
      families[without(row, parameter)].push_back(plot.points.back());
    }
  }
  for (auto& [name, points] : families) plot.lines.push_back(line_through(std::move(points), "family"));
  return plot;
}

Plot noise_plot(const MeasureReport& report) {
  Plot plot{"noise-samples", "Noise against samples: the dashed line falls as 1/\u221asamples",
            "samples a pixel", "noise in %"};
  std::map<std::string, std::vector<PlotPoint>> families;
  double least = 0, most = 0;
  const SettingRow* first = nullptr;
  for (const SettingRow& row : report.rows) {
    if (!row.accuracy) continue;
    const double samples = row.settings.samples;
    const Estimate noise = root(row.accuracy->noise);
    plot.points.push_back(
        point_of(samples, noise, fmt::format("{}: noise {} %", row.name, percent_text(noise)), row.on_front));
    families[without(row, "samples")].push_back(plot.points.back());
    if (!first || samples < first->settings.samples) first = &row;
    least = least == 0 ? samples : std::min(least, samples);
    most = std::max(most, samples);
  }
  if (!first) return plot;
  if (least == most) least /= 2, most *= 2;
  const double noise = 100 * root(first->accuracy->noise).value;
  PlotLine expected{{}, "expected"};
  for (const double samples : {least, most})
    expected.points.push_back(
        {samples, noise * std::sqrt(first->settings.samples / samples), 0, 0, "", true});
  plot.lines.push_back(expected);
  for (auto& [name, points] : families) plot.lines.push_back(line_through(std::move(points), "family"));
  return plot;
}

}  // namespace

std::vector<Plot> plots_of(const MeasureReport& report) {
  std::vector<Plot> plots{error_plot(report)};
  if (!report.rows.empty())
    for (const auto& [parameter, value] : report.rows[0].swept) {
      if (parameter == "samples") continue;
      Plot plot = bias_plot(report, parameter);
      const auto differs = [&plot](const PlotPoint& point) { return point.x != plot.points[0].x; };
      if (std::any_of(plot.points.begin(), plot.points.end(), differs)) plots.push_back(std::move(plot));
    }
  plots.push_back(noise_plot(report));
  return plots;
}

}  // namespace tyndall::tools
