// Lookups in the voxels of grids (base/voxels.h says how they are kept).
#if defined(TYNDALL_VM_KERNELS_VOXELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_VOXELS_INL_H_
#undef TYNDALL_VM_KERNELS_VOXELS_INL_H_
#else
#define TYNDALL_VM_KERNELS_VOXELS_INL_H_
#endif

#include "vm/kernels/planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// The voxels' coordinates end at the border, which is background as is all beyond it. NaN counts as 0.
template <class V>
TYNDALL_VM_INLINE V moved_inside(V coordinate, std::int32_t size) {
  return lesser(greater(coordinate, V(0.0f)), V(static_cast<float>(size - 1)));
}

// A brick, and where its code of a voxel stands, in bytes.
template <class B>
struct CodePlace {
  B brick, offset;
};
template <class B>
TYNDALL_VM_INLINE CodePlace<B> code_place(const Voxels& voxels, B x, B y, B z) {
  const B seven(7u);
  const B blocks_x(static_cast<std::uint32_t>(voxels.blocks[0]));
  const B blocks_y(static_cast<std::uint32_t>(voxels.blocks[1]));
  const B block = look_up(voxels.block_at.data(), ((z >> 6) * blocks_y + (y >> 6)) * blocks_x + (x >> 6));
  const B in_block = ((z >> 3) & seven) << 6 | ((y >> 3) & seven) << 3 | ((x >> 3) & seven);
  const B brick = look_up(voxels.brick_in.data(), block << 9 | in_block);
  // Those without codes have step 0, and read the codes of brick 0.
  const auto stored = less_signed(brick, B(voxels.stored));
  const B with_codes = bits(select(stored, from_bits(brick), from_bits(B(0u))));
  constexpr std::uint32_t row = 2 * Voxels::brick_voxels, slice = row * Voxels::brick_voxels;
  return {brick, with_codes * B(2 * Voxels::codes_a_brick) + (z & seven) * B(slice) + (y & seven) * B(row) +
                     ((x & seven) << 1)};
}

// A whole number below 2^16 as a float.
template <class B>
TYNDALL_VM_INLINE auto number_of(B whole) {
  const auto shifted = from_bits(whole | B(0x4b000000u));  // 2^23 + whole
  return shifted - decltype(shifted)(0x1p23f);
}

template <class V>
TYNDALL_VM_INLINE V trilinear(const Voxels& voxels, V x, V y, V z) {
  x = moved_inside(x, voxels.size[0]), y = moved_inside(y, voxels.size[1]),
  z = moved_inside(z, voxels.size[2]);
  const V cell_x = floor(x), cell_y = floor(y), cell_z = floor(z);
  const auto at = code_place(voxels, index_of(cell_x), index_of(cell_y), index_of(cell_z));
  using B = decltype(at.brick);
  const V weight_x = x - cell_x, weight_y = y - cell_y, weight_z = z - cell_z;
  // Two neighbours along x stand in one word.
  const auto along_x = [&](std::uint32_t further) HWY_ATTR {
    const B both = look_up_word(voxels.codes.data(), at.offset + B(further));
    const V low = number_of(both & B(0xffffu));
    return low + (number_of(both >> 16) - low) * weight_x;
  };
  constexpr std::uint32_t row = 2 * Voxels::brick_voxels, slice = row * Voxels::brick_voxels;
  const V below = along_x(0), above = along_x(row), below_2 = along_x(slice), above_2 = along_x(slice + row);
  const V near = below + (above - below) * weight_y, far = below_2 + (above_2 - below_2) * weight_y;
  return look_up(voxels.lowest.data(), at.brick) +
         look_up(voxels.step.data(), at.brick) * (near + (far - near) * weight_z);
}

TYNDALL_VM_KERNEL3(voxels) { return trilinear(*options.tables->voxels[options.seed], a, b, c); }

TYNDALL_VM_KERNEL3(voxels_nearest) {
  const Voxels& voxels = *options.tables->voxels[options.seed];
  const auto nearest = [](V coordinate, std::int32_t size)
                           HWY_ATTR { return index_of(moved_inside(floor(coordinate + V(0.5f)), size)); };
  const auto at =
      code_place(voxels, nearest(a, voxels.size[0]), nearest(b, voxels.size[1]), nearest(c, voxels.size[2]));
  using B = decltype(at.brick);
  const V code = number_of(look_up_word(voxels.codes.data(), at.offset) & B(0xffffu));
  return look_up(voxels.lowest.data(), at.brick) + look_up(voxels.step.data(), at.brick) * code;
}

// The four voxels of a uniform cubic B-spline along an axis as two places between which they are interpolated
// linearly, and the second one's weight. Sigg and Hadwiger, "Fast Third-Order Texture Filtering", GPU Gems 2.
template <class V>
struct SplinePlaces {
  V first, second, weight;
};
template <class V>
TYNDALL_VM_INLINE SplinePlaces<V> spline_places(V coordinate, std::int32_t size) {
  const V x = moved_inside(coordinate, size), cell = floor(x), t = x - cell, rest = V(1.0f) - t;
  const V t2 = t * t, third(1.0f / 3), sixth(1.0f / 6);
  const V w1 = V(2.0f) * third - t2 + t2 * t * V(0.5f), w3 = t2 * t * sixth;
  const V w0 = rest * rest * rest * sixth, w2 = V(1.0f) - w0 - w1 - w3;
  const V second = w2 + w3;
  return {cell - V(1.0f) + w1 / (w0 + w1), cell + V(1.0f) + w3 / second, second};
}

TYNDALL_VM_KERNEL3(voxels_cubic) {
  const Voxels& voxels = *options.tables->voxels[options.seed];
  const auto x = spline_places(a, voxels.size[0]), y = spline_places(b, voxels.size[1]),
             z = spline_places(c, voxels.size[2]);
  const auto along_x = [&](V at_y, V at_z) HWY_ATTR {
    const V low = trilinear(voxels, x.first, at_y, at_z), high = trilinear(voxels, x.second, at_y, at_z);
    return low + (high - low) * x.weight;
  };
  const auto along_y = [&](V at_z) HWY_ATTR {
    const V low = along_x(y.first, at_z), high = along_x(y.second, at_z);
    return low + (high - low) * y.weight;
  };
  const V low = along_y(z.first), high = along_y(z.second);
  return low + (high - low) * z.weight;
}

// Between what the voxels lie that lookups in a box may read: from `before` voxels before its cells to
// `after` behind them.
HWY_INLINE Bound<Floats> range_over_boxes(const Voxels& voxels, const std::array<Bound<Floats>, 3>& box,
                                          float shift, std::int32_t before, std::int32_t after) {
  const FloatTag d;
  constexpr std::size_t most = HWY_MAX_BYTES / sizeof(float);
  HWY_ALIGN float first[3][most], last[3][most], lo[most], hi[most];
  auto beyond = never(box[0].lo);  // all in the border, or outside
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // NaN is looked up at 0.
    const Floats low = select(box[axis].nan, Floats(0.0f), box[axis].lo);
    const Floats end(static_cast<float>(voxels.size[axis] - 1));
    beyond = either(beyond, either(low >= end, both(box[axis].hi <= Floats(0.0f), !box[axis].nan)));
    hn::Store(floor(moved_inside(low + Floats(shift), voxels.size[axis])).raw, d, first[axis]);
    hn::Store(floor(moved_inside(box[axis].hi + Floats(shift), voxels.size[axis])).raw, d, last[axis]);
  }
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    VoxelCoord from, to;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[axis] = static_cast<std::int32_t>(first[axis][i]) - before;
      to[axis] = static_cast<std::int32_t>(last[axis][i]) + after;
    }
    const VoxelRange range = voxels.range(from, to);
    const float rounding = range.lo == range.hi ? 0 : range.size * kernel_error + least_float;
    lo[i] = range.lo - rounding;
    hi[i] = range.hi + rounding;
  }
  const auto nothing = both(beyond, Floats(voxels.background()) == Floats(0.0f));
  return {select(nothing, Floats(0.0f), Floats(hn::Load(d, lo))),
          select(nothing, Floats(0.0f), Floats(hn::Load(d, hi))), never(box[0].lo)};
}

TYNDALL_VM_BOUND3(voxels) {
  return range_over_boxes(*options.tables->voxels[options.seed], {a, b, c}, 0, 0, 0);
}
TYNDALL_VM_BOUND3(voxels_nearest) {
  return range_over_boxes(*options.tables->voxels[options.seed], {a, b, c}, 0.5f, 0, 0);
}
// A place that is rounded up to the next voxel reads the brick that begins there.
TYNDALL_VM_BOUND3(voxels_cubic) {
  return range_over_boxes(*options.tables->voxels[options.seed], {a, b, c}, 0, 1, 2);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
