// The film's sums: exact, so that no order of additions can change a bit.
#include "render/film/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace tyndall::render {
namespace UNNAMED {

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
  sample.hit_surface = true;
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

// Halves are of samples 0, 1, 4, 5, … and 2, 3, 6, 7, …; the second is twice the mean without the first.
TEST(Film, TellsHalvesApart) {
  AovSet aovs;
  aovs.add(Aov::depth);
  aovs.add(Aov::albedo);
  aovs.add(Aov::halves);
  Film film(1, 1, error_groups, aovs);
  for (int group = 0; group < error_groups; ++group) {
    const float value = static_cast<float>(1 << group);
    film.add(0, 0, {value, 0, 0}, group);
    AovSample sample;
    sample.hit_surface = group != 1;
    sample.depth = group != 1 ? double(value) : 0;
    sample.albedo = {0, value, 0};
    film.add(0, 0, sample, group);
  }
  const image::Image image = film.image();
  const auto value = [&](std::string_view name) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    return image.pixels.at(static_cast<std::size_t>(found - image.channels.begin()));
  };
  EXPECT_EQ(value("R"), (1 + 2 + 4 + 8) / 4.0f);
  EXPECT_EQ(value("half.R"), (1 + 2) / 2.0f);
  EXPECT_EQ(value("albedo.G"), (1 + 2 + 4 + 8) / 4.0f);
  EXPECT_EQ(value("half.albedo.G"), (1 + 2) / 2.0f);
  EXPECT_EQ(value("depth"), (1 + 4 + 8) / 3.0f);
  EXPECT_EQ(value("half.depth"), 1.0f);
  EXPECT_EQ(image.channels.size(), 3u + 1 + 3 + 3 + 1 + 3);
}

// With a half that has no samples both are the other one: they tell no noise.
TEST(Film, AHalfWithoutSamplesIsTheOther) {
  AovSet aovs;
  aovs.add(Aov::albedo);
  aovs.add(Aov::halves);
  Film film(1, 1, error_groups, aovs);
  film.add(0, 0, {0, 0, 3}, 2);
  AovSample sample;
  sample.albedo = {1, 1, 1};
  film.add(0, 0, sample, 2);
  EXPECT_EQ(film.image().pixels, (std::vector<float>{0, 0, 3, 1, 1, 1, 0, 0, 3, 1, 1, 1}));
}

}  // namespace UNNAMED
}  // namespace tyndall::render
