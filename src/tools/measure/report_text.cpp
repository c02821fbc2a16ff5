// The report for people and for spreadsheets.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/measure/percent.h"
#include "tools/measure/report.h"
#include "tools/text_table.h"

namespace tyndall::tools {
namespace {

using Cells = TextRow;

Cells head_cells() {
  return {"setting", "runs",   "time s", "CPU s",      "error %", "bias %",
          "noise %", "mean %", "FLIP",   "efficiency", "MB"};
}

Cells cells_of(const SettingRow& row) {
  Cells cells{row.name + (row.on_front ? " *" : ""), fmt::format("{}", row.runs)};
  cells.resize(head_cells().size(), "-");
  if (row.runs > 0) {
    cells[2] = three_digits(row.cost.seconds);
    cells[3] = three_digits(row.cost.cpu_seconds);
    cells[10] = fmt::format("{:.0f}", row.cost.peak_bytes / 1e6);
  }
  if (!row.accuracy) return cells;
  cells[4] = percent_text(*error_of(row));
  cells[5] = percent_text(root(row.accuracy->squared_bias));
  cells[6] = percent_text(root(row.accuracy->noise));
  cells[7] = signed_percent_text(row.accuracy->mean_bias);
  if (const auto efficiency = efficiency_of(row)) cells[9] = three_digits(*efficiency);
  if (row.flip) cells[8] = fmt::format("{:.3f}", *row.flip);
  return cells;
}

std::string advice_text(const Advice& advice) {
  if (advice.setting.empty())
    return fmt::format("for an error of {:g} %: {}\n", 100 * advice.error, why_not_reached(advice));
  std::string text =
      fmt::format("for an error of {:g} %: {}, {} samples, about {:.3g} s{}\n{}", 100 * advice.error,
                  advice.setting, advice.samples, advice.seconds,
                  advice.is_measured ? "" : " (noise taken to fall as 1/samples)", advice.render);
  if (!advice.options.empty()) text += fmt::format("with {}\n", fmt::join(advice.options, " "));
  return text;
}

void add_estimate(std::string& line, const Estimate& estimate) {
  for (const double number : {estimate.value, estimate.low, estimate.high}) line += "," + csv_number(number);
}

}  // namespace

std::string why_not_reached(const Advice& advice) {
  return advice.is_out_of_reach
             ? "the bias of every setting is larger: sweep shorter steps, or more bounces"
             : "no setting is known to reach it: a longer budget, more seeds or more samples "
               "would tell how large the bias is";
}

std::string reference_text(const ReferenceFacts& reference) {
  const std::string error =
      reference.error ? fmt::format("its error: {} %", percent_text(*reference.error))
                      : "its error is not known: what it errs counts as bias, and 'half' among its channels "
                        "(render --aov half) would tell";
  if (reference.given) return fmt::format("reference: '{}'; {}\n", reference.file, error);
  if (reference.samples == 0) return "reference: none yet\n";
  return fmt::format("reference: {}, {} samples a pixel, {:.3g} s; {}\n", reference.method, reference.samples,
                     reference.seconds, error);
}

std::string table_of(const MeasureReport& report) {
  const std::string costs = report.feature_costs.rows.empty() ? "" : table_of(report.feature_costs);
  if (report.rows.empty()) return costs;
  std::vector<Cells> table{head_cells()};
  for (const SettingRow& row : report.rows) table.push_back(cells_of(row));
  std::string text = text_table(table) + reference_text(report.reference);
  for (const Advice& advice : report.advice) text += advice_text(advice);
  return costs.empty() ? text : text + "\n" + costs;
}

std::string csv_of(const MeasureReport& report) {
  if (report.rows.empty()) return csv_of(report.feature_costs);
  std::string text = "setting";
  if (!report.rows.empty())
    for (const auto& [name, value] : report.rows[0].swept) text += "," + name;
  text += ",samples_per_pixel,runs,seconds,cpu_seconds,peak_memory_bytes,on_front";
  for (const char* name : {"error", "bias", "noise", "squared_bias", "squared_noise", "relmse", "mean_bias"})
    text += fmt::format(",{0},{0}_low,{0}_high", name);
  text += ",efficiency,flip\n";
  for (const SettingRow& row : report.rows) {
    std::string line = csv_field(row.name);
    for (const auto& [name, value] : row.swept) line += "," + csv_field(value);
    line += fmt::format(",{},{},{},{},{},{}", row.settings.samples, row.runs, row.cost.seconds,
                        row.cost.cpu_seconds, row.cost.peak_bytes, row.on_front ? 1 : 0);
    if (row.accuracy) {
      const Accuracy& a = *row.accuracy;
      for (const Estimate& e : {root(a.relmse), root(a.squared_bias), root(a.noise), a.squared_bias, a.noise,
                                a.relmse, a.mean_bias})
        add_estimate(line, e);
    } else {
      line += std::string(3 * 7, ',');
    }
    line += ",";
    if (const auto efficiency = efficiency_of(row)) line += csv_number(*efficiency);
    line += ",";
    if (row.flip) line += csv_number(*row.flip);
    text += line + "\n";
  }
  return text;
}

}  // namespace tyndall::tools
