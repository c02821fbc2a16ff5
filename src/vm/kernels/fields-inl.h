// What is summed from octaves of noise, and cells. All have zero mean and stay about within +-1.
#if defined(TYNDALL_VM_KERNELS_FIELDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_FIELDS_INL_H_
#undef TYNDALL_VM_KERNELS_FIELDS_INL_H_
#else
#define TYNDALL_VM_KERNELS_FIELDS_INL_H_
#endif

#include "vm/kernels/noise-inl.h"
#include "vm/kernels/noise_constants.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// The octaves' weighted mean of shape(noise): frequencies double, weights halve, and the origin moves between
// octaves because every one of them vanishes at its lattice points.
template <class V, class Shape, class... T>
TYNDALL_VM_INLINE V sum_of_octaves(const Options& options, const Shape& shape, V x, V y, V z, T... t) {
  V sum(0.0f);
  float weight = 1.0f, total = 0.0f;
  for (int octave = 0; octave < options.octaves; ++octave) {
    sum = sum + V(weight) * shape(gradient_noise(x, y, z, t...,
                                                 seed_key(options.seed, static_cast<std::uint32_t>(octave))));
    total += weight;
    weight *= 0.5f;
    x = x * V(2.0f) + V(0.3125f);
    y = y * V(2.0f) + V(0.6875f);
    z = z * V(2.0f) + V(0.4375f);
    ((t = t * V(2.0f) + V(0.5625f)), ...);
  }
  return sum * V(1.0f / total);
}

struct PlainShape {
  template <class V>
  HWY_INLINE V operator()(V n) const {
    return n;
  }
};
struct AbsoluteShape {
  template <class V>
  HWY_INLINE V operator()(V n) const {
    return abs(n);
  }
};
struct RidgeShape {
  template <class V>
  HWY_INLINE V operator()(V n) const {
    const V ridge = V(1.0f) - abs(n);
    return ridge * ridge;
  }
};

TYNDALL_VM_KERNEL3(fbm3) { return sum_of_octaves(options, PlainShape(), a, b, c); }
TYNDALL_VM_KERNEL4(fbm4) { return sum_of_octaves(options, PlainShape(), a, b, c, d); }
TYNDALL_VM_KERNEL3(turbulence3) {
  return (sum_of_octaves(options, AbsoluteShape(), a, b, c) - V(mean_absolute3)) *
         V(1 / (1 - mean_absolute3));
}
TYNDALL_VM_KERNEL4(turbulence4) {
  return (sum_of_octaves(options, AbsoluteShape(), a, b, c, d) - V(mean_absolute4)) *
         V(1 / (1 - mean_absolute4));
}
TYNDALL_VM_KERNEL3(ridged3) {
  return (sum_of_octaves(options, RidgeShape(), a, b, c) - V(mean_ridge3)) * V(1 / mean_ridge3);
}
TYNDALL_VM_KERNEL4(ridged4) {
  return (sum_of_octaves(options, RidgeShape(), a, b, c, d) - V(mean_ridge4)) * V(1 / mean_ridge4);
}

// Mean distance to the nearest feature point (one a cell, anywhere in it), at most 1: a point that is more
// than one cell away is farther than 1, so with the cap the 27 (81) cells around decide exactly (Worley,
// SIGGRAPH 1996).
inline constexpr float mean_distance3 = 0.52036f, mean_distance4 = 0.59002f;

// 8 bits of a hash as an offset in (0, 1).
template <class V, class B>
TYNDALL_VM_INLINE V offset_in_cell(B h, int shift) {
  return from_bits((((h >> shift) & B(0xffu)) << 15) | B(0x3f800000u)) - V(1.0f - 1.0f / 512);
}

// The smaller of `nearest` and the squared distances to the points of the nine cells around (x, y) in one
// slice.
template <class V, class B>
TYNDALL_VM_INLINE V nearest_in_slice(V nearest, V x, V y, B key_x, B key_y, V dz, V dt, B slice,
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
      nearest = min_of(square, nearest);
    }
  return nearest;
}

template <class V>
TYNDALL_VM_INLINE V nearest_distance(V x, V y, V z, V t, std::uint32_t key, bool has_time) {
  const V cell_x = floor(x), cell_y = floor(y), cell_z = floor(z), cell_t = floor(t);
  using B = decltype(bits(x));
  const B key_x = lattice_key(cell_x) * B(factor_x), key_y = lattice_key(cell_y) * B(factor_y);
  const B key_z = lattice_key(cell_z) * B(factor_z), key_t = lattice_key(cell_t) * B(factor_t);
  V nearest(1.0f);
  for (int l = has_time ? -1 : 0; l <= (has_time ? 1 : 0); ++l)
    for (int k = -1; k <= 1; ++k) {
      const B slice = (key_z + B(static_cast<std::uint32_t>(k) * factor_z)) ^
                      (key_t + B(static_cast<std::uint32_t>(l) * factor_t)) ^ B(key);
      nearest = nearest_in_slice(nearest, x - cell_x, y - cell_y, key_x, key_y,
                                 V(static_cast<float>(k)) - (z - cell_z),
                                 V(static_cast<float>(l)) - (t - cell_t), slice, has_time);
    }
  return sqrt(nearest);
}
TYNDALL_VM_KERNEL3(cells3) {
  const V distance = nearest_distance(a, b, c, V(0.0f), seed_key(options.seed, 0), false);
  return (distance - V(mean_distance3)) * V(1 / mean_distance3);
}
TYNDALL_VM_KERNEL4(cells4) {
  const V distance = nearest_distance(a, b, c, d, seed_key(options.seed, 0), true);
  return (distance - V(mean_distance4)) * V(1 / mean_distance4);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
