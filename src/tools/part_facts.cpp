#include "tools/part_facts.h"

#include <array>
#include <nlohmann/json.hpp>

namespace tyndall::tools {

bool is_part(const std::string& path) { return path.ends_with(part_extension); }

namespace {

// Each sum as its upper and lower half.
nlohmann::json sums_json(render::ClampedLight light) {
  nlohmann::json list = nlohmann::json::array();
  light.each([&list](const render::FixedSum& sum) {
    const auto [upper, lower] = sum.halves();
    list.push_back({upper, lower});
  });
  return list;
}

render::ClampedLight sums_from(const nlohmann::json& list) {
  render::ClampedLight light;
  std::size_t i = 0;
  light.each([&](render::FixedSum& sum) {
    const auto [upper, lower] = list.at(i++).get<std::array<std::uint64_t, 2>>();
    sum = render::FixedSum::of_halves(upper, lower);
  });
  return light;
}

}  // namespace

std::string to_text(const PartFacts& facts) {
  nlohmann::json json{{"identity", to_json(facts.identity)}, {"checkpoint", facts.is_checkpoint}};
  if (facts.clamped_light) json["clamped_light"] = sums_json(*facts.clamped_light);
  if (!facts.step_bias.empty()) json["step_bias"] = facts.step_bias;
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<PartFacts> part_facts_from(const std::string& text) try {
  const nlohmann::json json = nlohmann::json::parse(text);
  const auto identity = identity_from(json.at("identity").dump());
  if (!identity) return std::nullopt;
  PartFacts facts{*identity, json.at("checkpoint")};
  if (json.contains("clamped_light")) facts.clamped_light = sums_from(json.at("clamped_light"));
  facts.step_bias = json.value("step_bias", "");
  return facts;
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

}  // namespace tyndall::tools
