// Names of the renderer's methods on the command line.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "render/render.h"

namespace tyndall::tools {

template <class Method>
using Choice = std::pair<std::string_view, Method>;

inline constexpr Choice<render::Method> methods[] = {
    {"decoupled", render::Method::decoupled},
    {"brute-force", render::Method::brute_force},
    {"stochastic", render::Method::stochastic},
    {"tracking", render::Method::tracking},
};

inline constexpr Choice<render::Distance> distances[] = {
    {"mis", render::Distance::mis},
    {"density", render::Distance::density},
    {"equiangular", render::Distance::equiangular},
    {"product", render::Distance::product},
};

inline constexpr Choice<render::Transmittance> transmittances[] = {
    {"march", render::Transmittance::march},   {"jackknife", render::Transmittance::jackknife},
    {"ratio", render::Transmittance::ratio},   {"residual-ratio", render::Transmittance::residual_ratio},
    {"series", render::Transmittance::series},
};

inline constexpr Choice<bool> emissions[] = {{"sampled", true}, {"met", false}};

// The name of a method; every one is in its table.
template <class Method, std::size_t count>
constexpr std::string_view name_in(const Choice<Method> (&table)[count], Method method) {
  for (const auto& [name, entry] : table)
    if (entry == method) return name;
  return {};
}
constexpr std::string_view name(render::Method method) { return name_in(methods, method); }
constexpr std::string_view name(render::Distance method) { return name_in(distances, method); }
constexpr std::string_view name(render::Transmittance method) { return name_in(transmittances, method); }

// All names of a table with this between them.
template <class Method, std::size_t count>
std::string names_of(const Choice<Method> (&table)[count], std::string_view between) {
  std::string names;
  for (const auto& [name, method] : table) {
    if (!names.empty()) names += between;
    names += name;
  }
  return names;
}

}  // namespace tyndall::tools
