// What is lit by one light, as if that light were white.
#pragma once

#include "base/vec.h"
#include "image/matrix.h"

namespace tyndall::image {

// Chromatic adaptation after von Kries by the Bradford responses of cones (K. M. Lam 1985; CIECAM97s): the
// colour given becomes grey, with its luminance.
class WhiteBalance {
 public:
  // Of the colour of a light (linear Rec. 709). Changes nothing where the light is none that can_balance().
  explicit WhiteBalance(const Rgb& light);

  // Whether all three responses to the light are positive.
  static bool can_balance(const Rgb& light);

  Rgb balanced(const Rgb& color) const { return Rgb(adaptation_ * Vec3d(color)); }

 private:
  Matrix adaptation_{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

}  // namespace tyndall::image
