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
