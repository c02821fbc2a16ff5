// Pixels that stick out of their surroundings: fireflies.
#pragma once

#include <vector>

#include "image/image.h"

namespace tyndall::image {

struct Outlier {
  int x = 0, y = 0;
  int excess = 0;  // over the median of the pixels around it, of 255
};

// Pixels whose luminance, as a display shows it without tone curve, is more than `least` of 255 above the
// median of the 8 around them; the worst first. Those at the edges are left out.
std::vector<Outlier> outliers(const Image& picture, int least = 50);

// Their share of the pixels.
double share_of_outliers(const Image& picture);

}  // namespace tyndall::image
