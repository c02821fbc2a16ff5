// Names of the random decisions of a path: one Sobol' sequence each (see base/sampler.h).
#pragma once

#include <cstdint>

#include "base/sampler.h"

namespace tyndall::render {

enum class Decision : std::uint8_t {
  pixel,          // pixel 2, lens 2
  jitter,         // of the march
  distance,       // of a free path: channel, t
  continuation,   // 2 of the direction, t or surface lobe, medium or surface, lobe, one more of the direction
  light,          // 2 of the light's surface, t, light
  light_surface,  // the same at surfaces
  shadow,         // offset of shadow marches
  roulette,
  free_path,          // null collisions
  aimed,              // the same of free paths
  time,               // of a path, while the shutter is open
  emission,           // cell of a medium that emits, 3 of the point in it
  emission_surface,   // the same at surfaces
  emission_distance,  // of the place that it lights: t
  distant_guiding,    // 2 of the direction, light, lobe, one more of the direction
  lamp_guiding,       // 2 of the direction, lamp, whether a ray is sent, 4 of which lamps it may be sent to
  lamp_guiding_surface,  // the same at surfaces
};

// A branch of a path: a camera ray continues both in the volume and behind it, which has bit 0; rays towards
// distant lights have bit 1, those towards lamps bit 2.
inline constexpr std::uint32_t behind_branch = 1, guided_branch = 2, lamp_branch = 4;

// The sequence of a decision at one path segment.
constexpr std::uint64_t decision(Decision d, std::uint32_t depth, std::uint32_t branch) {
  return (std::uint64_t{depth} << 16) | (std::uint64_t{branch} << 8) | static_cast<std::uint64_t>(d);
}

// The numbers of one segment of a path.
struct PathNumbers {
  const Sampler* sampler = nullptr;
  std::uint32_t depth = 0, branch = 0;

  SobolPoint point(Decision d) const { return sampler->point(decision(d, depth, branch)); }
  // Point k of `count` that are taken together.
  SobolPoint point(Decision d, int k, int count) const {
    return sampler->point(decision(d, depth, branch), static_cast<std::uint32_t>(k),
                          static_cast<std::uint32_t>(count));
  }
  std::uint32_t bits(Decision d, std::uint64_t counter) const {
    return sampler->bits(decision(d, depth, branch), counter);
  }
};

}  // namespace tyndall::render
