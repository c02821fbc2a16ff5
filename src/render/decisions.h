// Names of the random decisions of a path: one Sobol' sequence each (see base/sampler.h).
#pragma once

#include <cstdint>

namespace tyndall::render {

enum class Decision : std::uint8_t {
  pixel,          // pixel 2, lens 2
  jitter,         // of the march
  end_or_volume,  // which continuation
  distance,       // of a flight: channel, t
  continuation,   // 2 of the direction, t, channel, lobe, one more of the direction
  light,          // light, strategy, t, 2 of the light's surface
  light_surface,  // the same at surfaces
  shadow,         // offset of shadow marches
  roulette,
  flight,             // null collisions
  aimed,              // light, -, t, 2 of the light's surface
  time,               // of a path, while the shutter is open
  emission,           // cell of a medium that emits, 3 of the point in it
  emission_surface,   // the same at surfaces
  emission_distance,  // of the place that it lights: channel, t
  sunward,            // 2 of the direction, light, lobe, one more of the direction
};

// A branch of a path: a camera ray continues both in the volume and behind it, which has bit 0; rays towards
// distant lights have bit 1.
inline constexpr std::uint32_t behind_branch = 1, sunward_branch = 2;

// The sequence of a decision at one path segment.
constexpr std::uint64_t decision(Decision d, std::uint32_t depth, std::uint32_t branch) {
  return (std::uint64_t{depth} << 16) | (std::uint64_t{branch} << 8) | static_cast<std::uint64_t>(d);
}

}  // namespace tyndall::render
