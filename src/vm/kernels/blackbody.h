// The colour of a black body by temperature, tabulated.
#pragma once

#include <array>

#include "base/interval.h"

namespace tyndall::vm {

inline constexpr int blackbody_entries = 1025;
inline constexpr float blackbody_coolest = 500.0f;  // kelvin; below it the colour is the same red

// Linear Rec. 709 with luminance 1, at entry i for the temperature blackbody_coolest (entries - 1) / i.
struct BlackbodyTable {
  std::array<float, blackbody_entries> red, green, blue;
  Interval<float> red_range, green_range, blue_range;  // the least and the largest entry
};
const BlackbodyTable& blackbody_table();

}  // namespace tyndall::vm
