// exp, log and pow without fused multiplication. In double they are the C library's.
#if defined(TYNDALL_VM_KERNELS_EXPONENTIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_EXPONENTIAL_INL_H_
#undef TYNDALL_VM_KERNELS_EXPONENTIAL_INL_H_
#else
#define TYNDALL_VM_KERNELS_EXPONENTIAL_INL_H_
#endif

#include <cmath>
#include <limits>

#include "vm/kernels/arithmetic-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// 2^k for whole k in [-126, 127], given k + round_magic.
template <class V>
TYNDALL_VM_INLINE V power_of_two(V k_magic) {
  return from_bits((bits(k_magic) + 127) << 23);
}
// a * 2^k for whole k in [-252, 254], given as a number; in two steps, so that results below the normal range
// are rounded, not lost.
template <class V>
TYNDALL_VM_INLINE V scale_by_power_of_two(V a, V k) {
  const V magic(round_magic);
  const V half_magic = k * V(0.5f) + magic, half = half_magic - magic;
  return a * power_of_two(half_magic) * power_of_two(k - half + magic);
}

// Of vectors whose lanes are all ordinary (as in nearly every shader) the kernels compute less. A lane's
// result is the same to the bit on either way.

// e^r for |r| <= ln(2) / 2; polynomial of Moshier's Cephes expf.
template <class V>
TYNDALL_VM_INLINE V exp_of_reduced(V r) {
  V poly(1.9875691500e-4f);
  poly = poly * r + V(1.3981999507e-3f);
  poly = poly * r + V(8.3334519073e-3f);
  poly = poly * r + V(4.1665795894e-2f);
  poly = poly * r + V(1.6666665459e-1f);
  poly = poly * r + V(5.0000001201e-1f);
  return poly * r * r + r + V(1.0f);
}

// Cody and Waite's reduction.
TYNDALL_VM_KERNEL1(exp) {
  const V magic(round_magic);
  const bool ordinary = all(abs(a) < V(87.0f));
  // Beyond these the result is 0 or infinite in any case; NaN passes.
  const V x = ordinary ? a : lesser(V(100.0f), greater(V(-110.0f), a));
  const V k_magic = x * V(0x1.715476p+0f) + magic, k = k_magic - magic;  // x / ln 2
  const V r = (x - k * V(0.693359375f)) - k * V(-2.12194440e-4f);        // ln 2, high and low
  const V power = exp_of_reduced(r);
  return ordinary ? power * power_of_two(k_magic) : scale_by_power_of_two(power, k);
}
inline double op_exp(const Options&, double a) { return std::exp(a); }

// m in [sqrt(1/2), sqrt(2)) and whole e with a = m 2^e, for positive finite a.
template <class V>
struct Parts {
  V mantissa, exponent;
};
template <class V>
TYNDALL_VM_INLINE Parts<V> split_normal(V a, V bias) {
  const auto pattern = bits(a) + (0x3f800000u - 0x3f3504f3u);
  // The biased exponent in the low bits of 2^23 makes it a number.
  return {from_bits((pattern & 0x007fffffu) + 0x3f3504f3u), from_bits((pattern >> 23) | 0x4b000000u) - bias};
}
template <class V>
TYNDALL_VM_INLINE Parts<V> split_exponent(V a) {
  const auto small = a < V(0x1p-126f);
  return split_normal(select(small, a * V(0x1p24f), a), select(small, V(0x1p23f + 151), V(0x1p23f + 127)));
}
template <class V>
TYNDALL_VM_INLINE auto is_positive_normal(V a) {
  return both(a >= V(0x1p-126f), a < V(std::numeric_limits<float>::infinity()));
}

// Polynomial of Cephes logf.
TYNDALL_VM_KERNEL1(log) {
  const bool ordinary = all(is_positive_normal(a));
  const Parts<V> parts = ordinary ? split_normal(a, V(0x1p23f + 127)) : split_exponent(a);
  const V x = parts.mantissa - V(1.0f), e = parts.exponent;
  V poly(7.0376836292e-2f);
  poly = poly * x + V(-1.1514610310e-1f);
  poly = poly * x + V(1.1676998740e-1f);
  poly = poly * x + V(-1.2420140846e-1f);
  poly = poly * x + V(1.4249322787e-1f);
  poly = poly * x + V(-1.6668057665e-1f);
  poly = poly * x + V(2.0000714765e-1f);
  poly = poly * x + V(-2.4999993993e-1f);
  poly = poly * x + V(3.3333331174e-1f);
  const V square = x * x;
  V y = poly * x * square + e * V(-2.12194440e-4f) - V(0.5f) * square;
  y = (x + y) + e * V(0.693359375f);
  if (ordinary) return y;
  const V infinite = V(std::numeric_limits<float>::infinity());
  y = select(a == infinite, a, y);
  y = select(a == V(0.0f), -infinite, y);
  return select(a >= V(0.0f), y, V(std::numeric_limits<float>::quiet_NaN()));
}
inline double op_log(const Options&, double a) { return std::log(a); }

// The upper 12 bits of the mantissa: products of two such numbers are exact.
template <class V>
TYNDALL_VM_INLINE V upper_half(V a) {
  return from_bits(bits(a) & 0xfffff000u);
}

// A number as the unrounded sum of two; `high` has at most 12 bits of mantissa.
template <class V>
struct Double12 {
  V high, low;
};

// log2 of a positive finite number, to about 2^-32 of its value: with s = (m - 1)/(m + 1) kept in two parts,
// log2 m = 2/(3 ln 2) s (3 + s^2 + 3/5 s^4 + ...). After fdlibm's e_powf.c.
template <class V>
TYNDALL_VM_INLINE Double12<V> log2_in_two(Parts<V> parts) {
  const V f = parts.mantissa - V(1.0f), g = parts.mantissa + V(1.0f);
  const V g_rest = parts.mantissa - (g - V(1.0f));
  const V reciprocal = V(1.0f) / g;
  const V s = f * reciprocal;
  const V s_high = upper_half(s), g_high = upper_half(g);
  const V s_low = reciprocal * ((f - s_high * g_high) - s_high * ((g - g_high) + g_rest));
  const V z = s * s;
  V tail(3.0f / 13);
  tail = tail * z + V(3.0f / 11);
  tail = tail * z + V(3.0f / 9);
  tail = tail * z + V(3.0f / 7);
  tail = tail * z + V(3.0f / 5);
  const V square = s_high * s_high, rest = tail * z * z + s_low * (s_high + s);
  const V factor_high = upper_half(V(3.0f) + square + rest);
  const V factor_low = rest - ((factor_high - V(3.0f)) - square);
  const V u = s_high * factor_high, v = s_low * factor_high + factor_low * s;
  const V p_high = upper_half(u + v), p_low = v - (p_high - u);
  const V y_high = p_high * V(0x1.ec6p-1f),
          y_low = p_high * V(0x1.09dc3ap-13f) + p_low * V(0x1.ec709ep-1f);  // 2 / (3 ln 2)
  const V high = upper_half(parts.exponent + (y_high + y_low));
  return {high, y_low - ((high - parts.exponent) - y_high)};
}

// 2^(high + low), for any sum; low is small against 1 wherever the result is finite.
template <class V>
TYNDALL_VM_INLINE V exp2_of_two(V high, V low) {
  const V magic(round_magic);
  const bool ordinary = all(abs(high + low) < V(125.0f));
  const V x = ordinary ? high + low : lesser(V(160.0f), greater(V(-160.0f), high + low));
  const V k_magic = x + magic, k = k_magic - magic;
  const V rest = (high - k) + low;
  if (ordinary) return exp_of_reduced(rest * V(0x1.62e43p-1f)) * power_of_two(k_magic);
  // Outside the clamp the parts mean nothing, and the result is 0 or infinite.
  const V inside = select(abs(high + low) < V(160.0f), rest, V(0.0f));
  return scale_by_power_of_two(exp_of_reduced(inside * V(0x1.62e43p-1f)), k);
}

// base^exponent for positive finite bases, given its parts.
template <class V>
TYNDALL_VM_INLINE V power_of_parts(Parts<V> base, V exponent) {
  const Double12<V> logarithm = log2_in_two(base);
  const V high_half = upper_half(exponent);
  return exp2_of_two(high_half * logarithm.high,
                     (exponent - high_half) * logarithm.high + exponent * logarithm.low);
}

// C's pow: a negative base takes whole exponents only, pow(0, 0) = 1.
TYNDALL_VM_KERNEL2(pow) {
  if (all(both(is_positive_normal(a), abs(b) <= V(0x1p33f))))
    return power_of_parts(split_normal(a, V(0x1p23f + 127)), b);
  const V zero(0.0f), one(1.0f), infinite(std::numeric_limits<float>::infinity());
  const V base = abs(a);
  // An exponent of 2^33 sends every base but 1 to 0 or infinity.
  V result = power_of_parts(split_exponent(base), lesser(V(0x1p33f), greater(V(-0x1p33f), b)));
  result = select(base == zero, select(b < zero, infinite, zero), result);
  result = select(base == infinite, select(b < zero, zero, infinite), result);
  const auto whole = floor(b) == b;
  const auto odd = both(whole, floor(b * V(0.5f)) * V(2.0f) != b);
  const auto negative = flip_sign(one, bits(a)) < zero;
  result = select(both(odd, negative), -result, result);
  result = select(both(both(a < zero, base < infinite), !whole), V(std::numeric_limits<float>::quiet_NaN()),
                  result);
  result = select(either(a != a, b != b), a + b, result);
  return select(either(b == zero, a == one), one, result);
}
inline double op_pow(const Options&, double a, double b) { return std::pow(a, b); }

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

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
