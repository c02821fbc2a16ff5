// Gradient noise with its gradient, for bounds: the value of noise-inl.h to rounding, and the slope along
// each axis.
#if defined(TYNDALL_VM_KERNELS_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_SLOPES_INL_H_
#undef TYNDALL_VM_KERNELS_SLOPES_INL_H_
#else
#define TYNDALL_VM_KERNELS_SLOPES_INL_H_
#endif

#include "vm/kernels/noise-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// A value and its slopes along x, y, z and time.
template <class V>
struct Slopes {
  V value, x, y, z, t;
};

// One axis of a lattice cell for slopes: shares of the two ends, and how fast the upper one's grows.
template <class V, class B>
struct SlopeAxis {
  V from_low, from_high, low_share, high_share, growth;
  B low, high;
};
template <class V>
TYNDALL_VM_INLINE auto slope_axis(V x, std::uint32_t factor) {
  const auto axis = cell_axis(x, factor);
  const V t = axis.from_low, s = t * (t - V(1.0f));
  return SlopeAxis<V, decltype(axis.low)>{
      t, axis.from_high, V(1.0f) - axis.fade, axis.fade, V(30.0f) * s * s, axis.low, axis.high};
}

// Adds a corner's gradient times its share; gives the scalar product of gradient and distance (see
// edge_product).
template <class V, class B>
TYNDALL_VM_INLINE V add_edge(B h, V share, V dx, V dy, V dz, Slopes<V>& sum) {
  const auto first_y = less_signed(h, B(0xd5555555u)), second_y = less_signed(B(0x2aaaaaaau), h);
  const B first_sign = h << 31, second_sign = (h << 30) & B(0x80000000u);
  const V first = negate_if(share, first_sign), second = negate_if(share, second_sign), zero(0.0f);
  sum.x = sum.x + select(first_y, zero, first);
  sum.y = sum.y + (select(first_y, first, zero) + select(second_y, second, zero));
  sum.z = sum.z + select(second_y, zero, second);
  return negate_if(select(first_y, dy, dx), first_sign) + negate_if(select(second_y, dy, dz), second_sign);
}
template <class V, class B>
TYNDALL_VM_INLINE V add_edge(B h, V share, V dx, V dy, V dz, V dt, Slopes<V>& sum) {
  const auto first_y = less_signed(h, B(0xc0000000u)), second_z = less_signed(h, B(0u)),
             third_t = less_signed(h, B(0x40000000u));
  const B first_sign = h << 31, second_sign = (h << 30) & B(0x80000000u),
          third_sign = (h << 29) & B(0x80000000u);
  const V first = negate_if(share, first_sign), second = negate_if(share, second_sign),
          third = negate_if(share, third_sign), zero(0.0f);
  sum.x = sum.x + select(first_y, zero, first);
  sum.y = sum.y + (select(first_y, first, zero) + select(second_z, zero, second));
  sum.z = sum.z + (select(second_z, second, zero) + select(third_t, zero, third));
  sum.t = sum.t + select(third_t, third, zero);
  return negate_if(select(first_y, dy, dx), first_sign) + negate_if(select(second_z, dz, dy), second_sign) +
         negate_if(select(third_t, dt, dz), third_sign);
}

// The eight corners of a cell of space; `time` are the corners' distances in time, or nothing.
template <class V, class X, class B, class... T>
TYNDALL_VM_INLINE Slopes<V> slopes_of_cell(const X& x, const X& y, const X& z, B key, T... time) {
  const V zero(0.0f);
  Slopes<V> sum{zero, zero, zero, zero, zero};
  const V ll = y.low_share * z.low_share, hl = y.high_share * z.low_share, lh = y.low_share * z.high_share,
          hh = y.high_share * z.high_share;
  const B low = z.low ^ key, high = z.high ^ key;
  const auto edge = [&](B hash_y, V share, V dy, V dz, V& at_low, V& at_high) HWY_ATTR {
    at_low = add_edge(mix_lattice(x.low ^ hash_y), x.low_share * share, x.from_low, dy, dz, time..., sum);
    at_high = add_edge(mix_lattice(x.high ^ hash_y), x.high_share * share, x.from_high, dy, dz, time..., sum);
  };
  V a0 = zero, a1 = zero, b0 = zero, b1 = zero, c0 = zero, c1 = zero, d0 = zero, d1 = zero;
  edge(y.low ^ low, ll, y.from_low, z.from_low, a0, a1);
  edge(y.high ^ low, hl, y.from_high, z.from_low, b0, b1);
  edge(y.low ^ high, lh, y.from_low, z.from_high, c0, c1);
  edge(y.high ^ high, hh, y.from_high, z.from_high, d0, d1);
  const V a = blend(a0, a1, x.high_share), b = blend(b0, b1, x.high_share), c = blend(c0, c1, x.high_share),
          d = blend(d0, d1, x.high_share);
  const V front = blend(a, b, y.high_share), back = blend(c, d, y.high_share);
  sum.value = blend(front, back, z.high_share);
  sum.x = sum.x + x.growth * ((a1 - a0) * ll + (b1 - b0) * hl + (c1 - c0) * lh + (d1 - d0) * hh);
  sum.y = sum.y + y.growth * ((b - a) * z.low_share + (d - c) * z.high_share);
  sum.z = sum.z + z.growth * (back - front);
  return sum;
}

template <class V>
TYNDALL_VM_INLINE Slopes<V> noise_slopes(V px, V py, V pz, std::uint32_t key) {
  const auto x = slope_axis(px, factor_x), y = slope_axis(py, factor_y), z = slope_axis(pz, factor_z);
  using B = decltype(x.low);
  return slopes_of_cell<V>(x, y, z, B(key));
}
template <class V>
TYNDALL_VM_INLINE Slopes<V> noise_slopes(V px, V py, V pz, V pt, std::uint32_t key) {
  const auto x = slope_axis(px, factor_x), y = slope_axis(py, factor_y), z = slope_axis(pz, factor_z),
             t = slope_axis(pt, factor_t);
  using B = decltype(x.low);
  const Slopes<V> early = slopes_of_cell<V>(x, y, z, t.low ^ B(key), t.from_low);
  const Slopes<V> late = slopes_of_cell<V>(x, y, z, t.high ^ B(key), t.from_high);
  const V scale(2.0f / 3.0f), difference = late.value - early.value, share = t.high_share;
  return {blend(early.value, late.value, share) * scale, blend(early.x, late.x, share) * scale,
          blend(early.y, late.y, share) * scale, blend(early.z, late.z, share) * scale,
          (blend(early.t, late.t, share) + t.growth * difference) * scale};
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
