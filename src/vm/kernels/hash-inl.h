// Pure hashes: of whole lattice coordinates for the noises, and of any floats for random().
#if defined(TYNDALL_VM_KERNELS_HASH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_HASH_INL_H_
#undef TYNDALL_VM_KERNELS_HASH_INL_H_
#else
#define TYNDALL_VM_KERNELS_HASH_INL_H_
#endif

#include "vm/kernels/arithmetic-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// The whole number c as a pattern: consecutive ones differ by 1 for |c| <= 2^22. Beyond that, and for
// infinities and NaN, it is some pattern.
template <class V>
TYNDALL_VM_INLINE auto lattice_key(V c) {
  return bits(c + V(round_magic));
}

// One odd factor a dimension, so that coordinates are mixed by exclusive or and neighbours cost an addition.
inline constexpr std::uint32_t factor_x = 0x9e3779b1u, factor_y = 0x85ebca77u, factor_z = 0xc2b2ae3du,
                               factor_t = 0x27d4eb2fu;

// Spreads every bit over the upper half and the lowest bits.
template <class B>
TYNDALL_VM_INLINE B mix_lattice(B h) {
  h = (h ^ (h >> 15)) * B(0x2c1b3c6du);
  h = (h ^ (h >> 12)) * B(0x297a2d39u);
  return h ^ (h >> 15);
}

// A finaliser with low bias (Wellons, hash-prospector).
template <class B>
TYNDALL_VM_INLINE B mix_bits(B h) {
  h = (h ^ (h >> 16)) * B(0x21f0aaadu);
  h = (h ^ (h >> 15)) * B(0x735a2d97u);
  return h ^ (h >> 15);
}

// The pattern that stands for the octave-th noise of a seed.
inline std::uint32_t seed_key(std::uint32_t seed, std::uint32_t octave) {
  return mix_bits(mix_bits(seed + 0x9e3779b9u) + octave);
}

// [0, 1) in steps of 2^-23.
template <class B>
TYNDALL_VM_INLINE auto unit_float(B h) {
  auto one_to_two = from_bits((h >> 9) | 0x3f800000u);
  return one_to_two - decltype(one_to_two)(1.0f);
}

// Hashes on: 0 and -0 are one number, and so are all NaNs.
template <class V, class B>
TYNDALL_VM_INLINE B hash_float(B h, V a) {
  const V canonical = select(a == a, a + V(0.0f), V(0x1.8p127f));
  return mix_bits((h + B(0x9e3779b9u)) ^ bits(canonical));
}

TYNDALL_VM_KERNEL1(random1) { return unit_float(hash_float(decltype(bits(a))(1), a)); }
TYNDALL_VM_KERNEL2(random2) { return unit_float(hash_float(hash_float(decltype(bits(a))(2), a), b)); }
TYNDALL_VM_KERNEL3(random3) {
  return unit_float(hash_float(hash_float(hash_float(decltype(bits(a))(3), a), b), c));
}
TYNDALL_VM_KERNEL4(random4) {
  return unit_float(hash_float(hash_float(hash_float(hash_float(decltype(bits(a))(4), a), b), c), d));
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

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
