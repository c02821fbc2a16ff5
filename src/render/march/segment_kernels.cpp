#include "render/march/segment_kernels.h"

#include "render/march/march.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/march/segment_kernels.cpp"
#include "hwy/foreach_target.h"
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::ScalableTag<double>;
static_assert(hn::MaxLanes(Doubles()) <= widest_lanes);
using Double = hn::Vec<Doubles>;
using Words = hn::Rebind<std::uint32_t, Doubles>;  // as many of them
using Word = hn::Vec<Words>;

// Up to a vector of values of an array that ends somewhere: `left` are there, at least one. Masked loads of
// some SIMD classes read beyond it, and want their addresses aligned.
template <class D>
HWY_INLINE HWY_ATTR hn::Vec<D> load_some(D d, const hn::TFromD<D>* from, std::size_t left) {
  if (left >= hn::Lanes(d)) return hn::LoadU(d, from);
  alignas(64) hn::TFromD<D> lanes[widest_lanes] = {};
  for (std::size_t i = 0; i < left; ++i) lanes[i] = from[i];
  return hn::Load(d, lanes);
}
// k, k + 1, k + 2, ….
HWY_INLINE HWY_ATTR Double counted(std::size_t k) {
  const Doubles d;
  return hn::Add(hn::Set(d, static_cast<double>(k)), hn::Iota(d, 0));
}

// Exact: the whole number as the low bits of 2^52.
HWY_INLINE HWY_ATTR Double to_double(Word v) {
  const Doubles d;
  const hn::RebindToUnsigned<Doubles> du;
  const auto magic = hn::Set(du, 0x4330000000000000u);
  return hn::Sub(hn::BitCast(d, hn::Or(hn::PromoteTo(du, v), magic)), hn::Set(d, 0x1p52));
}

// jitter() of march.h for the samples from `sample` on; an even one.
HWY_INLINE HWY_ATTR Double jitters(std::uint32_t seed, std::uint32_t sample, bool paired) {
  const Doubles d;
  const Words dw;
  const Word at = hn::Add(hn::Set(dw, sample), hn::Iota(dw, 0));
  const auto mixed = [&](Word h, auto shift, std::uint32_t factor) HWY_ATTR {
    return hn::Mul(hn::Xor(h, hn::ShiftRight<decltype(shift)::value>(h)), hn::Set(dw, factor));
  };
  const Word number = paired ? hn::ShiftRight<1>(at) : at;
  Word h = hn::Add(hn::Set(dw, seed), hn::Mul(number, hn::Set(dw, 0x9e3779b9u)));
  h = mixed(h, std::integral_constant<int, 16>(), 0x7feb352du);
  h = mixed(h, std::integral_constant<int, 15>(), 0x846ca68bu);
  h = hn::Xor(h, hn::ShiftRight<16>(h));
  const Double place = hn::Mul(hn::Add(to_double(h), hn::Set(d, 0.5)), hn::Set(d, 0x1p-32));
  if (!paired) return place;
  const auto odd = hn::Gt(to_double(hn::And(at, hn::Set(dw, 1))), hn::Zero(d));
  return hn::IfThenElse(odd, hn::Sub(hn::Set(d, 1), place), place);
}

// Where the samples from k on are.
HWY_INLINE HWY_ATTR Double places(const SegmentSamples& s, std::size_t k) {
  const Doubles d;
  const Double jitter = jitters(s.seed, s.first + static_cast<std::uint32_t>(k), s.paired);
  return hn::Add(hn::LoadU(d, s.t0 + k), hn::Mul(jitter, hn::LoadU(d, s.dt + k)));
}
HWY_INLINE HWY_ATTR Double places(const UniformSamples& s, std::size_t k) {
  const Doubles d;
  const Double jitter = jitters(s.seed, s.first + static_cast<std::uint32_t>(k), s.paired);
  return hn::Add(hn::Set(d, s.begin), hn::Mul(hn::Add(counted(k), jitter), hn::Set(d, s.dt)));
}
HWY_INLINE HWY_ATTR Double places(const PlacedSamples& s, std::size_t k) {
  return load_some(Doubles(), s.t + k, s.count - k);
}

template <class Samples>
HWY_INLINE HWY_ATTR void put_samples(const Samples& samples, const Vec3d& origin, const Vec3d& direction,
                                     float* x, float* y, float* z) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const auto put = [&](Double t, double o, double slope, float* to) HWY_ATTR {
    hn::StoreU(hn::DemoteTo(df, hn::Add(hn::Set(d, o), hn::Mul(hn::Set(d, slope), t))), df, to);
  };
  for (std::size_t k = 0; k < samples.count; k += hn::Lanes(d)) {
    const Double t = places(samples, k);
    put(t, origin.x, direction.x, x + k);
    put(t, origin.y, direction.y, y + k);
    put(t, origin.z, direction.z, z + k);
  }
}
void put_segment_samples(const SegmentSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                         float* y, float* z) {
  put_samples(samples, origin, direction, x, y, z);
}
void put_even_samples(const UniformSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                      float* y, float* z) {
  put_samples(samples, origin, direction, x, y, z);
}
void put_placed_samples(const PlacedSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                        float* y, float* z) {
  put_samples(samples, origin, direction, x, y, z);
}

void lay_even(double begin, double dt, std::size_t count, double* t0, double* dts) {
  const Doubles d;
  const Double length = hn::Set(d, dt);
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
    hn::StoreU(hn::Add(hn::Set(d, begin), hn::Mul(counted(k), length)), d, t0 + k);
    hn::StoreU(length, d, dts + k);
  }
}

// (1 - e^-x)/x for x in [0, 1/4): Taylor's series, whose first term left out, x^10/11!, is below 3e-14 of the
// sum.
HWY_INLINE HWY_ATTR Double average_of_thin(Double x) {
  const Doubles d;
  const auto c = [&](double v) HWY_ATTR { return hn::Set(d, v); };
  const auto line = [&](double a, double b) HWY_ATTR { return hn::Add(c(a), hn::Mul(c(b), x)); };
  const Double x2 = hn::Mul(x, x), x4 = hn::Mul(x2, x2);
  const Double low = hn::Add(line(1, -1.0 / 2), hn::Mul(x2, line(1.0 / 6, -1.0 / 24)));
  const Double middle = hn::Add(line(1.0 / 120, -1.0 / 720), hn::Mul(x2, line(1.0 / 5040, -1.0 / 40320)));
  const Double high = line(1.0 / 362880, -1.0 / 3628800);
  return hn::Add(low, hn::Mul(x4, hn::Add(middle, hn::Mul(x4, high))));
}

// e^-x for x >= 0: 2^k e^r with |r| <= ln 2 / 2, by Taylor's series, whose first term left out is 4e-18.
HWY_INLINE HWY_ATTR Double exp_of_minus(Double x) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> di;
  const auto c = [&](double v) HWY_ATTR { return hn::Set(d, v); };
  const Double least = hn::Min(x, c(708));
  const Double magic = c(0x1.8p52);  // rounds to whole numbers, which stand in the low bits
  const Double k_magic = hn::Sub(magic, hn::Mul(least, c(0x1.71547652b82fep0)));
  const Double k = hn::Sub(k_magic, magic);
  const Double r = hn::Sub(hn::Sub(hn::Neg(least), hn::Mul(k, c(0x1.62e42fee00000p-1))),
                           hn::Mul(k, c(0x1.a39ef35793c76p-33)));
  const auto line = [&](double a, double b) HWY_ATTR { return hn::Add(c(a), hn::Mul(c(b), r)); };
  const Double r2 = hn::Mul(r, r), r4 = hn::Mul(r2, r2);
  const Double p2 = hn::Add(line(1.0 / 2, 1.0 / 6), hn::Mul(r2, line(1.0 / 24, 1.0 / 120)));
  const Double p6 = hn::Add(line(1.0 / 720, 1.0 / 5040), hn::Mul(r2, line(1.0 / 40320, 1.0 / 362880)));
  const Double p10 =
      hn::Add(line(1.0 / 3628800, 1.0 / 39916800), hn::Mul(r2, line(1.0 / 479001600, 1.0 / 6227020800)));
  const Double tail = hn::Add(p2, hn::Mul(r4, hn::Add(p6, hn::Mul(r4, p10))));
  const Double power = hn::Add(c(1), hn::Add(r, hn::Mul(r2, tail)));
  // k's bits, shifted to the exponent.
  const auto scale = hn::ShiftLeft<52>(hn::BitCast(di, k_magic));
  const Double result = hn::BitCast(d, hn::Add(hn::BitCast(di, power), scale));
  return hn::IfThenElseZero(hn::Lt(x, c(708)), result);
}

void transmit(const float* sigma_t, const double* dts, std::size_t first, std::size_t end, double* through,
              double* reach) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const Double one = hn::Set(d, 1);
  for (std::size_t i = first; i < end; i += hn::Lanes(d)) {
    const Double sigma = hn::PromoteTo(d, hn::LoadU(df, sigma_t + i));
    const Double dt = hn::LoadU(d, dts + i), depth = hn::Mul(sigma, dt);
    Double average = average_of_thin(depth);
    Double rest = hn::Sub(one, hn::Mul(depth, average));
    const auto thick = hn::Ge(depth, hn::Set(d, 0.25));
    if (!hn::AllFalse(d, thick)) {
      rest = hn::IfThenElse(thick, exp_of_minus(depth), rest);
      average = hn::IfThenElse(thick, hn::Div(hn::Sub(one, rest), depth), average);
    }
    hn::StoreU(rest, d, through + i);
    hn::StoreU(hn::Mul(dt, average), d, reach + i);
  }
}

}  // namespace tyndall::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyndall::render {

HWY_EXPORT(put_segment_samples);
HWY_EXPORT(put_even_samples);
HWY_EXPORT(put_placed_samples);
HWY_EXPORT(lay_even);
HWY_EXPORT(transmit);

void lay_uniform_segments(double begin, double dt, std::size_t count, double* t0, double* dts) {
  HWY_DYNAMIC_DISPATCH(lay_even)(begin, dt, count, t0, dts);
}
void put_on_line(const SegmentSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                 float* y, float* z) {
  HWY_DYNAMIC_DISPATCH(put_segment_samples)(samples, origin, direction, x, y, z);
}
void put_on_line(const UniformSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                 float* y, float* z) {
  HWY_DYNAMIC_DISPATCH(put_even_samples)(samples, origin, direction, x, y, z);
}
void put_on_line(const PlacedSamples& samples, const Vec3d& origin, const Vec3d& direction, float* x,
                 float* y, float* z) {
  HWY_DYNAMIC_DISPATCH(put_placed_samples)(samples, origin, direction, x, y, z);
}
void transmit_segments(const float* sigma_t, const double* dt, std::size_t first, std::size_t end,
                       double* through, double* reach) {
  HWY_DYNAMIC_DISPATCH(transmit)(sigma_t, dt, first, end, through, reach);
}

}  // namespace tyndall::render
#endif
