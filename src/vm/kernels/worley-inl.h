// Worley's cellular basis (SIGGRAPH 1996): distances to the nearest and to the second nearest of scattered
// points, and which the nearest is; with their intervals. The points are those of `cells`.
#if defined(TYNDALL_VM_KERNELS_WORLEY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_WORLEY_INL_H_
#undef TYNDALL_VM_KERNELS_WORLEY_INL_H_
#else
#define TYNDALL_VM_KERNELS_WORLEY_INL_H_
#endif

#include "vm/kernels/interval-fields-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Squares of the two distances, at most 1 each, and a number in [0, 1) that the nearest point's cell has.
template <class V>
struct TwoNearest {
  V first, second, id;
};

template <class V, class B>
TYNDALL_VM_INLINE void look_at_slice(TwoNearest<V>& found, V x, V y, B key_x, B key_y, V dz, V dt, B slice,
                                     bool has_time) {
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const B h = mix_lattice((key_x + B(static_cast<std::uint32_t>(i) * factor_x)) ^
                              (key_y + B(static_cast<std::uint32_t>(j) * factor_y)) ^ slice);
      const V dx = V(static_cast<float>(i)) + offset_in_cell<V>(h, 0) - x;
      const V dy = V(static_cast<float>(j)) + offset_in_cell<V>(h, 8) - y;
      const V to_z = dz + offset_in_cell<V>(h, 16);
      V square = dx * dx + dy * dy + to_z * to_z;
      if (has_time) {
        const V to_t = dt + offset_in_cell<V>(h, 24);
        square = square + to_t * to_t;
      }
      const auto closer = square < found.first;
      found.second = select(closer, found.first, min_of(square, found.second));
      found.first = min_of(square, found.first);
      found.id = select(closer, unit_float((h ^ (h >> 16)) * B(0x21f0aaadu)), found.id);
    }
}

template <class V>
TYNDALL_VM_INLINE TwoNearest<V> two_nearest(V x, V y, V z, V t, std::uint32_t key, bool has_time) {
  const V cell_x = floor(x), cell_y = floor(y), cell_z = floor(z), cell_t = floor(t);
  using B = decltype(bits(x));
  const B key_x = lattice_key(cell_x) * B(factor_x), key_y = lattice_key(cell_y) * B(factor_y);
  const B key_z = lattice_key(cell_z) * B(factor_z), key_t = lattice_key(cell_t) * B(factor_t);
  TwoNearest<V> found{V(1.0f), V(1.0f), V(0.0f)};
  for (int l = has_time ? -1 : 0; l <= (has_time ? 1 : 0); ++l)
    for (int k = -1; k <= 1; ++k) {
      const B slice = (key_z + B(static_cast<std::uint32_t>(k) * factor_z)) ^
                      (key_t + B(static_cast<std::uint32_t>(l) * factor_t)) ^ B(key);
      look_at_slice(found, x - cell_x, y - cell_y, key_x, key_y, V(static_cast<float>(k)) - (z - cell_z),
                    V(static_cast<float>(l)) - (t - cell_t), slice, has_time);
    }
  return found;
}
template <class V>
TYNDALL_VM_INLINE TwoNearest<V> two_nearest(const Options& options, V x, V y, V z) {
  return two_nearest(x, y, z, V(0.0f), seed_key(options.seed, 0), false);
}
template <class V>
TYNDALL_VM_INLINE TwoNearest<V> two_nearest(const Options& options, V x, V y, V z, V t) {
  return two_nearest(x, y, z, t, seed_key(options.seed, 0), true);
}
TYNDALL_VM_KERNEL3(worley3_first) { return sqrt(two_nearest(options, a, b, c).first); }
TYNDALL_VM_KERNEL3(worley3_second) { return sqrt(two_nearest(options, a, b, c).second); }
TYNDALL_VM_KERNEL3(worley3_id) { return two_nearest(options, a, b, c).id; }
TYNDALL_VM_KERNEL4(worley4_first) { return sqrt(two_nearest(options, a, b, c, d).first); }
TYNDALL_VM_KERNEL4(worley4_second) { return sqrt(two_nearest(options, a, b, c, d).second); }
TYNDALL_VM_KERNEL4(worley4_id) { return two_nearest(options, a, b, c, d).id; }

// What a box holds: the points of its middle, how far the distances may differ from those there, and whether
// the lattice is exact in it.
template <class V>
struct WorleyBox {
  TwoNearest<V> at_middle;
  V half;
  MaskOf<V> exact, nan;
};
template <class V>
TYNDALL_VM_INLINE WorleyBox<V> worley_box(const Options& options, Bound<V> a, Bound<V> b, Bound<V> c) {
  const Ball<V> x = ball_of(a), y = ball_of(b), z = ball_of(c);
  const V size = greater(greater(largest_size(a), largest_size(b)), largest_size(c));
  return {two_nearest(options, x.center, y.center, z.center),
          reach_of_box(op_length3(options, x.radius, y.radius, z.radius), size), size < V(lattice_limit),
          may_be_nan(FieldBox<V, false>{a, b, c, c})};
}
template <class V>
TYNDALL_VM_INLINE WorleyBox<V> worley_box(const Options& options, Bound<V> a, Bound<V> b, Bound<V> c,
                                          Bound<V> d) {
  const Ball<V> x = ball_of(a), y = ball_of(b), z = ball_of(c), t = ball_of(d);
  const V size =
      greater(greater(largest_size(a), largest_size(b)), greater(largest_size(c), largest_size(d)));
  const V diagonal = op_length2(options, op_length3(options, x.radius, y.radius, z.radius), t.radius);
  return {two_nearest(options, x.center, y.center, z.center, t.center), reach_of_box(diagonal, size),
          size < V(lattice_limit), may_be_nan(FieldBox<V, true>{a, b, c, d})};
}

// The nearest point stays the nearest where no other can come as near.
template <class V>
TYNDALL_VM_INLINE Bound<V> id_over_box(const WorleyBox<V>& box) {
  const auto alone = sqrt(box.at_middle.first) + box.half < sqrt(box.at_middle.second) - box.half;
  const auto known = both(both(box.exact, alone), !box.nan);
  return {select(known, box.at_middle.id, V(0.0f)), select(known, box.at_middle.id, V(1.0f - 0x1p-23f)),
          never(box.half)};
}
template <class V>
TYNDALL_VM_INLINE Bound<V> worley_distance(const WorleyBox<V>& box, V square) {
  return distance_over_box(sqrt(square), box.half, box.exact, box.nan);
}
TYNDALL_VM_BOUND3(worley3_first) {
  const auto box = worley_box(options, a, b, c);
  return worley_distance(box, box.at_middle.first);
}
TYNDALL_VM_BOUND3(worley3_second) {
  const auto box = worley_box(options, a, b, c);
  return worley_distance(box, box.at_middle.second);
}
TYNDALL_VM_BOUND3(worley3_id) { return id_over_box(worley_box(options, a, b, c)); }
TYNDALL_VM_BOUND4(worley4_first) {
  const auto box = worley_box(options, a, b, c, d);
  return worley_distance(box, box.at_middle.first);
}
TYNDALL_VM_BOUND4(worley4_second) {
  const auto box = worley_box(options, a, b, c, d);
  return worley_distance(box, box.at_middle.second);
}
TYNDALL_VM_BOUND4(worley4_id) { return id_over_box(worley_box(options, a, b, c, d)); }

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
