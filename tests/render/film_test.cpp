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

// A part of a picture holds its own pixels alone, under the names that they have in the whole.
TEST(Film, IsAWindowOfThePicture) {
  AovSet aovs;
  aovs.add(Aov::depth);
  aovs.add(Aov::samples);
  Film film(16384, 16384, 1, aovs, PixelWindow{16380, 8000, 16384, 8003});
  film.add(16383, 8001, {1, 2, 3});
  AovSample sample;
  sample.met_surface = true;
  sample.depth = 5;
  film.add(16383, 8001, sample);
  EXPECT_EQ(film.mean(16383, 8001), Rgb(1, 2, 3));
  EXPECT_EQ(film.pixels_without_samples(), 11u);
  const image::Image image = film.image();
  EXPECT_EQ(image.width, 4);
  EXPECT_EQ(image.height, 3);
  EXPECT_EQ(image.at(3, 1, 2), 3.0f);
  EXPECT_EQ(image.at(3, 1, 3), 5.0f);
  EXPECT_EQ(image.at(3, 1, 4), 1.0f);
  EXPECT_EQ(image.place.x, 16380);
  EXPECT_EQ(image.place.y, 8000);
  EXPECT_EQ(image.place.whole_width, 16384);
}

}  // namespace
}  // namespace tyndall::render
