// Intervals of the noises: the value and gradient at the box's middle with a bound on the curvature where the
// box is small against the lattice, the supremum where it is not.
//
// Gradient noise is twice continuously differentiable, and linear in the gradients at its corners, so every
// extreme over all noises is a maximum over places in one cell of a sum over its corners, each with the
// gradient that suits it best. The constants below were found so; tests/vm/noise_constants_test.cpp finds
// them again.
#if defined(TYNDALL_VM_KERNELS_INTERVAL_FIELDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_INTERVAL_FIELDS_INL_H_
#undef TYNDALL_VM_KERNELS_INTERVAL_FIELDS_INL_H_
#else
#define TYNDALL_VM_KERNELS_INTERVAL_FIELDS_INL_H_
#endif

#include "vm/kernels/bounds-inl.h"
#include "vm/kernels/fields-inl.h"
#include "vm/kernels/noise_constants.h"
#include "vm/kernels/slopes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Beyond this the lattice's coordinates are no whole numbers of one step any more (hash-inl.h), and only the
// supremum holds.
inline constexpr float lattice_limit = 0x1p21f;
// More than the rounding of one noise, of its slopes, and of the sum of its octaves.
inline constexpr float noise_rounding = 4e-6f, slope_rounding = 1e-4f;

// A box as its middle and its half widths, rounded up.
template <class V>
struct Ball {
  V center, radius;
};
template <class V>
TYNDALL_VM_INLINE Ball<V> ball_of(Bound<V> a) {
  const V center = a.lo * V(0.5f) + a.hi * V(0.5f);
  return {center, greater(a.hi - center, center - a.lo) * V(1.0f + 0x1p-20f)};
}

// The operands of a field; `t` is not read when there is no time.
template <class V, bool has_time>
struct FieldBox {
  Bound<V> x, y, z, t;
};
template <bool has_time, class V>
TYNDALL_VM_INLINE MaskOf<V> may_be_nan(const FieldBox<V, has_time>& box) {
  const auto space = either(either(box.x.nan, box.y.nan), box.z.nan);
  if constexpr (has_time)
    return either(space, box.t.nan);
  else
    return space;
}
// The largest coordinate.
template <bool has_time, class V>
TYNDALL_VM_INLINE V largest_size(const FieldBox<V, has_time>& box) {
  const V space = greater(greater(largest_size(box.x), largest_size(box.y)), largest_size(box.z));
  if constexpr (has_time)
    return greater(space, largest_size(box.t));
  else
    return space;
}

// A box of one octave: its middle and half widths, the largest of these, and the largest coordinate.
template <class V, bool has_time>
struct OctaveBox {
  Ball<V> x, y, z, t;
  V radius, size;
};
template <bool has_time, class V>
TYNDALL_VM_INLINE OctaveBox<V, has_time> first_octave(const FieldBox<V, has_time>& box) {
  OctaveBox<V, has_time> out{ball_of(box.x), ball_of(box.y), ball_of(box.z),
                             ball_of(box.t), V(0.0f),        largest_size(box)};
  out.radius = greater(greater(out.x.radius, out.y.radius), out.z.radius);
  if constexpr (has_time) out.radius = greater(out.radius, out.t.radius);
  return out;
}
// Each doubling rounds places and middles by up to half an ulp of `size`: the largest half width grows by
// both, those of the axes are made up for by `rest` of noise_over_box.
template <bool has_time, class V>
TYNDALL_VM_INLINE OctaveBox<V, has_time> next_octave(const OctaveBox<V, has_time>& box) {
  const V two(2.0f);
  const auto doubled = [&](Ball<V> a, float offset) HWY_ATTR {
    return Ball<V>{a.center * two + V(offset), a.radius * two};
  };
  const V size = box.size * two + V(1.0f);
  return {doubled(box.x, 0.3125f),
          doubled(box.y, 0.6875f),
          doubled(box.z, 0.4375f),
          has_time ? doubled(box.t, 0.5625f) : box.t,
          box.radius * two + size * V(0x1p-22f),
          size};
}
// Coordinates that octaves have doubled beyond the largest float give NaN.
template <bool has_time, class V>
TYNDALL_VM_INLINE MaskOf<V> overflows(const OctaveBox<V, has_time>& box) {
  return !(box.size < V(endless));
}

// One noise over a box: n + g (p - middle) within `rest`, or the bounds alone where the box is too large for
// that.
template <class V>
struct NoiseOverBox {
  Slopes<V> slopes;
  V rest, half;  // half: of the whole bound around n
  MaskOf<V> small, linear;
};
template <bool has_time, class V>
TYNDALL_VM_INLINE NoiseOverBox<V> noise_over_box(const OctaveBox<V, has_time>& box, std::uint32_t key) {
  constexpr NoiseConstants constants = has_time ? noise_constants4 : noise_constants3;
  const V zero(0.0f), most(constants.supremum);
  const V curvature = V(0.5f * constants.curvature) * box.radius * box.radius;
  const auto small = both(curvature < most, box.size < V(lattice_limit));
  NoiseOverBox<V> out{{zero, zero, zero, zero, zero}, zero, zero, small, never(zero)};
  if (!any(small)) return out;
  if constexpr (has_time)
    out.slopes = noise_slopes(box.x.center, box.y.center, box.z.center, box.t.center, key);
  else
    out.slopes = noise_slopes(box.x.center, box.y.center, box.z.center, key);
  const Slopes<V>& s = out.slopes;
  const V steep_x = abs(s.x), steep_y = abs(s.y), steep_z = abs(s.z);
  V reach = steep_x * box.x.radius + steep_y * box.y.radius + steep_z * box.z.radius;
  V steepness = steep_x + steep_y + steep_z;
  if constexpr (has_time) {
    reach = reach + abs(s.t) * box.t.radius;
    steepness = steepness + abs(s.t);
  }
  // Octaves' coordinates are rounded: their distances from the middle are a few ulps off the first octave's.
  out.rest = curvature + V(noise_rounding) + V(slope_rounding) * box.radius +
             steepness * (box.size + V(1.0f)) * V(0x1p-18f);
  out.half = reach + out.rest;
  out.linear = both(small, out.half < V(0.8f * constants.supremum));
  return out;
}
// The bounds alone.
template <bool has_time, class V>
TYNDALL_VM_INLINE Bound<V> bound_of(const NoiseOverBox<V>& n, MaskOf<V> nan) {
  const V most((has_time ? noise_constants4 : noise_constants3).supremum);
  return {select(n.small, greater(-most, n.slopes.value - n.half), -most),
          select(n.small, lesser(most, n.slopes.value + n.half), most), nan};
}

inline float sum_of_weights(int octaves) {
  float weight = 1.0f, total = 0.0f;
  for (int octave = 0; octave < octaves; ++octave, weight *= 0.5f) total += weight;
  return total;
}

// Octaves of plain noise. Their gradients are added before they are bounded: those of different octaves
// cancel.
template <bool has_time, class V>
TYNDALL_VM_INLINE Bound<V> fbm_over_box(const Options& options, int octaves,
                                        const FieldBox<V, has_time>& box) {
  constexpr NoiseConstants constants = has_time ? noise_constants4 : noise_constants3;
  const V zero(0.0f);
  const auto nan = may_be_nan(box);
  const OctaveBox<V, has_time> first = first_octave(box);
  OctaveBox<V, has_time> at = first;
  Slopes<V> sum{zero, zero, zero, zero, zero};
  V rest = zero;
  float weight = 1.0f, frequency = 1.0f;
  for (int octave = 0; octave < octaves; ++octave) {
    const auto n = noise_over_box(at, seed_key(options.seed, static_cast<std::uint32_t>(octave)));
    if (all(n.linear)) {
      const V share(weight * frequency);
      sum.value = sum.value + n.slopes.value * V(weight);
      rest = rest + n.rest * V(weight);
      sum.x = sum.x + n.slopes.x * share;
      sum.y = sum.y + n.slopes.y * share;
      sum.z = sum.z + n.slopes.z * share;
      if constexpr (has_time) sum.t = sum.t + n.slopes.t * share;
    } else {
      const V share = select(n.linear, V(weight * frequency), zero), half(0.5f * weight);
      const Bound<V> alone = bound_of<has_time>(n, nan);
      sum.value = sum.value + select(n.linear, n.slopes.value * V(weight), (alone.lo + alone.hi) * half);
      rest = rest + select(n.linear, n.rest * V(weight), (alone.hi - alone.lo) * half);
      if (any(n.linear)) {
        sum.x = sum.x + select(n.linear, n.slopes.x * share, zero);
        sum.y = sum.y + select(n.linear, n.slopes.y * share, zero);
        sum.z = sum.z + select(n.linear, n.slopes.z * share, zero);
        if constexpr (has_time) sum.t = sum.t + select(n.linear, n.slopes.t * share, zero);
      }
    }
    weight *= 0.5f;
    frequency *= 2.0f;
    at = next_octave(at);
  }
  V reach = abs(sum.x) * first.x.radius + abs(sum.y) * first.y.radius + abs(sum.z) * first.z.radius;
  if constexpr (has_time) reach = reach + abs(sum.t) * first.t.radius;
  const V scale(1.0f / sum_of_weights(octaves));
  const V half = (select(reach < V(endless), reach, V(endless)) + rest) * scale + V(noise_rounding);
  const V most(constants.supremum + noise_rounding), middle = sum.value * scale;
  return {greater(-most, middle - half), lesser(most, middle + half), either(nan, overflows(at))};
}

// Octaves of a shape of noise: each octave's bounds, through the shape.
template <bool has_time, class V, class Shape>
TYNDALL_VM_INLINE Bound<V> shapes_over_box(const Options& options, const Shape& shape,
                                           const FieldBox<V, has_time>& box) {
  const auto nan = may_be_nan(box);
  V lo(0.0f), hi(0.0f);
  float weight = 1.0f;
  OctaveBox<V, has_time> at = first_octave(box);
  for (int octave = 0; octave < options.octaves; ++octave) {
    const auto n = noise_over_box(at, seed_key(options.seed, static_cast<std::uint32_t>(octave)));
    const Bound<V> size = size_of(bound_of<has_time>(n, nan));
    // Both shapes are monotone in |noise| up to 1, and the ridge rises again from 1 to the supremum.
    const V one(1.0f), least = lesser(shape(lesser(one, size.lo)), shape(lesser(one, size.hi)));
    lo = lo + least * V(weight);
    hi = hi + greater(shape(size.lo), shape(size.hi)) * V(weight);
    weight *= 0.5f;
    at = next_octave(at);
  }
  const V scale(1.0f / sum_of_weights(options.octaves)), slack(noise_rounding);
  return {lo * scale - slack, hi * scale + slack, either(nan, overflows(at))};
}
// (a - mean) * factor, widened by its rounding.
template <class V>
TYNDALL_VM_INLINE Bound<V> centered(Bound<V> a, float mean, float factor) {
  return {(a.lo - V(mean)) * V(factor) - V(noise_rounding), (a.hi - V(mean)) * V(factor) + V(noise_rounding),
          a.nan};
}

#define TYNDALL_VM_SPACE \
  FieldBox<V, false> { a, b, c, a }
#define TYNDALL_VM_SPACE_AND_TIME \
  FieldBox<V, true> { a, b, c, d }
TYNDALL_VM_BOUND3(noise3) { return fbm_over_box(options, 1, TYNDALL_VM_SPACE); }
TYNDALL_VM_BOUND4(noise4) { return fbm_over_box(options, 1, TYNDALL_VM_SPACE_AND_TIME); }
TYNDALL_VM_BOUND3(fbm3) { return fbm_over_box(options, options.octaves, TYNDALL_VM_SPACE); }
TYNDALL_VM_BOUND4(fbm4) { return fbm_over_box(options, options.octaves, TYNDALL_VM_SPACE_AND_TIME); }
TYNDALL_VM_BOUND3(turbulence3) {
  return centered(shapes_over_box(options, AbsoluteShape(), TYNDALL_VM_SPACE), mean_absolute3,
                  1 / (1 - mean_absolute3));
}
TYNDALL_VM_BOUND4(turbulence4) {
  return centered(shapes_over_box(options, AbsoluteShape(), TYNDALL_VM_SPACE_AND_TIME), mean_absolute4,
                  1 / (1 - mean_absolute4));
}
TYNDALL_VM_BOUND3(ridged3) {
  return centered(shapes_over_box(options, RidgeShape(), TYNDALL_VM_SPACE), mean_ridge3, 1 / mean_ridge3);
}
TYNDALL_VM_BOUND4(ridged4) {
  return centered(shapes_over_box(options, RidgeShape(), TYNDALL_VM_SPACE_AND_TIME), mean_ridge4,
                  1 / mean_ridge4);
}

// A distance changes by at most as much as the place: how far those in a box are from the one at its middle.
template <class V>
TYNDALL_VM_INLINE V reach_of_box(V half_diagonal, V size) {
  return half_diagonal * V(1.0f + kernel_error) + V(noise_rounding) + size * V(0x1p-21f);
}
// A distance of at most 1; `exact`: whether the lattice is, in the box.
template <class V>
TYNDALL_VM_INLINE Bound<V> distance_over_box(V middle, V half, MaskOf<V> exact, MaskOf<V> nan) {
  const auto known = both(half < V(1.0f), exact);
  const V lo = select(known, greater(V(0.0f), middle - half), V(0.0f));
  const V hi = select(known, lesser(V(1.0f), middle + half), V(1.0f));
  return {lo, hi, nan};
}
// Of cells, from their scaled value at the middle.
template <class V>
TYNDALL_VM_INLINE Bound<V> cells_over_box(V at_middle, V half_diagonal, V size, float mean, MaskOf<V> nan) {
  const V middle = at_middle * V(mean) + V(mean);  // undoes op_cells' scaling
  return centered(distance_over_box(middle, reach_of_box(half_diagonal, size), size < V(lattice_limit), nan),
                  mean, 1 / mean);
}
TYNDALL_VM_BOUND3(cells3) {
  const Ball<V> x = ball_of(a), y = ball_of(b), z = ball_of(c);
  const V size = greater(greater(largest_size(a), largest_size(b)), largest_size(c));
  return cells_over_box(op_cells3(options, x.center, y.center, z.center),
                        op_length3(options, x.radius, y.radius, z.radius), size, mean_distance3,
                        may_be_nan(TYNDALL_VM_SPACE));
}
TYNDALL_VM_BOUND4(cells4) {
  const Ball<V> x = ball_of(a), y = ball_of(b), z = ball_of(c), t = ball_of(d);
  const V size =
      greater(greater(largest_size(a), largest_size(b)), greater(largest_size(c), largest_size(d)));
  return cells_over_box(op_cells4(options, x.center, y.center, z.center, t.center),
                        op_length2(options, op_length3(options, x.radius, y.radius, z.radius), t.radius),
                        size, mean_distance4, may_be_nan(TYNDALL_VM_SPACE_AND_TIME));
}

// A component of curl is the difference of two slopes: each changes by at most one row of curvatures times
// the half width, and is never steeper than the steepest slope.
template <bool has_time, class V>
TYNDALL_VM_INLINE Bound<V> slopes_over_box(V at_middle, const FieldBox<V, has_time>& box) {
  constexpr NoiseConstants constants = has_time ? noise_constants4 : noise_constants3;
  V radius = greater(greater(ball_of(box.x).radius, ball_of(box.y).radius), ball_of(box.z).radius);
  V size = greater(greater(largest_size(box.x), largest_size(box.y)), largest_size(box.z));
  if constexpr (has_time) {
    radius = greater(radius, ball_of(box.t).radius);
    size = greater(size, largest_size(box.t));
  }
  const V most(2 * curl_scale * constants.slope + slope_rounding);
  const V half = V(2 * curl_scale * constants.curvature_row) * radius + V(slope_rounding);
  const auto known = both(half < most, size < V(lattice_limit));
  return {select(known, greater(-most, at_middle - half), -most),
          select(known, lesser(most, at_middle + half), most), may_be_nan(box)};
}
TYNDALL_VM_BOUND3(curl3_x) {
  return slopes_over_box(op_curl3_x(options, ball_of(a).center, ball_of(b).center, ball_of(c).center),
                         TYNDALL_VM_SPACE);
}
TYNDALL_VM_BOUND3(curl3_y) {
  return slopes_over_box(op_curl3_y(options, ball_of(a).center, ball_of(b).center, ball_of(c).center),
                         TYNDALL_VM_SPACE);
}
TYNDALL_VM_BOUND3(curl3_z) {
  return slopes_over_box(op_curl3_z(options, ball_of(a).center, ball_of(b).center, ball_of(c).center),
                         TYNDALL_VM_SPACE);
}
#define TYNDALL_VM_MIDDLE4 ball_of(a).center, ball_of(b).center, ball_of(c).center, ball_of(d).center
TYNDALL_VM_BOUND4(curl4_x) {
  return slopes_over_box(op_curl4_x(options, TYNDALL_VM_MIDDLE4), TYNDALL_VM_SPACE_AND_TIME);
}
TYNDALL_VM_BOUND4(curl4_y) {
  return slopes_over_box(op_curl4_y(options, TYNDALL_VM_MIDDLE4), TYNDALL_VM_SPACE_AND_TIME);
}
TYNDALL_VM_BOUND4(curl4_z) {
  return slopes_over_box(op_curl4_z(options, TYNDALL_VM_MIDDLE4), TYNDALL_VM_SPACE_AND_TIME);
}
#undef TYNDALL_VM_MIDDLE4
#undef TYNDALL_VM_SPACE_AND_TIME
#undef TYNDALL_VM_SPACE

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
