// Russian roulette for rays on which little light passes any more: what lies behind is evaluated by chance,
// and counts the more where it is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/sampler.h"

namespace tyndall::render {

// The optical depth beyond which chance is asked.
inline constexpr double roulette_depth = 4;

// How many segments of length `step` [m] are evaluated before chance is asked, where nothing is denser than
// `majorant` [1/m]: fewer never reach that depth, or are too few to fill batches.
inline std::uint32_t segments_before_roulette(double majorant, double step) {
  constexpr double least = 16, most = 4096;
  return static_cast<std::uint32_t>(std::clamp(std::ceil(roulette_depth / (majorant * step)), least, most));
}
// Of a ray's `count` segments, those up to the end of a round, with `first` in the first: each round takes
// twice as many as the one before. No more than `first` are left for a round of their own.
inline std::uint32_t segments_until(std::uint32_t first, std::uint32_t round, std::uint32_t count) {
  const std::uint64_t end = (std::uint64_t{2} << std::min(round, 30u)) * first - first;
  return count <= end + first ? count : static_cast<std::uint32_t>(end);
}

// Up to that depth all go on; beyond, as many as keep what passes at e^-roulette_depth, but one of twenty at
// least.
inline double transmittance_survival(double transmittance) {
  constexpr double least_survival = 0.05;
  return std::clamp(transmittance / std::exp(-roulette_depth), least_survival, 1.0);
}

// `seed` names the ray, `round` tells one decision on it from the next.
inline bool survives_transmittance_roulette(std::uint32_t seed, std::uint32_t round, double survival) {
  constexpr std::uint64_t roulette_seed = 0xda7cull << 32;
  return unit_float(static_cast<std::uint32_t>(hash_bits(seed, roulette_seed + round) >> 32)) < survival;
}

}  // namespace tyndall::render
