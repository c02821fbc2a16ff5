// Extremes of gradient noise over all hashes: what its bounds are made of.
#pragma once

namespace tyndall::vm {

struct NoiseConstants {
  float supremum;       // of |noise|
  float slope;          // of the slope along one axis
  float curvature;      // of the sum of |d2 noise / di dj| over all i and j
  float curvature_row;  // of the sum of |d2 noise / di dj| over all j, for one i
};

// In three dimensions 1.03636, 3.75, 43.391, 17.960; in four 1.02439, 3.75, 57.001, 19.768, found by
// tests/vm/noise_constants_test.cpp and rounded up.
inline constexpr NoiseConstants noise_constants3 = {1.0364f, 3.7501f, 43.4f, 17.97f};
inline constexpr NoiseConstants noise_constants4 = {1.0245f, 3.7501f, 57.2f, 19.80f};

}  // namespace tyndall::vm
