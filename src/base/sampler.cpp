// Every dimension of a point is a lane. Integers alone: all SIMD classes give the same numbers.
#include "base/sampler.h"

#include "base/sobol_tables.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/sampler.cpp"
#include "hwy/foreach_target.h"
//
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<std::uint32_t, 8>;
using Words = hn::Vec<Tag>;

// Exchanges neighbours of `shift` bits; `low` has the lower one of each pair.
template <int shift>
HWY_INLINE HWY_ATTR Words exchanged(Words x, std::uint32_t low) {
  const Words mask = hn::Set(Tag(), low);
  return hn::Or(hn::ShiftLeft<shift>(hn::And(x, mask)), hn::And(hn::ShiftRight<shift>(x), mask));
}
HWY_INLINE HWY_ATTR Words reversed_bits(Words x) {
  x = hn::Or(hn::ShiftLeft<16>(x), hn::ShiftRight<16>(x));
  x = exchanged<8>(x, 0x00ff00ffu);
  x = exchanged<4>(x, 0x0f0f0f0fu);
  x = exchanged<2>(x, 0x33333333u);
  return exchanged<1>(x, 0x55555555u);
}

// A nested uniform (Owen) scrambling of bits in reverse, least significant first; the hash is Vegdahl's
// revision of the Laine-Karras permutation.
HWY_INLINE HWY_ATTR Words owen_scramble_reversed(Words x, Words seed) {
  const auto multiplied = [](Words v, std::uint32_t by) HWY_ATTR { return hn::Mul(v, hn::Set(Tag(), by)); };
  x = hn::Xor(x, multiplied(x, 0x3d20adeau));
  x = hn::Add(x, seed);
  x = hn::Mul(x, hn::Or(hn::ShiftRight<16>(seed), hn::Set(Tag(), 1u)));
  x = hn::Xor(x, multiplied(x, 0x05526c56u));
  return hn::Xor(x, multiplied(x, 0x53a22864u));
}

// Mixes the bits of each word (Wellons' "triple32" without its last round:
// github.com/skeeto/hash-prospector).
HWY_INLINE HWY_ATTR Words mixed(Words x) {
  x = hn::Xor(x, hn::ShiftRight<17>(x));
  x = hn::Mul(x, hn::Set(Tag(), 0xed5ad4bbu));
  x = hn::Xor(x, hn::ShiftRight<11>(x));
  x = hn::Mul(x, hn::Set(Tag(), 0xac4c1b51u));
  return hn::Xor(x, hn::ShiftRight<15>(x));
}

void sobol_words(std::uint32_t shuffled, std::uint64_t seeds, float* point) {
  const Tag d;
  const Words low = hn::Set(d, static_cast<std::uint32_t>(seeds)),
              high = hn::Set(d, static_cast<std::uint32_t>(seeds >> 32));
  for (std::size_t i = 0; i < sobol_dimensions; i += hn::Lanes(d)) {
    Words bits = hn::Load(d, sobol::tables[0][shuffled & 255u].data() + i);
    for (std::uint32_t k = 1; k < 4; ++k)
      bits = hn::Xor(bits, hn::Load(d, sobol::tables[k][(shuffled >> (8 * k)) & 255u].data() + i));
    // Both halves of the seeds, and the dimension.
    const Words dimension = hn::Mul(hn::Iota(d, static_cast<std::uint32_t>(i + 1)), hn::Set(d, 0x9e3779b9u));
    const Words seed = mixed(hn::Add(mixed(hn::Add(low, dimension)), high));
    const Words word = reversed_bits(owen_scramble_reversed(bits, seed));
    const hn::Rebind<float, Tag> floats;
    const auto places =
        hn::ConvertTo(floats, hn::BitCast(hn::Rebind<std::int32_t, Tag>(), hn::ShiftRight<8>(word)));
    hn::StoreU(hn::Mul(places, hn::Set(floats, 0x1p-24f)), floats, point + i);
  }
}

}  // namespace tyndall::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyndall {

namespace {

HWY_EXPORT(sobol_words);

std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

}  // namespace

SobolPoint sobol_point(std::uint32_t index, std::uint64_t scramble) {
  // Shuffling the index pads decisions against each other; an Owen scrambling of the index keeps every
  // aligned power-of-two block of samples a net.
  const std::uint64_t seeds = hash_bits(scramble);
  const std::uint32_t shuffled =
      owen_scramble_reversed(sobol::reverse_bits(index), static_cast<std::uint32_t>(seeds >> 32));
  SobolPoint point;
  HWY_DYNAMIC_DISPATCH(sobol_words)(shuffled, seeds, point.data());
  return point;
}

}  // namespace tyndall
#endif
