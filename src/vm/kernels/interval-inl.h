// Intervals of what a lane may hold, and arithmetic, comparisons and choices on them.
//
// A Bound covers a value x of the machine when lo <= x <= hi, or x is NaN and `nan` is set. A kernel here
// covers what the kernel of the same name gives for any operands that the operands cover: not the real
// function, but its floats. Sums, products, quotients and roots are rounded correctly, so they are monotone
// and their ends are exact; what is made of polynomials is widened by more than its error
// (tests/vm/functions_test.cpp). A bound without end always has `nan` set, so operands that may be infinite
// need no case of their own: infinity minus infinity and zero times infinity come from them alone.
#if defined(TYNDALL_VM_KERNELS_INTERVAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_INTERVAL_INL_H_
#undef TYNDALL_VM_KERNELS_INTERVAL_INL_H_
#else
#define TYNDALL_VM_KERNELS_INTERVAL_INL_H_
#endif

#include <limits>
#include <utility>

#include "vm/kernels/arithmetic-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

template <class V>
using MaskOf = decltype(std::declval<V>() < std::declval<V>());

template <class V>
struct Bound {
  V lo, hi;
  MaskOf<V> nan;
};

#define TYNDALL_VM_BOUND1(name) \
  template <class V>            \
  TYNDALL_VM_INLINE Bound<V> bound_##name([[maybe_unused]] const Options& options, Bound<V> a)
#define TYNDALL_VM_BOUND2(name) \
  template <class V>            \
  TYNDALL_VM_INLINE Bound<V> bound_##name([[maybe_unused]] const Options& options, Bound<V> a, Bound<V> b)
#define TYNDALL_VM_BOUND3(name)                                                                            \
  template <class V>                                                                                       \
  TYNDALL_VM_INLINE Bound<V> bound_##name([[maybe_unused]] const Options& options, Bound<V> a, Bound<V> b, \
                                          Bound<V> c)
#define TYNDALL_VM_BOUND4(name)                                                                            \
  template <class V>                                                                                       \
  TYNDALL_VM_INLINE Bound<V> bound_##name([[maybe_unused]] const Options& options, Bound<V> a, Bound<V> b, \
                                          Bound<V> c, Bound<V> d)

inline constexpr float endless = std::numeric_limits<float>::infinity();
// More than the error of any kernel that is a polynomial, relative to its value.
inline constexpr float kernel_error = 0x1p-20f;
inline constexpr float least_float = 0x1p-146f;

template <class V>
TYNDALL_VM_INLINE MaskOf<V> never(V a) {
  return a < a;
}
// The bound from lo to hi, where NaN stands for no end at all.
template <class V>
TYNDALL_VM_INLINE Bound<V> from_to(V lo, V hi, MaskOf<V> nan) {
  const auto bounded = hi - lo < V(endless);
  return {greater(lo, V(-endless)), lesser(hi, V(endless)), either(nan, !bounded)};
}
template <class V>
TYNDALL_VM_INLINE Bound<V> anything(V like) {
  return {V(-endless), V(endless), !never(like)};
}
template <class V>
TYNDALL_VM_INLINE MaskOf<V> is_bounded(Bound<V> a) {
  return a.hi - a.lo < V(endless);
}
template <class V>
TYNDALL_VM_INLINE MaskOf<V> holds(Bound<V> a, V value) {
  return both(a.lo <= value, value <= a.hi);
}
template <class V>
TYNDALL_VM_INLINE V largest_size(Bound<V> a) {
  return greater(abs(a.lo), abs(a.hi));
}
template <class V>
TYNDALL_VM_INLINE Bound<V> hull(Bound<V> a, Bound<V> b) {
  return {lesser(a.lo, b.lo), greater(a.hi, b.hi), either(a.nan, b.nan)};
}
template <class V>
TYNDALL_VM_INLINE Bound<V> choose(MaskOf<V> m, Bound<V> a, Bound<V> b) {
  return {select(m, a.lo, b.lo), select(m, a.hi, b.hi), either(both(m, a.nan), both(!m, b.nan))};
}
// Moves both ends outward by a share of their own size, and by `absolute`.
template <class V>
TYNDALL_VM_INLINE Bound<V> widened(Bound<V> a, float relative, float absolute) {
  return from_to(a.lo - (abs(a.lo) * V(relative) + V(absolute)),
                 a.hi + (abs(a.hi) * V(relative) + V(absolute)), a.nan);
}
template <class V>
TYNDALL_VM_INLINE Bound<V> within(Bound<V> a, V least, V most) {
  return {lesser(most, greater(least, a.lo)), lesser(most, greater(least, a.hi)), a.nan};
}
// What a boolean may be.
template <class V>
TYNDALL_VM_INLINE Bound<V> truth(MaskOf<V> may_hold, MaskOf<V> may_fail) {
  return {select(may_fail, V(0.0f), V(1.0f)), select(may_hold, V(1.0f), V(0.0f)), never(V(0.0f))};
}
template <class V>
TYNDALL_VM_INLINE MaskOf<V> may_be_true(Bound<V> a) {
  return either(a.nan, !both(a.lo == V(0.0f), a.hi == V(0.0f)));
}
template <class V>
TYNDALL_VM_INLINE MaskOf<V> may_be_false(Bound<V> a) {
  return holds(a, V(0.0f));
}
// |a|.
template <class V>
TYNDALL_VM_INLINE Bound<V> size_of(Bound<V> a) {
  const V low = lesser(abs(a.lo), abs(a.hi));
  return {select(holds(a, V(0.0f)), V(0.0f), low), largest_size(a), a.nan};
}
template <class V>
TYNDALL_VM_INLINE Bound<V> negated(Bound<V> a) {
  return {-a.hi, -a.lo, a.nan};
}
template <class V>
TYNDALL_VM_INLINE Bound<V> sum_of(Bound<V> a, Bound<V> b) {
  return from_to(a.lo + b.lo, a.hi + b.hi, either(a.nan, b.nan));
}
// The least and the largest of four, or of two; NaNs, of 0 * infinity and infinity / infinity, count as 0,
// which with the other corners is what they stand for.
template <class V>
TYNDALL_VM_INLINE Bound<V> around(V p, V q, V r, V s, MaskOf<V> nan) {
  if (any(nan)) {
    const auto clean = [](V v) HWY_ATTR { return select(v == v, v, V(0.0f)); };
    p = clean(p), q = clean(q), r = clean(r), s = clean(s);
  }
  return from_to(lesser(lesser(p, q), lesser(r, s)), greater(greater(p, q), greater(r, s)), nan);
}
template <class V>
TYNDALL_VM_INLINE Bound<V> around(V p, V q, MaskOf<V> nan) {
  if (any(nan)) {
    const auto clean = [](V v) HWY_ATTR { return select(v == v, v, V(0.0f)); };
    p = clean(p), q = clean(q);
  }
  return from_to(lesser(p, q), greater(p, q), nan);
}
template <class V>
TYNDALL_VM_INLINE Bound<V> product_of(Bound<V> a, Bound<V> b) {
  // Mostly by a constant.
  if (all(b.lo == b.hi)) return around(a.lo * b.lo, a.hi * b.lo, either(a.nan, b.nan));
  return around(a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi, either(a.nan, b.nan));
}

TYNDALL_VM_BOUND1(copy) { return a; }
TYNDALL_VM_BOUND2(add) { return sum_of(a, b); }
TYNDALL_VM_BOUND2(sub) { return sum_of(a, negated(b)); }
TYNDALL_VM_BOUND2(mul) { return product_of(a, b); }
TYNDALL_VM_BOUND2(div) {
  const Bound<V> quotient = around(a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi, either(a.nan, b.nan));
  return choose(holds(b, V(0.0f)), anything(a.lo), quotient);
}
TYNDALL_VM_BOUND1(neg) { return negated(a); }
TYNDALL_VM_BOUND3(fma) { return sum_of(product_of(a, b), c); }
TYNDALL_VM_BOUND3(fms) { return sum_of(product_of(a, b), negated(c)); }
TYNDALL_VM_BOUND3(fnma) { return sum_of(c, negated(product_of(a, b))); }
TYNDALL_VM_BOUND3(add_mul) { return product_of(sum_of(a, b), c); }
TYNDALL_VM_BOUND3(sub_mul) { return product_of(sum_of(a, negated(b)), c); }
TYNDALL_VM_BOUND4(dot2) { return sum_of(product_of(a, b), product_of(c, d)); }
TYNDALL_VM_BOUND2(min) { return {lesser(a.lo, b.lo), lesser(a.hi, b.hi), either(a.nan, b.nan)}; }
TYNDALL_VM_BOUND2(max) { return {greater(a.lo, b.lo), greater(a.hi, b.hi), either(a.nan, b.nan)}; }
TYNDALL_VM_BOUND3(clamp) { return bound_min(options, bound_max(options, a, b), c); }
TYNDALL_VM_BOUND3(limit) {
  const Bound<V> number = {select(a.nan, lesser(a.lo, V(0.0f)), a.lo),
                           select(a.nan, greater(a.hi, V(0.0f)), a.hi), never(a.lo)};
  return bound_clamp(options, number, b, c);
}
TYNDALL_VM_BOUND1(abs) { return size_of(a); }
TYNDALL_VM_BOUND1(floor) { return {floor(a.lo), floor(a.hi), a.nan}; }
TYNDALL_VM_BOUND1(ceil) { return {ceil(a.lo), ceil(a.hi), a.nan}; }
// Rises until the next whole number; then anything in [0, 1).
TYNDALL_VM_BOUND1(fract) {
  const auto one_cell = floor(a.lo) == floor(a.hi);
  const auto rises = both(one_cell, is_bounded(a));
  return {select(rises, op_fract(options, a.lo), V(0.0f)),
          select(rises, op_fract(options, a.hi), V(1.0f - 0x1p-24f)), a.nan};
}
// a - q b with the same q over the whole bound, where that stays inside [0, b) or (b, 0]; otherwise all of
// it. Where a is 2^20 times larger than b, rounding throws the kernel's result out of that range.
TYNDALL_VM_BOUND2(mod) {
  const V zero(0.0f);
  const V first = floor(a.lo / b.lo), last = floor(a.hi / b.lo);
  const auto same = both(b.lo == b.hi, first == last);
  const V from = select(first == zero, a.lo, a.lo - first * b.lo),
          to = select(first == zero, a.hi, a.hi - first * b.lo);
  const auto inside =
      both(same, both(lesser(from, to) * b.lo >= zero, greater(abs(from), abs(to)) < abs(b.lo)));
  const V size = largest_size(b);
  Bound<V> all = {select(b.lo < zero, -size, zero), select(b.hi > zero, size, zero), either(a.nan, b.nan)};
  const V smallest = size_of(b).lo;
  const auto rough = !(largest_size(a) < smallest * V(0x1p20f));
  all = choose(rough, anything(a.lo), all);
  return choose(both(inside, !rough), Bound<V>{from, to, all.nan}, all);
}
// a (1 - c) + b c is linear in each: its extremes are at ends. Widened by the rounding of a + (b - a) c, but
// where both are nothing, which proves emptiness.
TYNDALL_VM_BOUND3(mix) {
  const V zero(0.0f), one(1.0f);
  const bool between = all(both(c.lo >= zero, c.hi <= one));
  const auto lowest = [&](V w) HWY_ATTR {
    const V u = one - w;
    if (between) return a.lo * u + b.lo * w;
    return select(u < zero, a.hi, a.lo) * u + select(w < zero, b.hi, b.lo) * w;
  };
  const auto highest = [&](V w) HWY_ATTR {
    const V u = one - w;
    if (between) return a.hi * u + b.hi * w;
    return select(u < zero, a.lo, a.hi) * u + select(w < zero, b.lo, b.hi) * w;
  };
  const V size = (largest_size(a) + largest_size(b)) * (one + largest_size(c));
  const V slack = select(size > zero, size * V(0x1p-21f) + V(least_float), zero);
  const V lo = lesser(lowest(c.lo), lowest(c.hi)) - slack, hi = greater(highest(c.lo), highest(c.hi)) + slack;
  const Bound<V> result = from_to(lo, hi, either(either(a.nan, b.nan), c.nan));
  return choose(size < V(endless), result, anything(a.lo));
}
TYNDALL_VM_BOUND2(step) { return truth<V>(b.hi >= a.lo, either(b.lo < a.hi, either(a.nan, b.nan))); }

// 3t^2 - 2t^3 of t in [0, 1]; 0 stays 0, which proves emptiness.
template <class V>
TYNDALL_VM_INLINE V smooth_curve(V t) {
  return t * t * (V(3.0f) - V(2.0f) * t);
}
// Rising edges: t grows with c and falls with either edge once it is held to [0, 1]; falling edges: the
// mirror image.
TYNDALL_VM_BOUND3(smoothstep) {
  const V one(1.0f);
  const auto rising = a.hi < b.lo, falling = b.hi < a.lo;
  const V low_c = select(falling, c.hi, c.lo), high_c = select(falling, c.lo, c.hi);
  const V low_a = select(falling, a.lo, a.hi), low_b = select(falling, b.lo, b.hi);
  const V high_a = select(falling, a.hi, a.lo), high_b = select(falling, b.hi, b.lo);
  const V t_lo = saturate((low_c - low_a) / (low_b - low_a)) * V(1.0f - kernel_error);
  const V t_hi = saturate((high_c - high_a) / (high_b - high_a) * V(1.0f + kernel_error));
  const auto nan = either(either(a.nan, b.nan), c.nan);
  const Bound<V> curve = {smooth_curve(t_lo) * V(1.0f - kernel_error),
                          lesser(one, smooth_curve(t_hi) * V(1.0f + kernel_error)), nan};
  const auto one_edge = both(both(a.lo == a.hi, b.lo == b.hi), a.lo == b.lo);
  // NaN is on neither side of one edge, which gives 0.
  Bound<V> sharp = truth<V>(either(!one_edge, c.hi >= a.lo), either(either(!one_edge, c.lo < a.lo), c.nan));
  const auto overflows = !(largest_size(a) + largest_size(b) < V(endless));
  sharp.nan = either(nan, overflows);
  return choose(both(either(rising, falling), !overflows), curve, sharp);
}
TYNDALL_VM_BOUND1(sqrt) {
  const V zero(0.0f);
  return from_to(sqrt(greater(a.lo, zero)), sqrt(greater(a.hi, zero)), either(a.nan, a.lo < zero));
}
TYNDALL_VM_BOUND2(length2) {
  const Bound<V> x = size_of(a), y = size_of(b);
  return from_to(op_length2(options, x.lo, y.lo), op_length2(options, x.hi, y.hi), either(a.nan, b.nan));
}
TYNDALL_VM_BOUND3(length3) {
  const Bound<V> x = size_of(a), y = size_of(b), z = size_of(c);
  return from_to(op_length3(options, x.lo, y.lo, z.lo), op_length3(options, x.hi, y.hi, z.hi),
                 either(either(a.nan, b.nan), c.nan));
}
TYNDALL_VM_BOUND2(less) { return truth<V>(a.lo < b.hi, either(a.hi >= b.lo, either(a.nan, b.nan))); }
TYNDALL_VM_BOUND2(less_equal) { return truth<V>(a.lo <= b.hi, either(a.hi > b.lo, either(a.nan, b.nan))); }
template <class V>
TYNDALL_VM_INLINE MaskOf<V> must_equal(Bound<V> a, Bound<V> b) {
  return both(both(a.lo == a.hi, b.lo == b.hi), both(a.lo == b.lo, !either(a.nan, b.nan)));
}
template <class V>
TYNDALL_VM_INLINE MaskOf<V> may_equal(Bound<V> a, Bound<V> b) {
  return both(a.lo <= b.hi, b.lo <= a.hi);
}
TYNDALL_VM_BOUND2(equal) { return truth<V>(may_equal(a, b), !must_equal(a, b)); }
TYNDALL_VM_BOUND2(not_equal) {
  return truth<V>(!both(both(a.lo == a.hi, b.lo == b.hi), a.lo == b.lo),
                  either(may_equal(a, b), either(a.nan, b.nan)));
}
TYNDALL_VM_BOUND2(logical_and) {
  return truth<V>(both(may_be_true(a), may_be_true(b)), either(may_be_false(a), may_be_false(b)));
}
TYNDALL_VM_BOUND2(logical_or) {
  return truth<V>(either(may_be_true(a), may_be_true(b)), both(may_be_false(a), may_be_false(b)));
}
TYNDALL_VM_BOUND1(logical_not) { return truth<V>(may_be_false(a), may_be_true(a)); }
TYNDALL_VM_BOUND3(select) {
  const auto first = may_be_true(a), second = may_be_false(a);
  return choose(both(first, second), hull(b, c), choose(first, b, c));
}
TYNDALL_VM_BOUND2(checker) {
  const auto known =
      both(both(floor(a.lo) == floor(a.hi), floor(b.lo) == floor(b.hi)), both(is_bounded(a), is_bounded(b)));
  const V square = op_checker(options, a.lo, b.lo);
  return {select(known, square, V(0.0f)), select(known, square, V(1.0f)), either(a.nan, b.nan)};
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
