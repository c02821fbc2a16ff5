// Numbers that say how far one picture is from another.
#pragma once

#include <cstdint>

#include "image/image.h"

namespace tyndall::image {

struct Comparison {
  double relative_mse = 0;  // mean((x - r)² / (r² + e)), e = 0.01 mean(r)²; 0 when the pictures are equal
  double max_difference = 0;  // greatest |x - r|
  double mean = 0, reference_mean = 0;
  std::uint64_t not_finite = 0;  // values of either picture; when there are any, the numbers above are NaN
};

// Compares x with the reference, which must have the same size and channels. The reference alone sets the
// scale e, so that a black picture fails in a dim scene too.
Comparison compare(const Image& x, const Image& reference);

// Values of a picture that are NaN or infinite.
std::uint64_t count_not_finite(const Image& image);

}  // namespace tyndall::image
