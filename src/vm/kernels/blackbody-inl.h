// The colour of a black body, from a table.
#if defined(TYNDALL_VM_KERNELS_BLACKBODY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_BLACKBODY_INL_H_
#undef TYNDALL_VM_KERNELS_BLACKBODY_INL_H_
#else
#define TYNDALL_VM_KERNELS_BLACKBODY_INL_H_
#endif

#include "base/interval.h"
#include "vm/kernels/arithmetic-inl.h"
#include "vm/kernels/blackbody.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Straight lines between entries; equal steps of 1/T, in which the colours are smooth. NaN stays; at or below
// 0 K the colour is that of the coolest entry.
template <class V>
TYNDALL_VM_INLINE V blackbody_component(V kelvin, const float* table) {
  const V warm = max_of(kelvin, V(blackbody_coolest));
  const V place =
      V(blackbody_coolest * (blackbody_entries - 1)) / warm;  // from the infinitely hot to the coolest
  const V cell =
      lesser(V(static_cast<float>(blackbody_entries - 2)), floor(select(place == place, place, V(0.0f))));
  const auto index = bits(cell + V(0x1p23f)) & decltype(bits(cell))(0x7fffffu);
  const V low = look_up(table, index), high = look_up(table + 1, index);
  return low + (high - low) * (place - cell);
}
TYNDALL_VM_KERNEL1(blackbody_r) { return blackbody_component(a, blackbody_table().red.data()); }
TYNDALL_VM_KERNEL1(blackbody_g) { return blackbody_component(a, blackbody_table().green.data()); }
TYNDALL_VM_KERNEL1(blackbody_b) { return blackbody_component(a, blackbody_table().blue.data()); }

// Between two temperatures the component's two ends, while both lie between the same entries of the table,
// where the kernel is a straight line; otherwise the whole table's extremes.
template <class V>
TYNDALL_VM_INLINE Bound<V> blackbody_bound(Bound<V> kelvin, const float* table, Interval<float> range) {
  const auto place = [&](V k) HWY_ATTR {
    return floor(V(blackbody_coolest * (blackbody_entries - 1)) / greater(k, V(blackbody_coolest)));
  };
  const V p = blackbody_component(kelvin.lo, table), q = blackbody_component(kelvin.hi, table);
  const auto one_line = both(place(kelvin.lo) == place(kelvin.hi), is_bounded(kelvin));
  const Bound<V> result = {select(one_line, lesser(p, q), V(range.lo)),
                           select(one_line, greater(p, q), V(range.hi)), kelvin.nan};
  return widened(result, kernel_error, least_float);
}
TYNDALL_VM_BOUND1(blackbody_r) {
  return blackbody_bound(a, blackbody_table().red.data(), blackbody_table().red_range);
}
TYNDALL_VM_BOUND1(blackbody_g) {
  return blackbody_bound(a, blackbody_table().green.data(), blackbody_table().green_range);
}
TYNDALL_VM_BOUND1(blackbody_b) {
  return blackbody_bound(a, blackbody_table().blue.data(), blackbody_table().blue_range);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
