#include "tools/measure/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <map>
#include <optional>

#include "base/numerics.h"

namespace tyndall::tools {
namespace {

std::string spelled(std::integral auto value) { return fmt::format("{}", value); }
std::string spelled(const scene::Resolution& size) {
  return fmt::format("({}, {})", size.width, size.height);
}
template <class T>
requires(!std::integral<T>) std::string spelled(const T& value) { return scene::describe(value); }

struct Candidate {
  const SettingRow* row = nullptr;
  int samples = 0;
  double seconds = 0;
  double distance = 0;  // of its samples from the measured ones, in the logarithm
};

// How many samples the setting needs, and how long they take.
std::optional<Candidate> candidate_of(const SettingRow& row, const Estimate& squared_bias, double error) {
  if (!row.accuracy || !(squared_bias.high < sqr(error))) return std::nullopt;
  const double rest = sqr(error) - std::max(0.0, squared_bias.value);
  const double samples = std::max(1.0, std::ceil(row.settings.samples * row.accuracy->noise.value / rest));
  if (!(samples <= scene::RenderSettings::samples_range.most)) return std::nullopt;
  const double share = samples / row.settings.samples;
  const double cpu =
      row.cost.preparation_cpu_seconds + share * (row.cost.cpu_seconds - row.cost.preparation_cpu_seconds);
  return Candidate{&row, static_cast<int>(samples), row.cost.seconds * cpu / row.cost.cpu_seconds,
                   std::abs(std::log(share))};
}

// The setting without its samples.
std::string family_of(const SettingRow& row) {
  std::string name;
  for (const auto& [parameter, value] : row.swept)
    if (parameter != "samples") name += parameter + "=" + value + " ";
  return name;
}

std::string setting_text(const SettingRow& row) {
  std::string text;
  for (const auto& [parameter, value] : row.swept)
    if (parameter != "samples") text += fmt::format("{}{} {}", text.empty() ? "" : ", ", parameter, value);
  return text.empty() ? "as the scene is" : text;
}

// Of each family, whose settings have the same bias, what is known best.
std::map<std::string, Estimate> biases_of(const std::vector<SettingRow>& rows) {
  std::map<std::string, Estimate> biases;
  for (const SettingRow& row : rows) {
    if (!row.accuracy) continue;
    const Estimate& bias = row.accuracy->squared_bias;
    const auto [entry, is_new] = biases.emplace(family_of(row), bias);
    if (!is_new && bias.high - bias.low < entry->second.high - entry->second.low) entry->second = bias;
  }
  return biases;
}

Advice advice_for(const std::vector<SettingRow>& rows, double error) {
  std::map<std::string, Estimate> biases = biases_of(rows);
  std::map<std::string, Candidate> nearest;
  for (const SettingRow& row : rows) {
    const std::string family = family_of(row);
    const auto candidate = candidate_of(row, biases[family], error);
    if (!candidate) continue;
    const auto [entry, is_new] = nearest.emplace(family, *candidate);
    if (!is_new && candidate->distance < entry->second.distance) entry->second = *candidate;
  }
  const Candidate* best = nullptr;
  for (const auto& [family, candidate] : nearest)
    if (!best || candidate.seconds < best->seconds) best = &candidate;
  Advice advice{.error = error};
  if (!best) {
    advice.is_out_of_reach = std::all_of(rows.begin(), rows.end(), [&](const SettingRow& row) {
      return row.accuracy && row.accuracy->squared_bias.low > sqr(error);
    });
    return advice;
  }
  advice.setting = setting_text(*best->row);
  advice.samples = best->samples;
  advice.seconds = best->seconds;
  advice.is_measured = best->samples == best->row->settings.samples;
  scene::RenderSettings settings = best->row->settings;
  settings.samples = best->samples;
  advice.render = render_block(settings);
  advice.options = best->row->options;
  return advice;
}

}  // namespace

std::vector<Advice> advice_of(const std::vector<SettingRow>& rows) {
  std::vector<Advice> advice;
  for (const double error : advised_errors) advice.push_back(advice_for(rows, error));
  return advice;
}

std::string render_block(const scene::RenderSettings& settings) {
  const scene::RenderSettings usual;
  std::string text = fmt::format("{} {{\n", scene::RenderSettings::keyword);
  scene::RenderSettings::fields([&](auto member, const scene::SettingInfo& info) {
    const std::string value = spelled(settings.*member);
    if (value != spelled(usual.*member) || info.name == "samples" || info.name == "resolution")
      text += fmt::format("  {}: {}\n", info.name, value);
  });
  return text + "}\n";
}

}  // namespace tyndall::tools
