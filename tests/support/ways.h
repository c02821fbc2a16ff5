// The renderer's ways through a medium, for tests that loop over them.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/render.h"

namespace tyndall::support {

struct Way {
  std::string name;
  render::Method method{};
  render::Distance distance{};
  render::Transmittance transmittance{};
  bool unbiased = false;  // whatever the step

  render::RenderOptions options() const {
    render::RenderOptions o;
    o.method = method;
    o.distance = distance;
    o.transmittance = transmittance;
    return o;
  }
};

// Every one of a closed family, with its word on the command line: from a table in the family's order.
template <class Choice, std::size_t count>
std::vector<std::pair<std::string, Choice>> choices_of(const std::array<std::string_view, count>& names) {
  std::vector<std::pair<std::string, Choice>> list;
  for (std::size_t i = 0; i < count; ++i) list.emplace_back(names[i], static_cast<Choice>(i));
  return list;
}
inline auto all_methods() { return choices_of<render::Method>(render::method_names); }
inline auto all_distances() { return choices_of<render::Distance>(render::distance_names); }
inline auto all_transmittances() { return choices_of<render::Transmittance>(render::transmittance_names); }

// "brute-force" as tests are named: "BruteForce".
inline std::string test_name(std::string_view word) {
  std::string name;
  bool begins = true;
  for (const char c : word) {
    if (c != '-') name += begins ? static_cast<char>(std::toupper(c)) : c;
    begins = c == '-';
  }
  return name;
}

// The standard way first.
inline std::vector<Way> ways() {
  using render::Distance, render::Method, render::Transmittance;
  const render::RenderOptions standard;
  std::vector<Way> list;
  for (const auto& [name, distance] : all_distances())
    list.push_back({test_name(name), standard.method, distance, Transmittance::march, false});
  std::stable_partition(list.begin(), list.end(),
                        [&](const Way& way) { return way.distance == standard.distance; });
  list.push_back({"Jackknife", standard.method, standard.distance, Transmittance::jackknife, false});
  for (const auto& [name, method] : all_methods()) {
    if (method == standard.method) continue;
    if (!render::traits(method).aims) {
      list.push_back({test_name(name), method, Distance::density, Transmittance::march, false});
      continue;
    }
    // Such a method heeds of a mixture whether it aims and whether it takes the density: one way for each
    // answer.
    std::set<std::pair<bool, bool>> answers;
    for (const auto& [mixture, distance] : all_distances()) {
      const render::DistanceInfo& info = render::info(distance);
      const bool aims = info.has(&render::StrategyTraits::aims_at_light);
      if (!answers.emplace(aims, info.includes<render::DensityStrategy>()).second) continue;
      list.push_back({test_name(name) + (distance == Distance::mis ? "" : test_name(mixture)), method,
                      distance, Transmittance::series, true});
    }
  }
  return list;
}

}  // namespace tyndall::support
