// Ranges of whole numbers that the scene and the command line both give: one limit for both.
#pragma once

#include <concepts>
#include <cstdint>
#include <utility>

namespace tyndall::scene {

// Both ends included.
struct WholeRange {
  std::int64_t least = 0, most = 0;
  constexpr bool holds(std::integral auto value) const {
    return std::cmp_less_equal(least, value) && std::cmp_less_equal(value, most);
  }
};

// Fits an int with room to spare.
inline constexpr WholeRange frame_range{-1'000'000'000, 1'000'000'000};

}  // namespace tyndall::scene
