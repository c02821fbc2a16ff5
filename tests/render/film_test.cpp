// The film's sums: exact, so that no order of additions can change a bit.
#include "render/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace tyndall::render {
namespace {

TEST(FixedSum, DoesNotDependOnOrder) {
  std::mt19937 random(5);
  std::vector<float> values;
  for (int i = 0; i < 10000; ++i)
    values.push_back(std::ldexp(std::uniform_real_distribution<float>(-1, 1)(random), i % 60 - 40));
  FixedSum first, second;
  for (const float v : values) first.add(v);
  std::shuffle(values.begin(), values.end(), random);
  for (const float v : values) second.add(v);
  EXPECT_EQ(first.value(), second.value());
}

// A float sum of 2^24 ones and as many halves stops growing; this one does not.
TEST(FixedSum, KeepsSmallAddendsBesideLargeSums) {
  FixedSum sum;
  sum.add(1e11);
  for (int i = 0; i < 1000; ++i) sum.add(1e-9);
  sum.add(-1e11);
  EXPECT_NEAR(sum.value(), 1e-6, 1e-15);
}

// A sample too large for the sum is taken as the largest that fits, not as rubbish.
TEST(FixedSum, SaturatesAtItsRange) {
  FixedSum sum;
  sum.add(1e30);
  EXPECT_EQ(sum.value(), 0x1p38);
  sum.add(-1e30);
  EXPECT_EQ(sum.value(), 0.0);
}

TEST(Film, AveragesItsSamples) {
  Film film(2, 1);
  film.add(1, 0, {1, 2, 3});
  film.add(1, 0, {3, 2, 1});
  EXPECT_EQ(film.mean(1, 0), Rgb(2, 2, 2));
  EXPECT_EQ(film.mean(0, 0), Rgb(0, 0, 0));
  EXPECT_EQ(film.samples(1, 0), 2u);
  EXPECT_EQ(film.image().at(1, 0, 2), 2.0f);
}

}  // namespace
}  // namespace tyndall::render
