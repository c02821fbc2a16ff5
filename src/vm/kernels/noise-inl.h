// Gradient noise (Perlin, "Improving Noise", SIGGRAPH 2002) in three and four dimensions, hashed, without
// tables.
//
// The gradients are the 12 edges of a cube (the 32 of its four-dimensional counterpart), the fade is quintic.
// In three dimensions the supremum is 1.0364, in four 1.0244. The coordinates may be Duals: then the result
// carries a derivative.
#if defined(TYNDALL_VM_KERNELS_NOISE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_NOISE_INL_H_
#undef TYNDALL_VM_KERNELS_NOISE_INL_H_
#else
#define TYNDALL_VM_KERNELS_NOISE_INL_H_
#endif

#include "vm/kernels/hash-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// A value and its derivative along one direction. Its functions are templates outside of it: members of a
// class template would not be compiled for the SIMD class.
template <class V>
struct Dual {
  V value, slope;
};
template <class V>
TYNDALL_VM_INLINE Dual<V> operator+(Dual<V> a, Dual<V> b) {
  return {a.value + b.value, a.slope + b.slope};
}
template <class V>
TYNDALL_VM_INLINE Dual<V> operator-(Dual<V> a, Dual<V> b) {
  return {a.value - b.value, a.slope - b.slope};
}
template <class V>
TYNDALL_VM_INLINE Dual<V> operator*(Dual<V> a, Dual<V> b) {
  return {a.value * b.value, a.value * b.slope + a.slope * b.value};
}
// The coordinate along which the derivative is taken, and one that stays.
template <class V>
TYNDALL_VM_INLINE Dual<V> moving(V v) {
  return {v, V(1.0f)};
}
template <class V>
TYNDALL_VM_INLINE Dual<V> fixed(V v) {
  return {v, V(0.0f)};
}
// A constant as a value of the type of the first argument.
template <class V>
TYNDALL_VM_INLINE V constant_like(V, V c) {
  return c;
}
template <class V>
TYNDALL_VM_INLINE Dual<V> constant_like(Dual<V>, V c) {
  return fixed(c);
}
template <class V>
TYNDALL_VM_INLINE V value_of(Dual<V> a) {
  return a.value;
}
template <class V>
TYNDALL_VM_INLINE V value_of(V a) {
  return a;
}
template <class M, class V>
TYNDALL_VM_INLINE Dual<V> select(M m, Dual<V> a, Dual<V> b) {
  return {select(m, a.value, b.value), select(m, a.slope, b.slope)};
}
// Negates where the upper bit of `sign` is set; its other bits must be clear.
template <class V, class B>
TYNDALL_VM_INLINE V negate_if(V a, B sign) {
  return from_bits(bits(a) ^ sign);
}
template <class V, class B>
TYNDALL_VM_INLINE Dual<V> negate_if(Dual<V> a, B sign) {
  return {negate_if(a.value, sign), negate_if(a.slope, sign)};
}

// One axis of the lattice cell that holds a point: distances from its two ends, their hashes, and the fade.
template <class W, class B>
struct CellAxis {
  W from_low, from_high, fade;
  B low, high;
};
template <class W>
TYNDALL_VM_INLINE auto cell_axis(W x, std::uint32_t factor) {
  const auto low = floor(value_of(x));
  using V = decltype(value_of(x));
  using B = decltype(bits(low));
  const W t = x - constant_like(x, low);
  const auto c = [&](float v) HWY_ATTR { return constant_like(x, V(v)); };
  const W fade = t * t * t * (t * (t * c(6.0f) - c(15.0f)) + c(10.0f));
  const B key = lattice_key(V(low)) * B(factor);
  return CellAxis<W, B>{t, t - c(1.0f), fade, key, key + B(factor)};
}
template <class W>
TYNDALL_VM_INLINE W blend(W a, W b, W t) {
  return a + t * (b - a);
}

// The scalar product with one of the 12 edges: the hash's third says which axis is left out, its lowest bits
// the signs.
template <class W, class B>
TYNDALL_VM_INLINE W edge_product(B h, W x, W y, W z) {
  const W first = select(less_signed(h, B(0xd5555555u)), y, x);
  const W second = select(less_signed(B(0x2aaaaaaau), h), y, z);
  return negate_if(first, h << 31) + negate_if(second, (h << 30) & B(0x80000000u));
}
template <class W, class B>
TYNDALL_VM_INLINE W edge_product(B h, W x, W y, W z, W t) {
  const W first = select(less_signed(h, B(0xc0000000u)), y, x);
  const W second = select(less_signed(h, B(0u)), z, y);
  const W third = select(less_signed(h, B(0x40000000u)), t, z);
  return negate_if(first, h << 31) + negate_if(second, (h << 30) & B(0x80000000u)) +
         negate_if(third, (h << 29) & B(0x80000000u));
}

// Gradient noise of the seed's key.
template <class W>
TYNDALL_VM_INLINE W gradient_noise(W px, W py, W pz, std::uint32_t key) {
  const auto x = cell_axis(px, factor_x), y = cell_axis(py, factor_y), z = cell_axis(pz, factor_z);
  using B = decltype(x.low);
  const auto corner = [&](B hash, W dx, W dy, W dz)
                          HWY_ATTR { return edge_product(mix_lattice(hash), dx, dy, dz); };
  const B low = z.low ^ B(key), high = z.high ^ B(key);
  const B ll = y.low ^ low, hl = y.high ^ low, lh = y.low ^ high, hh = y.high ^ high;
  const W a = blend(corner(x.low ^ ll, x.from_low, y.from_low, z.from_low),
                    corner(x.high ^ ll, x.from_high, y.from_low, z.from_low), x.fade);
  const W b = blend(corner(x.low ^ hl, x.from_low, y.from_high, z.from_low),
                    corner(x.high ^ hl, x.from_high, y.from_high, z.from_low), x.fade);
  const W c = blend(corner(x.low ^ lh, x.from_low, y.from_low, z.from_high),
                    corner(x.high ^ lh, x.from_high, y.from_low, z.from_high), x.fade);
  const W d = blend(corner(x.low ^ hh, x.from_low, y.from_high, z.from_high),
                    corner(x.high ^ hh, x.from_high, y.from_high, z.from_high), x.fade);
  return blend(blend(a, b, y.fade), blend(c, d, y.fade), z.fade);
}

// The eight corners at one end of the time axis.
template <class W, class X, class B>
TYNDALL_VM_INLINE W noise_at_time(const X& x, const X& y, const X& z, W from_time, B time_key) {
  const auto corner = [&](B hash, W dx, W dy, W dz) HWY_ATTR {
    return edge_product(mix_lattice(hash ^ time_key), dx, dy, dz, from_time);
  };
  const auto edge = [&](B hash, W dy, W dz) HWY_ATTR {
    return blend(corner(x.low ^ hash, x.from_low, dy, dz), corner(x.high ^ hash, x.from_high, dy, dz),
                 x.fade);
  };
  const W low = blend(edge(y.low ^ z.low, y.from_low, z.from_low),
                      edge(y.high ^ z.low, y.from_high, z.from_low), y.fade);
  const W high = blend(edge(y.low ^ z.high, y.from_low, z.from_high),
                       edge(y.high ^ z.high, y.from_high, z.from_high), y.fade);
  return blend(low, high, z.fade);
}
// The same in four dimensions; 2/3 makes the middle of a cell reach 1 as in three.
template <class W>
TYNDALL_VM_INLINE W gradient_noise(W px, W py, W pz, W pt, std::uint32_t key) {
  const auto x = cell_axis(px, factor_x), y = cell_axis(py, factor_y), z = cell_axis(pz, factor_z),
             t = cell_axis(pt, factor_t);
  using B = decltype(x.low);
  const W early = noise_at_time(x, y, z, t.from_low, t.low ^ B(key));
  const W late = noise_at_time(x, y, z, t.from_high, t.high ^ B(key));
  return blend(early, late, t.fade) * constant_like(px, decltype(value_of(px))(2.0f / 3.0f));
}

TYNDALL_VM_KERNEL3(noise3) { return gradient_noise(a, b, c, seed_key(options.seed, 0)); }
TYNDALL_VM_KERNEL4(noise4) { return gradient_noise(a, b, c, d, seed_key(options.seed, 0)); }

// Curl of three noises (Bridson et al., "Curl-Noise for Procedural Fluid Flow", SIGGRAPH 2007), with exact
// derivatives: no divergence. The factor makes it about +-1.
inline constexpr float curl_scale = 0.3f;
// d noise_i / d (the moving coordinate).
template <class V, class... T>
TYNDALL_VM_INLINE V slope_of_noise(const Options& options, std::uint32_t i, Dual<V> x, Dual<V> y, Dual<V> z,
                                   T... t) {
  return gradient_noise(x, y, z, fixed(t)..., seed_key(options.seed, 0x100u + i)).slope;
}
template <class V, class... T>
TYNDALL_VM_INLINE V curl_x(const Options& options, V x, V y, V z, T... t) {
  return V(curl_scale) * (slope_of_noise(options, 2, fixed(x), moving(y), fixed(z), t...) -
                          slope_of_noise(options, 1, fixed(x), fixed(y), moving(z), t...));
}
template <class V, class... T>
TYNDALL_VM_INLINE V curl_y(const Options& options, V x, V y, V z, T... t) {
  return V(curl_scale) * (slope_of_noise(options, 0, fixed(x), fixed(y), moving(z), t...) -
                          slope_of_noise(options, 2, moving(x), fixed(y), fixed(z), t...));
}
template <class V, class... T>
TYNDALL_VM_INLINE V curl_z(const Options& options, V x, V y, V z, T... t) {
  return V(curl_scale) * (slope_of_noise(options, 1, moving(x), fixed(y), fixed(z), t...) -
                          slope_of_noise(options, 0, fixed(x), moving(y), fixed(z), t...));
}
TYNDALL_VM_KERNEL3(curl3_x) { return curl_x(options, a, b, c); }
TYNDALL_VM_KERNEL3(curl3_y) { return curl_y(options, a, b, c); }
TYNDALL_VM_KERNEL3(curl3_z) { return curl_z(options, a, b, c); }
TYNDALL_VM_KERNEL4(curl4_x) { return curl_x(options, a, b, c, d); }
TYNDALL_VM_KERNEL4(curl4_y) { return curl_y(options, a, b, c, d); }
TYNDALL_VM_KERNEL4(curl4_z) { return curl_z(options, a, b, c, d); }

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
