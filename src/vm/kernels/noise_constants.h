// Extremes of gradient noise over all hashes, of which its bounds are made, and means.
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

// Means of |noise| and of (1 - |noise|)^2 in three and four dimensions, measured over 5e7 points (standard
// error below 4e-5) and tested.
inline constexpr float mean_absolute3 = 0.22017f, mean_absolute4 = 0.15851f;
inline constexpr float mean_ridge3 = 0.63258f, mean_ridge4 = 0.72108f;

}  // namespace tyndall::vm
