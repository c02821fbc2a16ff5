// Loops over the segments of a march that depend on none before, compiled for every SIMD class (Highway).
// Sums and products are not fused, so all classes give the same numbers.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vec.h"

namespace tyndall::render {

inline constexpr std::size_t widest_lanes = 8;

// `count` segments of one length dt [m], one behind the other from `begin` [m].
void lay_uniform_segments(double begin, double dt, std::size_t count, double* t0, double* dts);

// Samples [first, first + count) of a march, of which each is taken somewhere in its segment: sample k at
// t0[k] + jitter(seed, first + k, paired) dt[k]. Arrays start at sample `first`.
struct SegmentSamples {
  const double* t0;
  const double* dt;
  std::uint32_t seed, first;
  std::size_t count;
  bool paired = true;
};
// The same, of segments of one length from `begin` on.
struct UniformSamples {
  double begin, dt;
  std::uint32_t seed, first;
  std::size_t count;
  bool paired = true;
};
// At given places.
struct PlacedSamples {
  const double* t;
  std::size_t count;
};

// Their coordinates on the line origin + t direction.
void put_on_line(const SegmentSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                 float* y, float* z);
void put_on_line(const UniformSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                 float* y, float* z);
void put_on_line(const PlacedSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                 float* y, float* z);

// What segments of extinction sigma_t [1/m] and length dt [m] let through, e^-(sigma_t dt), and the integral
// of transmittance over each, (1 - through) / sigma_t [m]: dt where there is no extinction. Both are right to
// 3e-14 of their value and one rounding of the depth, in haze as in stone; less than 1e-307 is let through as
// 0. Arrays are read and written from `first` up to, not including, `end`.
void transmit_segments(const float* sigma_t, const double* dt, std::size_t first, std::size_t end,
                       double* through, double* reach);

}  // namespace tyndall::render
