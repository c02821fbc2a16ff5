// Intervals of powers, exponentials, angles, hashes and the black body's colour.
#if defined(TYNDALL_VM_KERNELS_INTERVAL_FUNCTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_INTERVAL_FUNCTIONS_INL_H_
#undef TYNDALL_VM_KERNELS_INTERVAL_FUNCTIONS_INL_H_
#else
#define TYNDALL_VM_KERNELS_INTERVAL_FUNCTIONS_INL_H_
#endif

#include "base/interval.h"
#include "vm/kernels/blackbody-inl.h"
#include "vm/kernels/exponential-inl.h"
#include "vm/kernels/hash-inl.h"
#include "vm/kernels/interval-inl.h"
#include "vm/kernels/pairs-inl.h"
#include "vm/kernels/trigonometric-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Kernels that are one long chain are run at both ends of a bound at once.
TYNDALL_VM_BOUND1(exp) {
  const FloatsPair e = op_exp(options, FloatsPair(a.lo, a.hi));
  const Bound<V> ends = from_to(e.a, e.b, a.nan);
  const Bound<V> wide = widened(ends, kernel_error, least_float);
  return {greater(wide.lo, V(0.0f)), wide.hi, wide.nan};
}
TYNDALL_VM_BOUND1(log) {
  const V zero(0.0f);
  const FloatsPair l = op_log(options, FloatsPair(greater(a.lo, zero), greater(a.hi, zero)));
  const Bound<V> ends = from_to(l.a, l.b, either(a.nan, a.lo < zero));
  return widened(ends, kernel_error, least_float);
}

// x^y of x >= 0: a product of y and log x, so its extremes are at the corners; x^0 is 1 for any x.
template <class V>
TYNDALL_VM_INLINE Bound<V> power_of_positive(const Options& options, Bound<V> x, Bound<V> y) {
  const V zero(0.0f);
  if (all(both(both(y.lo == y.hi, y.lo > zero), is_bounded(x)))) {
    // Rises from exactly 0. Below the normal numbers, and for results there, the kernel is slower, and 0 is
    // near enough: such lanes compute a power of 1 instead.
    const V least(0x1p-126f), one(1.0f);
    const auto none = x.lo < least, nothing = x.hi == zero;
    const FloatsPair p =
        op_pow(options, FloatsPair(select(none, one, x.lo), select(nothing, one, greater(x.hi, least))),
               FloatsPair(y.lo, y.lo));
    const Bound<V> rising = widened(from_to(p.a, p.b, either(x.nan, y.nan)), kernel_error, least_float);
    return {select(none, zero, greater(rising.lo, zero)), select(nothing, zero, rising.hi), rising.nan};
  }
  const FloatsPair p = op_pow(options, FloatsPair(x.lo, x.hi), FloatsPair(y.lo, y.lo));
  Bound<V> result = {lesser(p.a, p.b), greater(p.a, p.b), never(p.a)};
  if (any(!(y.lo == y.hi))) {
    const FloatsPair r = op_pow(options, FloatsPair(x.lo, x.hi), FloatsPair(y.hi, y.hi));
    result = {lesser(result.lo, lesser(r.a, r.b)), greater(result.hi, greater(r.a, r.b)), never(p.a)};
    const auto one = holds(y, V(0.0f));
    result = {select(one, lesser(result.lo, V(1.0f)), result.lo),
              select(one, greater(result.hi, V(1.0f)), result.hi), never(p.a)};
  }
  result = widened(result, kernel_error, least_float);
  return {greater(result.lo, V(0.0f)), result.hi, either(result.nan, either(x.nan, y.nan))};
}
// Of a base that may be negative: NaN but for whole exponents, whose power is even or odd.
TYNDALL_VM_BOUND2(pow) {
  const V zero(0.0f);
  const Bound<V> size = size_of(a), positive = power_of_positive(options, size, b);
  const auto may_be_negative = !(a.lo >= zero);
  // -0 to an odd power keeps its sign, and to a negative one is -infinity.
  const auto holds_zero = both(holds(a, zero), b.lo < zero);
  if (!any(either(may_be_negative, holds_zero))) return positive;
  const auto whole = both(b.lo == b.hi, floor(b.lo) == b.lo);
  const auto even = both(whole, floor(b.lo * V(0.5f)) * V(2.0f) == b.lo);
  const auto broken = both(b.lo == b.hi, !whole);
  const Bound<V> mirrored = {-positive.hi, positive.hi, positive.nan};
  // Odd and rising: the ends' own powers.
  const auto odd_rising = both(both(whole, !even), b.lo > zero);
  const FloatsPair odd = op_pow(options, FloatsPair(a.lo, a.hi), FloatsPair(b.lo, b.lo));
  const Bound<V> rising = widened(from_to(odd.a, odd.b, either(a.nan, b.nan)), kernel_error, least_float);
  Bound<V> result = choose(either(even, broken), positive, choose(odd_rising, rising, mirrored));
  result.nan = either(result.nan, !whole);
  return choose(either(may_be_negative, holds_zero), result, positive);
}

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

// A hash is known at a point only.
template <class V>
TYNDALL_VM_INLINE Bound<V> hashed(MaskOf<V> known, V value) {
  return {select(known, value, V(0.0f)), select(known, value, V(1.0f - 0x1p-23f)), never(value)};
}
template <class V>
TYNDALL_VM_INLINE MaskOf<V> is_point(Bound<V> a) {
  return both(a.lo == a.hi, !a.nan);
}
TYNDALL_VM_BOUND1(random1) { return hashed(is_point(a), op_random1(options, a.lo)); }
TYNDALL_VM_BOUND2(random2) { return hashed(both(is_point(a), is_point(b)), op_random2(options, a.lo, b.lo)); }
TYNDALL_VM_BOUND3(random3) {
  return hashed(both(both(is_point(a), is_point(b)), is_point(c)), op_random3(options, a.lo, b.lo, c.lo));
}
TYNDALL_VM_BOUND4(random4) {
  return hashed(both(both(is_point(a), is_point(b)), both(is_point(c), is_point(d))),
                op_random4(options, a.lo, b.lo, c.lo, d.lo));
}

// Between two temperatures the component's two ends, while both lie between the same entries of the table,
// where the kernel is a straight line; otherwise the whole table's extremes.
template <class V>
TYNDALL_VM_INLINE Bound<V> blackbody_bound(Bound<V> kelvin, const float* table, Interval<float> range) {
  const auto place = [&](V k) HWY_ATTR {
    return floor(V(blackbody_coolest * (blackbody_entries - 1)) / greater(k, V(blackbody_coolest)));
  };
  const V p = blackbody_component(kelvin.lo, table), q = blackbody_component(kelvin.hi, table);
  const auto one_line = both(place(kelvin.lo) == place(kelvin.hi), is_bounded(kelvin));
  const Bound<V> result = {select(one_line, lesser(p, q), V(range.lo)),
                           select(one_line, greater(p, q), V(range.hi)), kelvin.nan};
  return widened(result, kernel_error, least_float);
}
TYNDALL_VM_BOUND1(blackbody_r) {
  return blackbody_bound(a, blackbody_table().red.data(), blackbody_table().red_range);
}
TYNDALL_VM_BOUND1(blackbody_g) {
  return blackbody_bound(a, blackbody_table().green.data(), blackbody_table().green_range);
}
TYNDALL_VM_BOUND1(blackbody_b) {
  return blackbody_bound(a, blackbody_table().blue.data(), blackbody_table().blue_range);
}

// Anywhere in the picture. NaN is looked up at 0, so the value is always a number.
TYNDALL_VM_BOUND2(plane) {
  const Plane& plane = *options.planes[options.seed];
  return widened(Bound<V>{V(plane.lowest), V(plane.highest), never(a.lo + b.lo)}, kernel_error, least_float);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
