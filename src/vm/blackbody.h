// The colour of a black body by temperature, tabulated.
#pragma once

#include <array>

namespace tyndall::vm {

inline constexpr int blackbody_entries = 1025;
inline constexpr float blackbody_coolest = 500.0f;  // kelvin; below it the colour is the same red

// Linear Rec. 709 with luminance 1, at entry i for the temperature blackbody_coolest (entries - 1) / i.
struct BlackbodyTable {
  std::array<float, blackbody_entries> red, green, blue;
};
const BlackbodyTable& blackbody_table();

}  // namespace tyndall::vm
