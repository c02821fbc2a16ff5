// What a scene's text costs in a process of its own, and numbers beside their targets.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "measured_child.h"

namespace tyndall {

enum class Until { parsed, resolved, compiled };

// Laps: lex, parse, resolve, compile. `name` is the scene's path, from which its files are found. Nothing,
// with the problems printed to stderr, when it has any.
std::optional<Cost> cost_of_scene(const std::string& name, const std::string& text, Until until);

inline constexpr double megabyte = 1e6;

// Prints a number beside its target; false when it misses it.
bool print_target(std::string_view what, double found, std::string_view unit, double target, bool at_most);

}  // namespace tyndall
