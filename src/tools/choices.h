// Names of the renderer's methods on the command line.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/render.h"

namespace tyndall::tools {

template <class Method>
using Choice = std::pair<std::string_view, Method>;

// A table of names in the order of an enumeration, as choices.
template <class Method, std::size_t count>
constexpr std::array<Choice<Method>, count> choices_of(const std::array<std::string_view, count>& names) {
  std::array<Choice<Method>, count> out;
  for (std::size_t i = 0; i < count; ++i) out[i] = {names[i], static_cast<Method>(i)};
  return out;
}
inline constexpr auto methods = choices_of<render::Method>(render::method_names);
inline constexpr auto distances = choices_of<render::Distance>(render::distance_names);
inline constexpr auto transmittances = choices_of<render::Transmittance>(render::transmittance_names);
inline constexpr std::array emissions{Choice<bool>{"sampled", true}, Choice<bool>{"met", false}};

// The name of a method; every one is in its table.
template <class Method, std::size_t count>
constexpr std::string_view name_in(const std::array<Choice<Method>, count>& table, Method method) {
  for (const auto& [name, entry] : table)
    if (entry == method) return name;
  return {};
}
constexpr std::string_view name(render::Method method) { return name_in(methods, method); }
constexpr std::string_view name(render::Distance method) { return name_in(distances, method); }
constexpr std::string_view name(render::Transmittance method) { return name_in(transmittances, method); }

// All names of a table.
template <class Method, std::size_t count>
std::vector<std::string_view> names_of(const std::array<Choice<Method>, count>& table) {
  std::vector<std::string_view> names;
  for (const auto& [name, method] : table) names.push_back(name);
  return names;
}

// All names of a table with this between them.
template <class Method, std::size_t count>
std::string names_of(const std::array<Choice<Method>, count>& table, std::string_view between) {
  std::string names;
  for (const auto& [name, method] : table) {
    if (!names.empty()) names += between;
    names += name;
  }
  return names;
}

}  // namespace tyndall::tools
