// sin, cos, tan and their inverses, in radians. Polynomials of Moshier's Cephes. In double they are the C
// library's.
#if defined(TYNDALL_VM_KERNELS_TRIGONOMETRIC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_TRIGONOMETRIC_INL_H_
#undef TYNDALL_VM_KERNELS_TRIGONOMETRIC_INL_H_
#else
#define TYNDALL_VM_KERNELS_TRIGONOMETRIC_INL_H_
#endif

#include <cmath>
#include <limits>

#include "vm/kernels/arithmetic-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Beyond this the reduction below loses digits, and the C library is asked, lane by lane.
inline constexpr float reduction_limit = 6000.0f;

inline float library_sin(float a) { return static_cast<float>(std::sin(static_cast<double>(a))); }
inline float library_cos(float a) { return static_cast<float>(std::cos(static_cast<double>(a))); }
inline float library_tan(float a) { return static_cast<float>(std::tan(static_cast<double>(a))); }

// a = quadrant pi/2 + rest with |rest| <= pi/4. Cody and Waite: pi/2 in three parts of 12 bits and a last
// one; up to the limit the quadrant has 12 bits, so the first three products are exact.
template <class V, class B>
struct Reduced {
  V rest;
  B quadrant;
};
template <class V>
TYNDALL_VM_INLINE auto reduce(V a) {
  const V magic(round_magic);
  const V k_magic = a * V(0x1.45f306p-1f) + magic;  // 2 / pi
  const V k = k_magic - magic;
  const V rest =
      ((a - k * V(0x1.92p+0f)) - k * V(0x1.fb4p-12f)) - k * V(0x1.444p-24f) - k * V(0x1.68c234p-39f);
  return Reduced<V, decltype(bits(a))>{rest, bits(k_magic)};
}
template <class V>
TYNDALL_VM_INLINE V sin_of_reduced(V x) {
  const V z = x * x;
  return ((V(-1.9515295891e-4f) * z + V(8.3321608736e-3f)) * z + V(-1.6666654611e-1f)) * z * x + x;
}
template <class V>
TYNDALL_VM_INLINE V cos_of_reduced(V x) {
  const V z = x * x;
  const V poly = (V(2.443315711809948e-5f) * z + V(-1.388731625493765e-3f)) * z + V(4.166664568298827e-2f);
  return poly * z * z - V(0.5f) * z + V(1.0f);
}
// Lanes whose quadrant is odd.
template <class V, class B>
TYNDALL_VM_INLINE auto is_odd(B quadrant) {
  return less_signed(quadrant << 31, B(0u));
}
template <class V>
TYNDALL_VM_INLINE auto needs_library(V a) {
  return both(abs(a) > V(reduction_limit), abs(a) < V(std::numeric_limits<float>::infinity()));
}

TYNDALL_VM_KERNEL1(sin) {
  const auto reduced = reduce(a);
  const V x = reduced.rest;
  const V value = select(is_odd<V>(reduced.quadrant), cos_of_reduced(x), sin_of_reduced(x));
  const V result = flip_sign(value, reduced.quadrant << 30);
  const auto large = needs_library(a);
  const V exact_zero = select(a == V(0.0f), a, result);
  return any(large) ? replace_lanes(large, a, exact_zero, library_sin) : exact_zero;
}
TYNDALL_VM_KERNEL1(cos) {
  const auto reduced = reduce(a);
  const V x = reduced.rest;
  const V value = select(is_odd<V>(reduced.quadrant), sin_of_reduced(x), cos_of_reduced(x));
  const V result = flip_sign(value, (reduced.quadrant + 1) << 30);
  const auto large = needs_library(a);
  return any(large) ? replace_lanes(large, a, result, library_cos) : result;
}
TYNDALL_VM_KERNEL1(tan) {
  const auto reduced = reduce(a);
  const V sine = sin_of_reduced(reduced.rest), cosine = cos_of_reduced(reduced.rest);
  const auto odd = is_odd<V>(reduced.quadrant);
  const V result = select(odd, -cosine, sine) / select(odd, sine, cosine);
  const auto large = needs_library(a);
  const V exact_zero = select(a == V(0.0f), a, result);
  return any(large) ? replace_lanes(large, a, exact_zero, library_tan) : exact_zero;
}
inline double op_sin(const Options&, double a) { return std::sin(a); }
inline double op_cos(const Options&, double a) { return std::cos(a); }
inline double op_tan(const Options&, double a) { return std::tan(a); }

inline constexpr float half_pi = 0x1.921fb6p+0f;
inline constexpr float half_pi_low = -0x1.777a5cp-25f;  // pi/2 - half_pi

// asin on [0, 1/2].
template <class V>
TYNDALL_VM_INLINE V asin_of_small(V x, V z) {
  V poly(4.2163199048e-2f);
  poly = poly * z + V(2.4181311049e-2f);
  poly = poly * z + V(4.5470025998e-2f);
  poly = poly * z + V(7.4953002686e-2f);
  poly = poly * z + V(1.6666752422e-1f);
  return poly * z * x + x;
}

// NaN outside [-1, 1].
TYNDALL_VM_KERNEL1(asin) {
  const V x = abs(a);
  const auto small = x <= V(0.5f);
  const V z = select(small, x * x, V(0.5f) * (V(1.0f) - x));  // sin^2 of half the complement
  const V y = asin_of_small(select(small, x, sqrt(z)), z);
  return flip_sign(select(small, y, V(half_pi) - (y + y - V(half_pi_low))), bits(a));
}
TYNDALL_VM_KERNEL1(acos) {
  const V x = abs(a);
  const auto small = x <= V(0.5f);
  const V z = select(small, x * x, V(0.5f) * (V(1.0f) - x));
  const V y = asin_of_small(select(small, x, sqrt(z)), z);
  const V near_middle = V(half_pi) - (flip_sign(y, bits(a)) - V(half_pi_low));
  const V near_end = select(a < V(0.0f), V(2 * half_pi) - (y + y - V(2 * half_pi_low)), y + y);
  return select(small, near_middle, near_end);
}
inline double op_asin(const Options&, double a) { return std::asin(a); }
inline double op_acos(const Options&, double a) { return std::acos(a); }

// atan(y / x) for 0 <= y <= x, 0 for 0/0: beyond tan(pi/8) as pi/4 + atan((y - x)/(y + x)).
template <class V>
TYNDALL_VM_INLINE V atan_of_quotient(V y, V x) {
  const V zero(0.0f);
  const auto upper = y > x * V(0.41421356f);
  const V q = select(upper, y - x, y) / select(upper, y + x, x);
  const V t = select(x == zero, zero, q);
  const V z = t * t;
  V poly(8.05374449538e-2f);
  poly = poly * z + V(-1.38776856032e-1f);
  poly = poly * z + V(1.99777106478e-1f);
  poly = poly * z + V(-3.33329491539e-1f);
  const V angle = poly * z * t + t;
  return select(upper, V(0.5f * half_pi) + (angle + V(0.5f * half_pi_low)), angle);
}

TYNDALL_VM_KERNEL1(atan) {
  const V x = abs(a), one(1.0f);
  const auto steep = x > one;
  const V angle = atan_of_quotient(select(steep, one, x), select(steep, x, one));
  return flip_sign(select(steep, V(half_pi) - (angle - V(half_pi_low)), angle), bits(a));
}
// The angle of the point (b, a), with the C library's results for zeros and infinities.
TYNDALL_VM_KERNEL2(atan2) {
  const V infinite(std::numeric_limits<float>::infinity());
  V y = abs(a), x = abs(b);
  const auto both_infinite = both(y == infinite, x == infinite);
  y = select(both_infinite, V(1.0f), y);
  x = select(both_infinite, V(1.0f), x);
  // Scaled down, so that neither x + y nor a quotient of the largest numbers overflows.
  const V scale = select(max_of(x, y) > V(0x1p100f), V(0x1p-27f), V(1.0f));
  x = x * scale;
  y = y * scale;
  const auto steep = y > x;
  V angle = atan_of_quotient(select(steep, x, y), select(steep, y, x));
  angle = select(steep, V(half_pi) - (angle - V(half_pi_low)), angle);
  const auto left = flip_sign(V(1.0f), bits(b)) < V(0.0f);
  angle = select(left, V(2 * half_pi) - (angle - V(2 * half_pi_low)), angle);
  angle = select(either(a != a, b != b), a + b, angle);
  return flip_sign(angle, bits(a));
}
inline double op_atan(const Options&, double a) { return std::atan(a); }
inline double op_atan2(const Options&, double a, double b) { return std::atan2(a, b); }

// Whether a peak at phase + 2 pi k lies between the ends; true when unsure. Beyond 2^12 float arguments are
// too coarse to tell.
template <class V>
TYNDALL_VM_INLINE MaskOf<V> may_hold_peak(Bound<V> a, float phase, float turns_per_radian) {
  const V margin(1e-3f);
  const V first = floor((a.lo - V(phase)) * V(turns_per_radian) - margin);
  const V last = floor((a.hi - V(phase)) * V(turns_per_radian) + margin);
  return !both(first == last, largest_size(a) < V(4096.0f));
}
template <class V>
TYNDALL_VM_INLINE Bound<V> wave(Bound<V> a, V at_lo, V at_hi, float peak, float trough) {
  constexpr float per_turn = 0.15915494f;
  const V error(0x1p-21f);
  const V hi = select(may_hold_peak(a, peak, per_turn), V(1.0f), greater(at_lo, at_hi) + error);
  const V lo = select(may_hold_peak(a, trough, per_turn), V(-1.0f), lesser(at_lo, at_hi) - error);
  const V most(1.0f + 0x1p-21f);
  return {greater(lo, -most) - error, lesser(hi, most) + error, a.nan};
}
TYNDALL_VM_BOUND1(sin) { return wave(a, op_sin(options, a.lo), op_sin(options, a.hi), half_pi, -half_pi); }
TYNDALL_VM_BOUND1(cos) { return wave(a, op_cos(options, a.lo), op_cos(options, a.hi), 0.0f, 2 * half_pi); }
TYNDALL_VM_BOUND1(tan) {
  const auto pole = may_hold_peak(a, half_pi, 0.31830989f);
  const Bound<V> ends = from_to(op_tan(options, a.lo), op_tan(options, a.hi), a.nan);
  return choose(pole, anything(a.lo), widened(ends, kernel_error, least_float));
}
template <class V>
TYNDALL_VM_INLINE Bound<V> to_domain(Bound<V> a) {
  const V one(1.0f);
  Bound<V> inside = within(a, -one, one);
  inside.nan = either(a.nan, either(a.lo<-one, a.hi> one));
  return inside;
}
TYNDALL_VM_BOUND1(asin) {
  const Bound<V> x = to_domain(a);
  return widened(from_to(op_asin(options, x.lo), op_asin(options, x.hi), x.nan), kernel_error, least_float);
}
TYNDALL_VM_BOUND1(acos) {
  const Bound<V> x = to_domain(a);
  return widened(from_to(op_acos(options, x.hi), op_acos(options, x.lo), x.nan), kernel_error, least_float);
}
TYNDALL_VM_BOUND1(atan) {
  return widened(from_to(op_atan(options, a.lo), op_atan(options, a.hi), a.nan), kernel_error, least_float);
}
// The directions of a box that does not touch the negative x axis end at its corners.
TYNDALL_VM_BOUND2(atan2) {
  const V zero(0.0f), half_turn(3.1415930f);
  const auto nan = either(a.nan, b.nan);
  const auto cut = both(holds(a, zero), b.lo <= zero);
  const V p = op_atan2(options, a.lo, b.lo), q = op_atan2(options, a.lo, b.hi);
  const V r = op_atan2(options, a.hi, b.lo), s = op_atan2(options, a.hi, b.hi);
  const Bound<V> corners =
      widened(Bound<V>{lesser(lesser(p, q), lesser(r, s)), greater(greater(p, q), greater(r, s)), nan},
              kernel_error, least_float);
  return choose(cut, Bound<V>{-half_turn, half_turn, nan}, corners);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
