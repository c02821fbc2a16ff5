// Numbers as colours.
#pragma once

#include <array>

#include "image/image.h"

namespace tyndall::image {

using SrgbColor = std::array<double, 3>;  // sRGB values in [0, 1]

inline constexpr SrgbColor color_of_no_number{1, 0, 1};

// Of a level from 0 to 1. Rises evenly in lightness, so that what looks brighter is more, and passes through
// hues that tell levels apart.
SrgbColor color_of_level(double level);

// A picture of R, G and B that shows the first channel so, from 0 to `most`; what is not finite in magenta.
Image in_false_colors(const Image& numbers, double most = 1);

}  // namespace tyndall::image
