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

// Sums over the corners of what their edges point along, and of it the part along the other of the two axes
// that an edge's part may have: the first x or y, the second z or y. In four dimensions: x or y, y or z, z or
// t. Sums of all parts need no masks.
template <class V>
struct EdgeSums {
  V first, first_other, second, second_other, third, third_other;
};
template <class V>
TYNDALL_VM_INLINE Slopes<V> slopes_of(const EdgeSums<V>& s, bool has_time) {
  if (!has_time)
    return {V(0.0f), s.first - s.first_other, s.first_other + s.second_other, s.second - s.second_other,
            V(0.0f)};
  return {V(0.0f), s.first - s.first_other, s.first_other + (s.second - s.second_other),
          s.second_other + (s.third - s.third_other), s.third_other};
}

// Adds a corner's gradient times its share; gives the scalar product of gradient and distance (see
// edge_product).
template <class V, class B>
TYNDALL_VM_INLINE V add_edge(B h, V share, V dx, V dy, V dz, EdgeSums<V>& sums) {
  const auto first_y = less_signed(h, B(0xd5555555u)), second_y = less_signed(B(0x2aaaaaaau), h);
  const B first_sign = h << 31, second_sign = (h << 30) & B(0x80000000u);
  const V first = negate_if(share, first_sign), second = negate_if(share, second_sign);
  sums.first = sums.first + first;
  sums.first_other = add_where(first_y, sums.first_other, first);
  sums.second = sums.second + second;
  sums.second_other = add_where(second_y, sums.second_other, second);
  return negate_if(select(first_y, dy, dx), first_sign) + negate_if(select(second_y, dy, dz), second_sign);
}
template <class V, class B>
TYNDALL_VM_INLINE V add_edge(B h, V share, V dx, V dy, V dz, V dt, EdgeSums<V>& sums) {
  const auto first_y = less_signed(h, B(0xc0000000u)), second_z = less_signed(h, B(0u)),
             third_t = less_signed(h, B(0x40000000u));
  const B first_sign = h << 31, second_sign = (h << 30) & B(0x80000000u),
          third_sign = (h << 29) & B(0x80000000u);
  const V first = negate_if(share, first_sign), second = negate_if(share, second_sign),
          third = negate_if(share, third_sign);
  sums.first = sums.first + first;
  sums.first_other = add_where(first_y, sums.first_other, first);
  sums.second = sums.second + second;
  sums.second_other = add_where(second_z, sums.second_other, second);
  sums.third = sums.third + third;
  sums.third_other = add_where(third_t, sums.third_other, third);
  return negate_if(select(first_y, dy, dx), first_sign) + negate_if(select(second_z, dz, dy), second_sign) +
         negate_if(select(third_t, dt, dz), third_sign);
}

// The four corners at one end of z, blended: their value, and how it changes along x and y. Slice after slice
// there are registers enough.
template <class V>
struct SlopeSlice {
  V value, along_x, along_y;
};
template <class V, class X, class B, class... T>
TYNDALL_VM_INLINE SlopeSlice<V> slopes_of_slice(const X& x, const X& y, B key, V share, V dz,
                                                EdgeSums<V>& sums, T... time) {
  const auto edge = [&](B hash_y, V share_y, V dy, V& along_x) HWY_ATTR {
    const V low =
        add_edge(mix_lattice(x.low ^ hash_y), x.low_share * share_y, x.from_low, dy, dz, time..., sums);
    const V high =
        add_edge(mix_lattice(x.high ^ hash_y), x.high_share * share_y, x.from_high, dy, dz, time..., sums);
    along_x = high - low;
    return low + x.high_share * along_x;
  };
  V near_x(0.0f), far_x(0.0f);
  const V near = edge(y.low ^ key, y.low_share * share, y.from_low, near_x);
  const V far = edge(y.high ^ key, y.high_share * share, y.from_high, far_x);
  const V along_y = far - near;
  return {near + y.high_share * along_y, near_x + y.high_share * (far_x - near_x), along_y};
}

// The eight corners of a cell of space; `time` are the corners' distances in time, or nothing.
template <class V, class X, class B, class... T>
TYNDALL_VM_INLINE Slopes<V> slopes_of_cell(const X& x, const X& y, const X& z, B key, T... time) {
  const V zero(0.0f);
  EdgeSums<V> sums{zero, zero, zero, zero, zero, zero};
  const SlopeSlice<V> front = slopes_of_slice(x, y, z.low ^ key, z.low_share, z.from_low, sums, time...);
  const SlopeSlice<V> back = slopes_of_slice(x, y, z.high ^ key, z.high_share, z.from_high, sums, time...);
  Slopes<V> sum = slopes_of(sums, sizeof...(time) > 0);
  sum.value = blend(front.value, back.value, z.high_share);
  sum.x = sum.x + x.growth * blend(front.along_x, back.along_x, z.high_share);
  sum.y = sum.y + y.growth * blend(front.along_y, back.along_y, z.high_share);
  sum.z = sum.z + z.growth * (back.value - front.value);
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
