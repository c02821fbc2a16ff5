// The value types of the kernels: float, double, and one SIMD vector of floats, all under the same function
// names.
//
// A kernel is a template over the value type V and is written with operators and the functions below only, so
// the scalar reference, constant folding and the SIMD machine have one meaning. Masks are bool or Mask; bit
// patterns are uint32_t or Bits. None of the functions fuses a multiplication with an addition, and none is
// approximate, so every SIMD class and the scalar code agree to the bit (NaNs may differ in sign and
// payload).
#if defined(TYNDALL_VM_KERNELS_VALUES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_VALUES_INL_H_
#undef TYNDALL_VM_KERNELS_VALUES_INL_H_
#else
#define TYNDALL_VM_KERNELS_VALUES_INL_H_
#endif

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwy/highway.h"

// Kernels melt into the loop over lanes, except where sanitizers would instrument every copy of them.
#undef TYNDALL_VM_INLINE
#if defined(__SANITIZE_ADDRESS__)
#define TYNDALL_VM_INLINE inline
#else
#define TYNDALL_VM_INLINE HWY_INLINE
#endif

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// ---- one float or double

inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline float select(bool m, float a, float b) { return m ? a : b; }
inline double select(bool m, double a, double b) { return m ? a : b; }
inline float floor(float a) { return std::floor(a); }
inline double floor(double a) { return std::floor(a); }
inline float ceil(float a) { return std::ceil(a); }
inline double ceil(double a) { return std::ceil(a); }
inline float sqrt(float a) { return std::sqrt(a); }
inline double sqrt(double a) { return std::sqrt(a); }
inline float abs(float a) { return std::fabs(a); }
inline double abs(double a) { return std::fabs(a); }
// a < b ? a : b, and its mirror image: b when either is NaN.
inline float lesser(float a, float b) { return a < b ? a : b; }
inline double lesser(double a, double b) { return a < b ? a : b; }
inline float greater(float a, float b) { return a > b ? a : b; }
inline double greater(double a, double b) { return a > b ? a : b; }

inline std::uint32_t bits(float a) { return std::bit_cast<std::uint32_t>(a); }
inline float from_bits(std::uint32_t a) { return std::bit_cast<float>(a); }
// Both as two's complement.
inline bool less_signed(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::int32_t>(a) < static_cast<std::int32_t>(b);
}
inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }
// m ? a + b : a.
inline float add_where(bool m, float a, float b) { return m ? a + b : a; }
// f(a) where m, one lane at a time: for arguments too rare to deserve a kernel.
inline float replace_lanes(bool m, float a, float otherwise, float (*f)(float)) {
  return m ? f(a) : otherwise;
}
// table[index]; every index must be in range.
inline float look_up(const float* table, std::uint32_t index) { return table[index]; }
inline std::uint32_t look_up(const std::uint32_t* table, std::uint32_t index) { return table[index]; }
// The word that stands `offset` bytes, below 2^31, after the table's begin.
inline std::uint32_t look_up_word(const std::uint16_t* table, std::uint32_t offset) {
  std::uint32_t word;
  std::memcpy(&word, reinterpret_cast<const char*>(table) + offset, sizeof word);
  return word;
}

// ---- one vector of floats

using FloatTag = hn::ScalableTag<float>;
using BitsTag = hn::RebindToUnsigned<FloatTag>;
using SignedTag = hn::RebindToSigned<FloatTag>;

struct Mask {
  hn::Mask<FloatTag> raw;

  friend HWY_INLINE Mask operator!(Mask a) { return {hn::Not(a.raw)}; }
};

struct Bits {
  hn::Vec<BitsTag> raw;

  HWY_INLINE Bits(hn::Vec<BitsTag> v) : raw(v) {}
  HWY_INLINE Bits(std::uint32_t v) : raw(hn::Set(BitsTag(), v)) {}
  friend HWY_INLINE Bits operator+(Bits a, Bits b) { return hn::Add(a.raw, b.raw); }
  friend HWY_INLINE Bits operator-(Bits a, Bits b) { return hn::Sub(a.raw, b.raw); }
  friend HWY_INLINE Bits operator*(Bits a, Bits b) { return hn::Mul(a.raw, b.raw); }
  friend HWY_INLINE Bits operator^(Bits a, Bits b) { return hn::Xor(a.raw, b.raw); }
  friend HWY_INLINE Bits operator&(Bits a, Bits b) { return hn::And(a.raw, b.raw); }
  friend HWY_INLINE Bits operator|(Bits a, Bits b) { return hn::Or(a.raw, b.raw); }
  friend HWY_INLINE Bits operator<<(Bits a, int n) { return hn::ShiftLeftSame(a.raw, n); }
  friend HWY_INLINE Bits operator>>(Bits a, int n) { return hn::ShiftRightSame(a.raw, n); }
};

struct Floats {
  hn::Vec<FloatTag> raw;

  HWY_INLINE Floats(hn::Vec<FloatTag> v) : raw(v) {}
  HWY_INLINE Floats(float v) : raw(hn::Set(FloatTag(), v)) {}
  friend HWY_INLINE Floats operator+(Floats a, Floats b) { return hn::Add(a.raw, b.raw); }
  friend HWY_INLINE Floats operator-(Floats a, Floats b) { return hn::Sub(a.raw, b.raw); }
  friend HWY_INLINE Floats operator*(Floats a, Floats b) { return hn::Mul(a.raw, b.raw); }
  friend HWY_INLINE Floats operator/(Floats a, Floats b) { return hn::Div(a.raw, b.raw); }
  friend HWY_INLINE Floats operator-(Floats a) { return hn::Neg(a.raw); }
  friend HWY_INLINE Mask operator<(Floats a, Floats b) { return {hn::Lt(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator>(Floats a, Floats b) { return {hn::Gt(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator<=(Floats a, Floats b) { return {hn::Le(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator>=(Floats a, Floats b) { return {hn::Ge(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator==(Floats a, Floats b) { return {hn::Eq(a.raw, b.raw)}; }
  // Highway's Ne is false for NaN in some classes.
  friend HWY_INLINE Mask operator!=(Floats a, Floats b) { return !(a == b); }
};

HWY_INLINE Mask both(Mask a, Mask b) { return {hn::And(a.raw, b.raw)}; }
HWY_INLINE Mask either(Mask a, Mask b) { return {hn::Or(a.raw, b.raw)}; }
HWY_INLINE Floats select(Mask m, Floats a, Floats b) { return hn::IfThenElse(m.raw, a.raw, b.raw); }
HWY_INLINE Floats sqrt(Floats a) { return hn::Sqrt(a.raw); }
HWY_INLINE Floats abs(Floats a) { return hn::Abs(a.raw); }
HWY_INLINE Bits bits(Floats a) { return hn::BitCast(BitsTag(), a.raw); }
HWY_INLINE Floats from_bits(Bits a) { return hn::BitCast(FloatTag(), a.raw); }
// On x86 the instructions are exactly the scalar functions above; elsewhere the zeros and NaNs differ.
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
HWY_INLINE Floats lesser(Floats a, Floats b) { return hn::Min(a.raw, b.raw); }
HWY_INLINE Floats greater(Floats a, Floats b) { return hn::Max(a.raw, b.raw); }
HWY_INLINE Floats floor(Floats a) { return hn::Floor(a.raw); }
HWY_INLINE Floats ceil(Floats a) { return hn::Ceil(a.raw); }
#else
HWY_INLINE Floats lesser(Floats a, Floats b) { return select(a < b, a, b); }
HWY_INLINE Floats greater(Floats a, Floats b) { return select(a > b, a, b); }
HWY_INLINE Floats with_sign_of(Floats a, Floats b) {
  return from_bits((bits(a) & 0x7fffffffu) | (bits(b) & 0x80000000u));
}
HWY_INLINE Floats floor(Floats a) { return with_sign_of(hn::Floor(a.raw), a); }
HWY_INLINE Floats ceil(Floats a) { return with_sign_of(hn::Ceil(a.raw), a); }
#endif
HWY_INLINE Mask less_signed(Bits a, Bits b) {
  const SignedTag d;
  return {hn::RebindMask(FloatTag(), hn::Lt(hn::BitCast(d, a.raw), hn::BitCast(d, b.raw)))};
}
HWY_INLINE bool any(Mask m) { return !hn::AllFalse(FloatTag(), m.raw); }
HWY_INLINE bool all(Mask m) { return hn::AllTrue(FloatTag(), m.raw); }
HWY_INLINE Floats add_where(Mask m, Floats a, Floats b) {
#if HWY_TARGET <= HWY_AVX3
  return hn::IfThenElse(m.raw, hn::Add(a.raw, b.raw), a.raw);  // one instruction
#else
  return hn::Add(a.raw, hn::IfThenElseZero(m.raw, b.raw));
#endif
}
HWY_INLINE Floats replace_lanes(Mask m, Floats a, Floats otherwise, float (*f)(float)) {
  const FloatTag d;
  HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(a.raw, d, lanes);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) lanes[i] = f(lanes[i]);
  return select(m, Floats(hn::Load(d, lanes)), otherwise);
}
HWY_INLINE Floats look_up(const float* table, Bits index) {
  return hn::GatherIndex(FloatTag(), table, hn::BitCast(SignedTag(), index.raw));
}
HWY_INLINE Bits look_up(const std::uint32_t* table, Bits index) {
  return hn::GatherIndex(BitsTag(), table, hn::BitCast(SignedTag(), index.raw));
}
HWY_INLINE Bits look_up_word(const std::uint16_t* table, Bits offset) {
  return hn::GatherOffset(BitsTag(), reinterpret_cast<const std::uint32_t*>(table),
                          hn::BitCast(SignedTag(), offset.raw));
}

// ---- any of them

// The sign bit of `s` flips the sign of `a`.
template <class V, class B>
TYNDALL_VM_INLINE V flip_sign(V a, B s) {
  return from_bits(bits(a) ^ (s & B(0x80000000u)));
}

// Adding this rounds a float of magnitude below 2^22 to the nearest whole number, which then stands in the
// low bits.
inline constexpr float round_magic = 0x1.8p23f;

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
