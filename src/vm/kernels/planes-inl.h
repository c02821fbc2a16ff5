// Lookups in the planes of images.
#if defined(TYNDALL_VM_KERNELS_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_PLANES_INL_H_
#undef TYNDALL_VM_KERNELS_PLANES_INL_H_
#else
#define TYNDALL_VM_KERNELS_PLANES_INL_H_
#endif

#include "vm/kernels/arithmetic-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// The two texels around a coordinate of a row of n that repeats, and how far it is from the first to the
// second. Texel i has its middle at (i + 1/2) / n. NaN and infinity count as 0.
template <class V>
struct TexelPair {
  V first, second, weight;
};
template <class V>
TYNDALL_VM_INLINE TexelPair<V> texels_around(V coordinate, int n) {
  const V size(static_cast<float>(n));
  V part = coordinate - floor(coordinate);
  part = select(part == part, part, V(0.0f));
  const V x = part * size - V(0.5f), cell = floor(x), next = cell + V(1.0f);
  return {select(cell < V(0.0f), size - V(1.0f), cell), select(next < size, next, V(0.0f)), x - cell};
}

// A whole number in [0, 2^23) as an integer.
template <class V>
TYNDALL_VM_INLINE auto index_of(V whole) {
  return bits(whole + V(0x1p23f)) & decltype(bits(whole))(0x7fffffu);
}

// Texels that are not in memory, one after the other.
inline float paged_texel(const Plane& plane, std::uint32_t column, std::uint32_t row) {
  return plane.at(static_cast<int>(column), static_cast<int>(row));
}
HWY_INLINE Floats paged_texel(const Plane& plane, Bits column, Bits row) {
  constexpr std::size_t most = HWY_MAX_BYTES / sizeof(float);
  HWY_ALIGN std::uint32_t columns[most], rows[most];
  HWY_ALIGN float texels[most];
  hn::Store(column.raw, BitsTag(), columns);
  hn::Store(row.raw, BitsTag(), rows);
  for (std::size_t i = 0; i < hn::Lanes(FloatTag()); ++i)
    texels[i] = plane.at(static_cast<int>(columns[i]), static_cast<int>(rows[i]));
  return Floats(hn::Load(FloatTag(), texels));
}

TYNDALL_VM_KERNEL2(plane) {
  const Plane& plane = *options.tables->planes[options.seed];
  const TexelPair<V> x = texels_around(a, plane.width), y = texels_around(b, plane.height);
  const auto left = index_of(x.first), right = index_of(x.second);
  const auto lower = index_of(y.first), upper = index_of(y.second);
  const decltype(left) width(static_cast<std::uint32_t>(plane.width));
  const auto low = lower * width, high = upper * width;
  const float* texels = plane.texels.data();
  const auto texel = [&](auto column, auto row, auto row_begin) HWY_ATTR {
    return plane.paged ? paged_texel(plane, column, row) : look_up(texels, row_begin + column);
  };
  const V low_left = texel(left, lower, low), low_right = texel(right, lower, low);
  const V high_left = texel(left, upper, high), high_right = texel(right, upper, high);
  const V below = low_left + (low_right - low_left) * x.weight;
  const V above = high_left + (high_right - high_left) * x.weight;
  return below + (above - below) * y.weight;
}

// Anywhere in the picture. NaN is looked up at 0, so the value is always a number.
TYNDALL_VM_BOUND2(plane) {
  const Plane& plane = *options.tables->planes[options.seed];
  return widened(Bound<V>{V(plane.lowest), V(plane.highest), never(a.lo + b.lo)}, kernel_error, least_float);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
