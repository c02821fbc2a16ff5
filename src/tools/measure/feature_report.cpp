// What features cost, for people, spreadsheets and programs.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/html.h"
#include "tools/measure/feature_costs.h"
#include "tools/measure/percent.h"
#include "tools/text_table.h"

namespace tyndall::tools {
namespace {

std::string row_name(const FeatureCost& row) {
  return row.name.empty() ? "whole scene" : "without " + row.name;
}

TextRow cells_of(const FeatureCost& row) {
  return {row_name(row),
          fmt::format("{}", row.runs),
          three_digits(row.cost.seconds),
          three_digits(row.cost.cpu_seconds),
          row.time_share ? signed_percent_text(*row.time_share) : "-",
          fmt::format("{:.1f}", row.cost.peak_bytes / 1e6),
          row.name.empty() ? "-" : fmt::format("{:.1f}", row.bytes / 1e6)};
}

TextRow feature_head() {
  return {"", "renders", "time s", "CPU s", "so it takes %", "memory MB", "so it takes MB"};
}

}  // namespace

std::string table_of(const FeatureCosts& costs) {
  std::vector<TextRow> table{feature_head()};
  for (const FeatureCost& row : costs.rows) table.push_back(cells_of(row));
  return text_table(table);
}

std::string csv_of(const FeatureCosts& costs) {
  std::string text =
      "feature,runs,seconds,cpu_seconds,peak_memory_bytes,time_share,time_share_low,time_share_high,memory_"
      "bytes\n";
  for (const FeatureCost& row : costs.rows) {
    text += fmt::format("{},{},{},{},{}", csv_field(row.name), row.runs, row.cost.seconds,
                        row.cost.cpu_seconds, row.cost.peak_bytes);
    const Estimate share = row.time_share.value_or(Estimate{std::nan(""), std::nan(""), std::nan("")});
    for (const double number :
         {share.value, share.low, share.high, row.name.empty() ? std::nan("") : row.bytes})
      text += "," + csv_number(number);
    text += "\n";
  }
  return text;
}

nlohmann::json to_json(const FeatureCosts& costs) {
  nlohmann::json rows = nlohmann::json::array();
  for (const FeatureCost& row : costs.rows) {
    nlohmann::json one{{"without", row.name},
                       {"runs", row.runs},
                       {"seconds", row.cost.seconds},
                       {"cpu_seconds", row.cost.cpu_seconds},
                       {"peak_memory_bytes", row.cost.peak_bytes}};
    if (!row.name.empty()) one["memory_bytes"] = row.bytes;
    if (row.time_share)
      one["time_share"] = {
          {"value", row.time_share->value}, {"low", row.time_share->low}, {"high", row.time_share->high}};
    rows.push_back(std::move(one));
  }
  return rows;
}

std::string html_of(const FeatureCosts& costs) {
  if (costs.rows.empty()) return {};
  std::string html =
      "<h2>What each feature costs</h2>\n<p>The scene as it is, and with each of its features taken out. "
      "What "
      "a feature takes is the difference, in % of the whole scene's CPU time, with the interval that holds "
      "it in 95 of 100 "
      "cases.</p>\n<div class=\"wide\"><table id=\"costs\"><thead><tr>";
  for (const std::string& cell : feature_head()) html += "<th>" + escaped_text(cell) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const FeatureCost& row : costs.rows) {
    html += "<tr>";
    for (const std::string& cell : cells_of(row)) html += "<td>" + escaped_text(cell) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace tyndall::tools
