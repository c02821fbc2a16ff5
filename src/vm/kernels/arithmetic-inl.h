// Arithmetic, comparisons and choices.
#if defined(TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_
#undef TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_
#else
#define TYNDALL_VM_KERNELS_ARITHMETIC_INL_H_
#endif

#include <type_traits>

#include "vm/kernels/pairs-inl.h"
#include "vm/kernels/values-inl.h"

#include "base/plane.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// What an instruction knows besides its operands.
struct Options {
  int octaves = 0;
  std::uint32_t seed = 0;                // or the index of a plane
  const PlanePointer* planes = nullptr;  // of the program
};

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
TYNDALL_VM_KERNEL2(add) { return a + b; }
TYNDALL_VM_KERNEL2(sub) { return a - b; }
TYNDALL_VM_KERNEL2(mul) { return a * b; }
TYNDALL_VM_KERNEL2(div) { return a / b; }
TYNDALL_VM_KERNEL1(neg) { return -a; }
TYNDALL_VM_KERNEL3(fma) { return a * b + c; }
TYNDALL_VM_KERNEL3(fms) { return a * b - c; }
TYNDALL_VM_KERNEL3(fnma) { return c - a * b; }
TYNDALL_VM_KERNEL3(add_mul) { return (a + b) * c; }
TYNDALL_VM_KERNEL3(sub_mul) { return (a - b) * c; }
TYNDALL_VM_KERNEL4(dot2) { return a * b + c * d; }
TYNDALL_VM_KERNEL2(min) { return min_of(a, b); }
TYNDALL_VM_KERNEL2(max) { return max_of(a, b); }
TYNDALL_VM_KERNEL3(clamp) { return min_of(max_of(a, b), c); }
TYNDALL_VM_KERNEL3(limit) { return op_clamp(options, select(a == a, a, V(0.0f)), b, c); }
TYNDALL_VM_KERNEL1(abs) { return abs(a); }
TYNDALL_VM_KERNEL1(floor) { return floor(a); }
TYNDALL_VM_KERNEL1(ceil) { return ceil(a); }
// In [0, 1): the part of a tiny negative number that rounds to 1 is the largest number below.
TYNDALL_VM_KERNEL1(fract) {
  const V below_one = V(1.0f) - V(std::is_same_v<V, double> ? 0x1p-53f : 0x1p-24f);
  return lesser(below_one, a - floor(a));
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
// Exactly a at 0 and b at 1.
TYNDALL_VM_KERNEL3(mix) { return select(c == V(1.0f), b, a + (b - a) * c); }
TYNDALL_VM_KERNEL2(step) { return as_boolean<V>(b >= a); }
// smoothstep(edge, edge, x) is step(edge, x); edges may fall.
TYNDALL_VM_KERNEL3(smoothstep) {
  const V t = saturate((c - a) / (b - a));
  return select(a == b, as_boolean<V>(c >= a), t * t * (V(3.0f) - V(2.0f) * t));
}
TYNDALL_VM_KERNEL1(sqrt) { return sqrt(a); }
TYNDALL_VM_KERNEL2(length2) { return sqrt(a * a + b * b); }
TYNDALL_VM_KERNEL3(length3) { return sqrt(a * a + b * b + c * c); }
TYNDALL_VM_KERNEL2(less) { return as_boolean<V>(a < b); }
TYNDALL_VM_KERNEL2(less_equal) { return as_boolean<V>(a <= b); }
TYNDALL_VM_KERNEL2(equal) { return as_boolean<V>(a == b); }
TYNDALL_VM_KERNEL2(not_equal) { return as_boolean<V>(either(a<b, a> b)); }
TYNDALL_VM_KERNEL2(logical_and) { return as_boolean<V>(both(is_true(a), is_true(b))); }
TYNDALL_VM_KERNEL2(logical_or) { return as_boolean<V>(either(is_true(a), is_true(b))); }
TYNDALL_VM_KERNEL1(logical_not) { return as_boolean<V>(a == V(0.0f)); }
TYNDALL_VM_KERNEL3(select) { return select(is_true(a), b, c); }
// 1 on the squares whose whole coordinates add up to an even number.
TYNDALL_VM_KERNEL2(checker) {
  const V half = (floor(a) + floor(b)) * V(0.5f);
  return select(half == half, as_boolean<V>(half == floor(half)), half);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
