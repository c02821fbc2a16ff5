// Stable forms of the expressions in which transport loses digits (docs: transport §7).
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace tyndall {

inline constexpr double pi = std::numbers::pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr float infinity_f = std::numeric_limits<float>::infinity();
inline constexpr double inv_4pi = 0.25 / std::numbers::pi;
// The largest float below one: uniform samples never reach 1.
inline constexpr float one_minus_ulp_f = 0x1.fffffep-1f;
inline constexpr double one_minus_ulp = 0x1.fffffffffffffp-1;

// (1 - e^-x)/x for x >= 0: 1 at 0, 1/x when e^-x vanishes.
// The integral of transmittance over a segment of length d is d * exp_average(sigma_t * d).
inline double exp_average(double x) {
  // Taylor's series: the first term left out, x^10/11!, is below 3e-14 of the sum.
  if (x < 0.25) {
    constexpr double c[] = {1,          -1.0 / 2,   1.0 / 6,      -1.0 / 24,    1.0 / 120,
                            -1.0 / 720, 1.0 / 5040, -1.0 / 40320, 1.0 / 362880, -1.0 / 3628800};
    const double x2 = x * x, x4 = x2 * x2;
    return (c[0] + c[1] * x + x2 * (c[2] + c[3] * x)) +
           x4 * ((c[4] + c[5] * x + x2 * (c[6] + c[7] * x)) + x4 * (c[8] + c[9] * x));
  }
  return -std::expm1(-x) / x;
}

template <class T>
constexpr T sqr(T x) {
  return x * x;
}

// A square root that maps the small negative arguments of rounding to zero.
template <class T>
T safe_sqrt(T x) {
  return std::sqrt(std::max(T(0), x));
}

template <class T>
constexpr T lerp(T a, T b, T t) {
  return a + (b - a) * t;
}

}  // namespace tyndall
