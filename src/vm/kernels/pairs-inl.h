// Two vectors of floats as one value of the kernels: their chains of operations alternate, so that the
// processor does not wait for the result of each before the next.
#if defined(TYNDALL_VM_KERNELS_PAIRS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_PAIRS_INL_H_
#undef TYNDALL_VM_KERNELS_PAIRS_INL_H_
#else
#define TYNDALL_VM_KERNELS_PAIRS_INL_H_
#endif

#include "vm/kernels/values-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

struct MaskPair {
  Mask a, b;

  friend HWY_INLINE MaskPair operator!(MaskPair m) { return {!m.a, !m.b}; }
};

struct BitsPair {
  Bits a, b;

  HWY_INLINE BitsPair(Bits first, Bits second) : a(first), b(second) {}
  HWY_INLINE BitsPair(std::uint32_t v) : a(v), b(v) {}
  friend HWY_INLINE BitsPair operator+(BitsPair x, BitsPair y) { return {x.a + y.a, x.b + y.b}; }
  friend HWY_INLINE BitsPair operator-(BitsPair x, BitsPair y) { return {x.a - y.a, x.b - y.b}; }
  friend HWY_INLINE BitsPair operator*(BitsPair x, BitsPair y) { return {x.a * y.a, x.b * y.b}; }
  friend HWY_INLINE BitsPair operator^(BitsPair x, BitsPair y) { return {x.a ^ y.a, x.b ^ y.b}; }
  friend HWY_INLINE BitsPair operator&(BitsPair x, BitsPair y) { return {x.a & y.a, x.b & y.b}; }
  friend HWY_INLINE BitsPair operator|(BitsPair x, BitsPair y) { return {x.a | y.a, x.b | y.b}; }
  friend HWY_INLINE BitsPair operator<<(BitsPair x, int n) { return {x.a << n, x.b << n}; }
  friend HWY_INLINE BitsPair operator>>(BitsPair x, int n) { return {x.a >> n, x.b >> n}; }
};

struct FloatsPair {
  Floats a, b;

  HWY_INLINE FloatsPair(Floats first, Floats second) : a(first), b(second) {}
  HWY_INLINE FloatsPair(float v) : a(v), b(v) {}
  friend HWY_INLINE FloatsPair operator+(FloatsPair x, FloatsPair y) { return {x.a + y.a, x.b + y.b}; }
  friend HWY_INLINE FloatsPair operator-(FloatsPair x, FloatsPair y) { return {x.a - y.a, x.b - y.b}; }
  friend HWY_INLINE FloatsPair operator*(FloatsPair x, FloatsPair y) { return {x.a * y.a, x.b * y.b}; }
  friend HWY_INLINE FloatsPair operator/(FloatsPair x, FloatsPair y) { return {x.a / y.a, x.b / y.b}; }
  friend HWY_INLINE FloatsPair operator-(FloatsPair x) { return {-x.a, -x.b}; }
  friend HWY_INLINE MaskPair operator<(FloatsPair x, FloatsPair y) { return {x.a < y.a, x.b < y.b}; }
  friend HWY_INLINE MaskPair operator>(FloatsPair x, FloatsPair y) { return {x.a > y.a, x.b > y.b}; }
  friend HWY_INLINE MaskPair operator<=(FloatsPair x, FloatsPair y) { return {x.a <= y.a, x.b <= y.b}; }
  friend HWY_INLINE MaskPair operator>=(FloatsPair x, FloatsPair y) { return {x.a >= y.a, x.b >= y.b}; }
  friend HWY_INLINE MaskPair operator==(FloatsPair x, FloatsPair y) { return {x.a == y.a, x.b == y.b}; }
  friend HWY_INLINE MaskPair operator!=(FloatsPair x, FloatsPair y) { return {x.a != y.a, x.b != y.b}; }
};

HWY_INLINE MaskPair both(MaskPair x, MaskPair y) { return {both(x.a, y.a), both(x.b, y.b)}; }
HWY_INLINE MaskPair either(MaskPair x, MaskPair y) { return {either(x.a, y.a), either(x.b, y.b)}; }
HWY_INLINE FloatsPair select(MaskPair m, FloatsPair x, FloatsPair y) {
  return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
HWY_INLINE FloatsPair sqrt(FloatsPair x) { return {sqrt(x.a), sqrt(x.b)}; }
HWY_INLINE FloatsPair abs(FloatsPair x) { return {abs(x.a), abs(x.b)}; }
HWY_INLINE FloatsPair floor(FloatsPair x) { return {floor(x.a), floor(x.b)}; }
HWY_INLINE FloatsPair ceil(FloatsPair x) { return {ceil(x.a), ceil(x.b)}; }
HWY_INLINE FloatsPair lesser(FloatsPair x, FloatsPair y) { return {lesser(x.a, y.a), lesser(x.b, y.b)}; }
HWY_INLINE FloatsPair greater(FloatsPair x, FloatsPair y) { return {greater(x.a, y.a), greater(x.b, y.b)}; }
HWY_INLINE BitsPair bits(FloatsPair x) { return {bits(x.a), bits(x.b)}; }
HWY_INLINE FloatsPair from_bits(BitsPair x) { return {from_bits(x.a), from_bits(x.b)}; }
HWY_INLINE MaskPair less_signed(BitsPair x, BitsPair y) {
  return {less_signed(x.a, y.a), less_signed(x.b, y.b)};
}
HWY_INLINE bool any(MaskPair m) { return any(either(m.a, m.b)); }
HWY_INLINE bool all(MaskPair m) { return all(both(m.a, m.b)); }
HWY_INLINE FloatsPair replace_lanes(MaskPair m, FloatsPair x, FloatsPair otherwise, float (*f)(float)) {
  return {replace_lanes(m.a, x.a, otherwise.a, f), replace_lanes(m.b, x.b, otherwise.b, f)};
}
HWY_INLINE FloatsPair look_up(const float* table, BitsPair index) {
  return {look_up(table, index.a), look_up(table, index.b)};
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
