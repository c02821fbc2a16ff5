// Ranges of whole numbers that the scene and the command line both give: one limit for both.
#pragma once

#include <cstdint>

namespace tyndall::scene {

// Both ends included.
struct WholeRange {
  std::int64_t least = 0, most = 0;
  constexpr bool holds(std::int64_t value) const { return least <= value && value <= most; }
};

inline constexpr WholeRange resolution_range{1, 16384};  // a side [pixels]: the film stays addressable
inline constexpr WholeRange samples_range{1, 1 << 30};   // a pixel
inline constexpr WholeRange light_samples_range{1, 65536};
inline constexpr WholeRange bounces_range{0, 1 << 30};
// Fits an int with room to spare.
inline constexpr WholeRange frame_range{-1'000'000'000, 1'000'000'000};

}  // namespace tyndall::scene
