#include "tools/measure/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace tyndall::tools {
namespace {

nlohmann::json json_of(const Estimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

nlohmann::json json_of(const SettingRow& row) {
  nlohmann::json parameters = nlohmann::json::object();
  for (const auto& [name, value] : row.swept) parameters[name] = value;
  nlohmann::json json{{"name", row.name},
                      {"parameters", parameters},
                      {"samples", row.settings.samples},
                      {"runs", row.runs},
                      {"on_front", row.on_front}};
  if (row.runs > 0)
    json.update({{"seconds", row.cost.seconds},
                 {"cpu_seconds", row.cost.cpu_seconds},
                 {"preparation_cpu_seconds", row.cost.preparation_cpu_seconds},
                 {"peak_memory_bytes", row.cost.peak_bytes}});
  if (!row.accuracy) return json;
  const Accuracy& a = *row.accuracy;
  json.update({{"error", json_of(*error_of(row))},
               {"bias", json_of(root(a.squared_bias))},
               {"noise", json_of(root(a.noise))},
               {"squared_bias", json_of(a.squared_bias)},
               {"squared_noise", json_of(a.noise)},
               {"relmse", json_of(a.relmse)},
               {"mean_bias", json_of(a.mean_bias)}});
  if (const auto efficiency = efficiency_of(row)) json["efficiency"] = *efficiency;
  if (row.flip) json["flip"] = *row.flip;
  return json;
}

nlohmann::json json_of(const ReferenceFacts& reference) {
  nlohmann::json json{{"given", reference.given}, {"parts", reference.parts}};
  if (reference.given)
    json["file"] = reference.file;
  else
    json.update(
        {{"options", reference.method}, {"samples", reference.samples}, {"seconds", reference.seconds}});
  if (reference.error) json["error"] = json_of(*reference.error);
  return json;
}

nlohmann::json json_of(const Advice& advice) {
  nlohmann::json json{{"error", advice.error}, {"reached", !advice.setting.empty()}};
  if (!advice.setting.empty())
    json.update({{"setting", advice.setting},
                 {"samples", advice.samples},
                 {"seconds", advice.seconds},
                 {"measured", advice.is_measured},
                 {"render", advice.render},
                 {"options", advice.options}});
  return json;
}

}  // namespace

std::optional<Estimate> error_of(const SettingRow& row) {
  if (!row.accuracy) return std::nullopt;
  return root(row.accuracy->relmse);
}

std::optional<double> efficiency_of(const SettingRow& row) {
  if (!row.accuracy) return std::nullopt;
  const double product = row.accuracy->relmse.value * row.cost.cpu_seconds;
  if (!(product > 0)) return std::nullopt;
  return 1 / product;
}

void mark_front(std::vector<SettingRow>& rows) {
  for (SettingRow& row : rows) {
    const auto error = error_of(row);
    row.on_front = error && std::none_of(rows.begin(), rows.end(), [&](const SettingRow& other) {
                     const auto other_error = error_of(other);
                     if (!other_error || &other == &row) return false;
                     const double time = other.cost.cpu_seconds, own_time = row.cost.cpu_seconds;
                     return time <= own_time && other_error->value <= error->value &&
                            (time < own_time || other_error->value < error->value);
                   });
  }
}

nlohmann::json to_json(const MeasureReport& report) {
  nlohmann::json rows = nlohmann::json::array(), advice = nlohmann::json::array(),
                 features = nlohmann::json::object();
  for (const SettingRow& row : report.rows) rows.push_back(json_of(row));
  for (const Advice& one : report.advice) advice.push_back(json_of(one));
  for (const auto& [name, used] : report.features) features[name] = used;
  nlohmann::json json{{"version", TYNDALL_VERSION},
                      {"scene", report.scene},
                      {"frame", report.frame},
                      {"resolution", {report.width, report.height}},
                      {"threads", report.threads},
                      {"seeds", report.seeds},
                      {"complete", report.complete},
                      {"reference", json_of(report.reference)},
                      {"settings", rows},
                      {"advice", advice},
                      {"features", features}};
  if (!report.feature_costs.rows.empty()) json["feature_costs"] = to_json(report.feature_costs);
  return json;
}

}  // namespace tyndall::tools
