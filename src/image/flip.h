// FLIP: the error that people see when two pictures alternate in the same place, in [0, 1] for each pixel.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", HPG 2020. Of light of any range: Andersson, Nilsson, Shirley and Akenine-Möller,
// "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021 (short papers).
#pragma once

#include "base/numerics.h"
#include "image/image.h"

namespace tyndall::image {

// Of a screen 3840 pixels wide that is as far away as it is wide: 67.02.
inline constexpr double flip_pixels_per_degree = 3840 * pi / 180;

// Errors of the colours of x, a picture of one channel. Both pictures have the same size, and hold linear
// light of which a display shows what is between 0 and 1. NaN counts as 0.
Image flip_ldr(const Image& x, const Image& reference, double pixels_per_degree = flip_pixels_per_degree);
// The largest of those errors at the exposures at which the reference can be looked at: from its brightest
// pixel to its median, at most a stop apart.
Image flip_hdr(const Image& x, const Image& reference, double pixels_per_degree = flip_pixels_per_degree);

// Means of the errors; 0 of pictures without pixels.
double flip_ldr_mean(const Image& x, const Image& reference,
                     double pixels_per_degree = flip_pixels_per_degree);
double flip_hdr_mean(const Image& x, const Image& reference,
                     double pixels_per_degree = flip_pixels_per_degree);

// The exposures of flip_hdr [stops], evenly spaced.
struct ExposureRange {
  double first = 0, last = 0;
  int count = 1;
  double stops(int i) const { return count < 2 ? first : first + i * (last - first) / (count - 1); }
};
ExposureRange flip_exposures(const Image& reference);

}  // namespace tyndall::image
