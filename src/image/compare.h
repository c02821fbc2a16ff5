// Numbers that say how far one picture is from another.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "image/image.h"

namespace tyndall::image {

struct Comparison {
  double relative_mse = 0;  // mean((x - r)² / (r² + e)), e = 0.01 mean(r)²; 0 when the pictures are equal
  double mse = 0;
  double max_difference = 0;  // greatest |x - r|
  double mean = 0, reference_mean = 0;
  double reference_max = 0;
  std::uint64_t not_finite = 0;  // values of either picture; when there are any, the numbers above are NaN

  // Peak signal to noise ratio [dB]; infinite for equal pictures.
  double psnr(double peak) const;
};

// Compares x with the reference, which must have the same size and channels. The reference alone sets the
// scale e, so that a black picture fails in a dim scene too.
Comparison compare(const Image& x, const Image& reference);

// Each pixel's error relative to the reference: the root of its share in relative_mse. One channel; NaN where
// a value is not finite.
Image relative_errors(const Image& x, const Image& reference);

// Values of a picture that are NaN or infinite.
std::uint64_t count_not_finite(const Image& image);
// The first of them in words: "NaN at pixel 3,7 in R"; empty when there is none.
std::string first_not_finite(const Image& image);

// Makes both 0 where both are infinite: a depth in which neither meets anything is no difference.
void clear_common_infinities(Image& a, Image& b);

}  // namespace tyndall::image
