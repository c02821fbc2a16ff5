// Arithmetic, comparisons and choices: each operation on lanes, and on intervals of them (bounds-inl.h).
#if defined(TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_
#undef TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_
#else
#define TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_
#endif

#include <type_traits>

#include "vm/kernels/bounds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

#define TYNDALL_VM_KERNEL1(name) \
  template <class V>             \
  TYNDALL_VM_INLINE V op_##name([[maybe_unused]] const Options& options, V a)
#define TYNDALL_VM_KERNEL2(name) \
  template <class V>             \
  TYNDALL_VM_INLINE V op_##name([[maybe_unused]] const Options& options, V a, V b)
#define TYNDALL_VM_KERNEL3(name) \
  template <class V>             \
  TYNDALL_VM_INLINE V op_##name([[maybe_unused]] const Options& options, V a, V b, V c)
#define TYNDALL_VM_KERNEL4(name) \
  template <class V>             \
  TYNDALL_VM_INLINE V op_##name([[maybe_unused]] const Options& options, V a, V b, V c, V d)

// 1 or 0.
template <class V, class M>
TYNDALL_VM_INLINE V as_boolean(M m) {
  return select(m, V(1.0f), V(0.0f));
}
// NaN holds; NaN is not `not` either.
template <class V>
TYNDALL_VM_INLINE auto is_true(V a) {
  return !(a == V(0.0f));
}
// The smaller and the larger, NaN when either is NaN.
template <class V>
TYNDALL_VM_INLINE V min_of(V a, V b) {
  return select(a != a, a, lesser(a, b));
}
template <class V>
TYNDALL_VM_INLINE V max_of(V a, V b) {
  return select(a != a, a, greater(a, b));
}
// To [0, 1]; NaN stays.
template <class V>
TYNDALL_VM_INLINE V saturate(V a) {
  return lesser(V(1.0f), greater(V(0.0f), a));
}

TYNDALL_VM_KERNEL1(copy) { return a; }
TYNDALL_VM_BOUND1(copy) { return a; }
TYNDALL_VM_KERNEL2(add) { return a + b; }
TYNDALL_VM_BOUND2(add) { return sum_of(a, b); }
TYNDALL_VM_KERNEL2(sub) { return a - b; }
TYNDALL_VM_BOUND2(sub) { return sum_of(a, negated(b)); }
TYNDALL_VM_KERNEL2(mul) { return a * b; }
TYNDALL_VM_BOUND2(mul) { return product_of(a, b); }
TYNDALL_VM_KERNEL2(div) { return a / b; }
TYNDALL_VM_BOUND2(div) {
  const Bound<V> quotient = around(a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi, either(a.nan, b.nan));
  return choose(holds(b, V(0.0f)), anything(a.lo), quotient);
}
TYNDALL_VM_KERNEL1(neg) { return -a; }
TYNDALL_VM_BOUND1(neg) { return negated(a); }
TYNDALL_VM_KERNEL3(fma) { return a * b + c; }
TYNDALL_VM_BOUND3(fma) { return sum_of(product_of(a, b), c); }
TYNDALL_VM_KERNEL3(fms) { return a * b - c; }
TYNDALL_VM_BOUND3(fms) { return sum_of(product_of(a, b), negated(c)); }
TYNDALL_VM_KERNEL3(fnma) { return c - a * b; }
TYNDALL_VM_BOUND3(fnma) { return sum_of(c, negated(product_of(a, b))); }
TYNDALL_VM_KERNEL3(add_mul) { return (a + b) * c; }
TYNDALL_VM_BOUND3(add_mul) { return product_of(sum_of(a, b), c); }
TYNDALL_VM_KERNEL3(sub_mul) { return (a - b) * c; }
TYNDALL_VM_BOUND3(sub_mul) { return product_of(sum_of(a, negated(b)), c); }
TYNDALL_VM_KERNEL4(dot2) { return a * b + c * d; }
TYNDALL_VM_BOUND4(dot2) { return sum_of(product_of(a, b), product_of(c, d)); }
TYNDALL_VM_KERNEL2(min) { return min_of(a, b); }
TYNDALL_VM_BOUND2(min) { return {lesser(a.lo, b.lo), lesser(a.hi, b.hi), either(a.nan, b.nan)}; }
TYNDALL_VM_KERNEL2(max) { return max_of(a, b); }
TYNDALL_VM_BOUND2(max) { return {greater(a.lo, b.lo), greater(a.hi, b.hi), either(a.nan, b.nan)}; }
TYNDALL_VM_KERNEL3(clamp) { return min_of(max_of(a, b), c); }
TYNDALL_VM_BOUND3(clamp) { return bound_min(options, bound_max(options, a, b), c); }
// A number for whatever comes: NaN counts as 0.
TYNDALL_VM_KERNEL3(limit) { return op_clamp(options, select(a == a, a, V(0.0f)), b, c); }
TYNDALL_VM_BOUND3(limit) {
  const Bound<V> number = {select(a.nan, lesser(a.lo, V(0.0f)), a.lo),
                           select(a.nan, greater(a.hi, V(0.0f)), a.hi), never(a.lo)};
  return bound_clamp(options, number, b, c);
}
TYNDALL_VM_KERNEL1(abs) { return abs(a); }
TYNDALL_VM_BOUND1(abs) { return size_of(a); }
TYNDALL_VM_KERNEL1(floor) { return floor(a); }
TYNDALL_VM_BOUND1(floor) { return {floor(a.lo), floor(a.hi), a.nan}; }
TYNDALL_VM_KERNEL1(ceil) { return ceil(a); }
TYNDALL_VM_BOUND1(ceil) { return {ceil(a.lo), ceil(a.hi), a.nan}; }
// A half goes up: x - floor(x) is exact, or rounds to 1.
TYNDALL_VM_KERNEL1(round) {
  const V below = floor(a);
  return select(a - below >= V(0.5f), below + V(1.0f), below);
}
TYNDALL_VM_BOUND1(round) { return {op_round(options, a.lo), op_round(options, a.hi), a.nan}; }
// 0 and NaN stay.
TYNDALL_VM_KERNEL1(sign) { return select(a > V(0.0f), V(1.0f), select(a < V(0.0f), V(-1.0f), a)); }
TYNDALL_VM_BOUND1(sign) { return {op_sign(options, a.lo), op_sign(options, a.hi), a.nan}; }
TYNDALL_VM_KERNEL1(saturate) { return saturate(a); }
TYNDALL_VM_BOUND1(saturate) { return {saturate(a.lo), saturate(a.hi), a.nan}; }
// In [0, 1): the part of a tiny negative number that rounds to 1 is the largest number below.
TYNDALL_VM_KERNEL1(fract) {
  const V below_one = V(1.0f) - V(std::is_same_v<V, double> ? 0x1p-53f : 0x1p-24f);
  return lesser(below_one, a - floor(a));
}
// Rises until the next whole number; then anything in [0, 1).
TYNDALL_VM_BOUND1(fract) {
  const auto one_cell = floor(a.lo) == floor(a.hi);
  const auto rises = both(one_cell, is_bounded(a));
  return {select(rises, op_fract(options, a.lo), V(0.0f)),
          select(rises, op_fract(options, a.hi), V(1.0f - 0x1p-24f)), a.nan};
}
// In [0, b) or (b, 0]; NaN for b = 0.
TYNDALL_VM_KERNEL2(mod) {
  const V zero(0.0f);
  const V quotient = floor(a / b);
  const V remainder = select(quotient == zero, a, a - quotient * b);
  const V low = select(b < zero, -remainder, remainder), range = abs(b);
  const V raised = select(low < zero, low + range, low);
  const V wrapped = select(raised >= range, zero, raised);
  return select(b == zero, a / b * zero, select(b < zero, -wrapped, wrapped));
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
// Exactly a at 0 and b at 1.
TYNDALL_VM_KERNEL3(mix) { return select(c == V(1.0f), b, a + (b - a) * c); }
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
TYNDALL_VM_KERNEL2(step) { return as_boolean<V>(b >= a); }
TYNDALL_VM_BOUND2(step) { return truth<V>(b.hi >= a.lo, either(b.lo < a.hi, either(a.nan, b.nan))); }
// smoothstep(edge, edge, x) is step(edge, x); edges may fall.
TYNDALL_VM_KERNEL3(smoothstep) {
  const V t = saturate((c - a) / (b - a));
  return select(a == b, as_boolean<V>(c >= a), t * t * (V(3.0f) - V(2.0f) * t));
}
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
TYNDALL_VM_KERNEL1(sqrt) { return sqrt(a); }
TYNDALL_VM_BOUND1(sqrt) {
  const V zero(0.0f);
  return from_to(sqrt(greater(a.lo, zero)), sqrt(greater(a.hi, zero)), either(a.nan, a.lo < zero));
}
TYNDALL_VM_KERNEL2(length2) { return sqrt(a * a + b * b); }
TYNDALL_VM_BOUND2(length2) {
  const Bound<V> x = size_of(a), y = size_of(b);
  return from_to(op_length2(options, x.lo, y.lo), op_length2(options, x.hi, y.hi), either(a.nan, b.nan));
}
TYNDALL_VM_KERNEL3(length3) { return sqrt(a * a + b * b + c * c); }
TYNDALL_VM_BOUND3(length3) {
  const Bound<V> x = size_of(a), y = size_of(b), z = size_of(c);
  return from_to(op_length3(options, x.lo, y.lo, z.lo), op_length3(options, x.hi, y.hi, z.hi),
                 either(either(a.nan, b.nan), c.nan));
}
TYNDALL_VM_KERNEL2(less) { return as_boolean<V>(a < b); }
TYNDALL_VM_BOUND2(less) { return truth<V>(a.lo < b.hi, either(a.hi >= b.lo, either(a.nan, b.nan))); }
TYNDALL_VM_KERNEL2(less_equal) { return as_boolean<V>(a <= b); }
TYNDALL_VM_BOUND2(less_equal) { return truth<V>(a.lo <= b.hi, either(a.hi > b.lo, either(a.nan, b.nan))); }
TYNDALL_VM_KERNEL2(equal) { return as_boolean<V>(a == b); }
template <class V>
TYNDALL_VM_INLINE MaskOf<V> must_equal(Bound<V> a, Bound<V> b) {
  return both(both(a.lo == a.hi, b.lo == b.hi), both(a.lo == b.lo, !either(a.nan, b.nan)));
}
template <class V>
TYNDALL_VM_INLINE MaskOf<V> may_equal(Bound<V> a, Bound<V> b) {
  return both(a.lo <= b.hi, b.lo <= a.hi);
}
TYNDALL_VM_BOUND2(equal) { return truth<V>(may_equal(a, b), !must_equal(a, b)); }
TYNDALL_VM_KERNEL2(not_equal) { return as_boolean<V>(either(a<b, a> b)); }
TYNDALL_VM_BOUND2(not_equal) {
  return truth<V>(!both(both(a.lo == a.hi, b.lo == b.hi), a.lo == b.lo),
                  either(may_equal(a, b), either(a.nan, b.nan)));
}
TYNDALL_VM_KERNEL2(logical_and) { return as_boolean<V>(both(is_true(a), is_true(b))); }
TYNDALL_VM_BOUND2(logical_and) {
  return truth<V>(both(may_be_true(a), may_be_true(b)), either(may_be_false(a), may_be_false(b)));
}
TYNDALL_VM_KERNEL2(logical_or) { return as_boolean<V>(either(is_true(a), is_true(b))); }
TYNDALL_VM_BOUND2(logical_or) {
  return truth<V>(either(may_be_true(a), may_be_true(b)), both(may_be_false(a), may_be_false(b)));
}
TYNDALL_VM_KERNEL1(logical_not) { return as_boolean<V>(a == V(0.0f)); }
TYNDALL_VM_BOUND1(logical_not) { return truth<V>(may_be_false(a), may_be_true(a)); }
TYNDALL_VM_KERNEL3(select) { return select(is_true(a), b, c); }
TYNDALL_VM_BOUND3(select) {
  const auto first = may_be_true(a), second = may_be_false(a);
  return choose(both(first, second), hull(b, c), choose(first, b, c));
}
// 1 on the squares whose whole coordinates add up to an even number.
TYNDALL_VM_KERNEL2(checker) {
  const V half = (floor(a) + floor(b)) * V(0.5f);
  return select(half == half, as_boolean<V>(half == floor(half)), half);
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
