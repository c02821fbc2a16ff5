// The most that one path may bring to a pixel.
#pragma once

#include <string>
#include <string_view>

#include "base/numerics.h"

namespace tyndall::scene {

// Limits of the light of one camera sample [radiance], of what was scattered once and of what was scattered
// more often. What the camera ray meets by itself has none. Infinite: no limit.
struct Clamp {
  static constexpr std::string_view off = "off";
  double direct = infinity, indirect = infinity;

  constexpr bool limits() const { return direct < infinity || indirect < infinity; }
  bool operator==(const Clamp&) const = default;
};

// As a scene says it: "off", "4", "(off, 4)".
std::string describe(const Clamp& clamp);

}  // namespace tyndall::scene
