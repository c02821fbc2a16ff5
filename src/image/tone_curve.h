// Curves from exposed light to the light of a display.
#pragma once

#include "base/vec.h"
#include "image/view.h"

namespace tyndall::image {

// Linear Rec. 709 in [0, 1] of any light: negative and NaN are no light, infinite is as bright as can be.
//
// film: What is below 0.6 stays as it is; of what is brighter each channel goes to 1 on the hyperbola of the
//   Khronos PBR Neutral tone mapper. Before, each takes a twentieth of the mean of the three, so that bright
//   light runs to white whatever its colour, as it does on film.
// agx: T. Sobotka's AgX, with the polynomial that B. Wrensch fitted to its sigmoid ("Minimal AgX
//   Implementation", 2023). Sixteen and a half stops are shown, 2^-12.5 to 2^4; colours lose saturation as
//   film does on the way to white.
// neutral: the Khronos PBR Neutral tone mapper (specification of 2024). What is below 0.8 stays as it is but
//   for 0.04; what is brighter is compressed.
// none: clamped.
Rgb tone_curve(Tonemap tonemap, const Rgb& light);

}  // namespace tyndall::image
