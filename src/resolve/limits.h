// The limits of the language: beyond them a scene is taken for a mistake, so that no input exhausts the
// machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace tyndall::resolve {

inline constexpr int max_template_depth = 128;  // templates and objects within each other
inline constexpr int max_include_depth = 64;
inline constexpr int max_block_depth = 500;  // blocks within blocks within calls: bounds the stack
inline constexpr long max_repetitions = 10'000'000;
inline constexpr std::uintmax_t max_file_bytes = std::uintmax_t{256} << 20;

// Each stands in the scene by itself, wherever it comes from.
inline constexpr int max_lights = 1'000'000, max_volumes = 1'000'000;
inline constexpr std::size_t max_objects = 1'000'000;
inline constexpr std::size_t max_combined_parts = 1000;  // of one combination, with all in it
inline constexpr std::size_t max_combined_depth = 32;    // combinations within each other
inline constexpr std::size_t max_curve_points = 10'000'000;

struct Limit {
  std::string_view name;  // as the manual has it
  std::int64_t value;
  std::string_view what;
};

// All of them, those of the lower layers too: for the manual, and for the tests that meet each.
std::span<const Limit> limits();

}  // namespace tyndall::resolve
