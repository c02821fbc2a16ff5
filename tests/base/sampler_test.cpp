// The sampler: nets, uniformity, independence between decisions.
#include "base/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace tyndall {
namespace UNNAMED {

// The first 2^m points of the first two dimensions meet every elementary interval of area 2^-m once: a (0, m,
// 2)-net, also in later aligned blocks.
TEST(Sobol, FirstTwoDimensionsAreNets) {
  constexpr int m = 6, count = 1 << m;
  for (std::uint64_t scramble = 1; scramble <= 20; ++scramble)
    for (std::uint32_t block : {0u, 5u})
      for (int a = 0; a <= m; ++a) {
        std::set<std::pair<int, int>> cells;
        for (std::uint32_t i = 0; i < count; ++i) {
          const SobolPoint p = sobol_point(block * count + i, scramble);
          cells.insert({static_cast<int>(p[0] * static_cast<float>(1 << a)),
                        static_cast<int>(p[1] * static_cast<float>(1 << (m - a)))});
        }
        EXPECT_EQ(cells.size(), count) << "scramble " << scramble << ", block " << block << ", split " << a;
      }
}

TEST(Sobol, EveryDimensionIsStratified) {
  for (std::size_t d = 0; d < sobol_dimensions; ++d) {
    std::set<int> cells;
    for (std::uint32_t i = 0; i < 256; ++i) cells.insert(static_cast<int>(sobol_point(i, 7)[d] * 256));
    EXPECT_EQ(cells.size(), 256u) << "dimension " << d;
  }
}

TEST(Sobol, StaysBelowOne) {
  for (std::uint32_t i = 0; i < 100000; ++i)
    for (const float u : sobol_point(i * 42767u, i)) {
      EXPECT_GE(u, 0.0f);
      EXPECT_LT(u, 1.0f);
    }
}

// Two decisions of one sample are uncorrelated over pixels: 4 standard errors (1/12 √N) over 20,000 pixels.
TEST(Sampler, DecisionsAreIndependent) {
  double sum = 0;
  constexpr int pixels = 20000;
  for (std::uint32_t x = 0; x < pixels; ++x) {
    const Sampler s(1, 0, x, 3, 0);
    sum += (s.point(10)[0] - 0.5) * (s.point(11)[0] - 0.5);
  }
  EXPECT_NEAR(sum / pixels, 0, 4.0 / 12 / std::sqrt(pixels));
}

// Decisions taken several times a sample go on along one sequence: over the samples they stay stratified.
TEST(Sampler, RepeatedDecisionsShareOneSequence) {
  std::set<int> cells;
  for (std::uint32_t sample = 0; sample < 16; ++sample)
    for (std::uint32_t k = 0; k < 4; ++k)
      cells.insert(static_cast<int>(Sampler(9, 0, 5, 6, sample).point(1, k, 4)[0] * 64));
  EXPECT_EQ(cells.size(), 64u);
}

TEST(Sampler, DependsOnEveryPartOfItsName) {
  const float base = Sampler(1, 2, 3, 4, 5).independent(6, 7);
  EXPECT_EQ(base, Sampler(1, 2, 3, 4, 5).independent(6, 7));
  EXPECT_NE(base, Sampler(9, 2, 3, 4, 5).independent(6, 7));
  EXPECT_NE(base, Sampler(1, 9, 3, 4, 5).independent(6, 7));
  EXPECT_NE(base, Sampler(1, 2, 9, 4, 5).independent(6, 7));
  EXPECT_NE(base, Sampler(1, 2, 3, 9, 5).independent(6, 7));
  EXPECT_NE(base, Sampler(1, 2, 3, 4, 9).independent(6, 7));
  EXPECT_NE(base, Sampler(1, 2, 3, 4, 5).independent(9, 7));
  EXPECT_NE(base, Sampler(1, 2, 3, 4, 5).independent(6, 9));
}

}  // namespace
}  // namespace tyndall
