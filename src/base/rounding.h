// Floats on a side of a double, so that a float interval holds a double one.
#pragma once

#include <cmath>
#include <limits>

namespace tyndall {

// The next float below the nearest one, and so below `v`.
inline float float_below(double v) {
  return std::nextafter(static_cast<float>(v), -std::numeric_limits<float>::infinity());
}
// The next float above the nearest one, and so above `v`.
inline float float_above(double v) {
  return std::nextafter(static_cast<float>(v), std::numeric_limits<float>::infinity());
}

}  // namespace tyndall
