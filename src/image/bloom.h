// Light that a lens and an eye scatter: a glow around what is bright.
#pragma once

#include "image/colors.h"
#include "image/image.h"

namespace tyndall::image {

// A share of each pixel's colour goes to its surroundings: equal parts to five of them, each four times as
// wide as the one before, up to an eighth of the picture's diagonal, so that the glow falls about with the
// square of the distance. All light stays in the picture: what would leave it comes back as by a mirror.
// Values that are not finite stay where they are and give nothing.
void add_bloom(Image& image, const ColorChannels& channels, double share);

}  // namespace tyndall::image
