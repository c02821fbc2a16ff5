// Random numbers as a pure function of (seed, frame, pixel, sample, decision, dimension): no state, so
// neither threads nor order can change an image.
//
// Each decision of a path (the jitter of a march, the choice of a light, …) gets its own Owen-scrambled
// Sobol' points over the samples of its pixel, padded: independent between decisions, stratified within one.
// After Burley, "Practical Hash-based Owen Scrambling" (JCGT 2020), with direction numbers of Joe and Kuo.
#pragma once

#include <array>
#include <cstdint>

namespace tyndall {

// A well-mixed 64-bit hash of one or two words (the finalizer of SplitMix64).
constexpr std::uint64_t hash_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}
constexpr std::uint64_t hash_bits(std::uint64_t a, std::uint64_t b) { return hash_bits(hash_bits(a) ^ b); }

// 24 bits to a float in [0, 1).
constexpr float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

// 53 bits to a double in (0, 1), whose logarithm is finite.
constexpr double open_unit_double(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

// Dimensions of one decision's points.
inline constexpr int sobol_dimensions = 8;
using SobolPoint = std::array<float, sobol_dimensions>;

// Point `index` of the sequence named by `scramble`: a (0,m,2)-net in its first two dimensions, each in [0,
// 1).
SobolPoint sobol_point(std::uint32_t index, std::uint64_t scramble);

// The numbers of one sample of one pixel.
class Sampler {
 public:
  Sampler(std::uint64_t seed, std::uint32_t frame, std::uint32_t x, std::uint32_t y, std::uint32_t sample)
      : pixel_(hash_bits(hash_bits(seed, frame), (std::uint64_t{x} << 32) | y)), sample_(sample) {}

  std::uint32_t sample() const { return sample_; }

  // The point of this sample for a decision. Decisions of the first bounces are stratified over samples.
  SobolPoint point(std::uint64_t decision) const { return sobol_point(sample_, hash_bits(pixel_, decision)); }
  // Point k of `count` for a decision taken `count` times a sample: consecutive points of one sequence.
  SobolPoint point(std::uint64_t decision, std::uint32_t k, std::uint32_t count) const {
    return sobol_point(sample_ * count + k, hash_bits(pixel_, decision));
  }
  // Independent numbers, for decisions without a bound on their count: (decision, counter) names them.
  std::uint32_t bits(std::uint64_t decision, std::uint64_t counter) const {
    return static_cast<std::uint32_t>(
        hash_bits(hash_bits(pixel_, decision) ^ sample_ * 0x9e3779b97f4a7c15ull, counter) >> 32);
  }
  float independent(std::uint64_t decision, std::uint64_t counter) const {
    return unit_float(bits(decision, counter));
  }

 private:
  std::uint64_t pixel_;
  std::uint32_t sample_;
};

}  // namespace tyndall
