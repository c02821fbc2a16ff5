// Intervals of what a lane may hold: what the kernels on intervals are made of.
//
// A Bound covers a value x of the machine when lo <= x <= hi, or x is NaN and `nan` is set. A kernel here
// covers what the kernel of the same name gives for any operands that the operands cover: not the real
// function, but its floats. Sums, products, quotients and roots are rounded correctly, so they are monotone
// and their ends are exact; what is made of polynomials is widened by more than its error
// (tests/vm/functions_test.cpp). A bound without end always has `nan` set, so operands that may be infinite
// need no case of their own: infinity minus infinity and zero times infinity come from them alone.
#if defined(TYNDALL_VM_KERNELS_BOUNDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_BOUNDS_INL_H_
#undef TYNDALL_VM_KERNELS_BOUNDS_INL_H_
#else
#define TYNDALL_VM_KERNELS_BOUNDS_INL_H_
#endif

#include <limits>
#include <utility>

#include "vm/kernels/pairs-inl.h"
#include "vm/kernels/values-inl.h"

#include "vm/program/tables.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// What an instruction knows besides its operands.
struct Options {
  int octaves = 0;
  std::uint32_t seed = 0;          // or the index in a table
  const Tables* tables = nullptr;  // of the program
};

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
  return from_to(lesser(a.lo, b.lo), greater(a.hi, b.hi), either(a.nan, b.nan));
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

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
