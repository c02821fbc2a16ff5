// z-tests of pictures, on noise that is known: seeds 1 to 200.
#include "image/z_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/numerics.h"

namespace tyndall::image {
namespace UNNAMED {

using Truth = std::function<double(int x, int y)>;
// A number of one group of samples, of mean 0.
using Noise = std::function<double(std::mt19937& random)>;

double normal(std::mt19937& random) { return 0.2 * std::normal_distribution<double>()(random); }

// Means of four groups with their variances, as the renderer makes them.
Image noisy_picture(unsigned seed, const Truth& truth, const Noise& noise = normal, int width = 40,
                    int height = 32) {
  std::mt19937 random(seed);
  Image image{width, height, {"R", "G", "B", "variance.R", "variance.G", "variance.B"}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double values[3], variances[3];
      for (int c = 0; c < 3; ++c) {
        double sum = 0, squares = 0;
        for (int group = 0; group < 4; ++group) {
          const double value = truth(x, y) * (1 + noise(random));
          sum += value;
          squares += sqr(value);
        }
        values[c] = sum / 4;
        variances[c] = std::max(squares - sqr(sum) / 4, 0.0) / 3 / 4;
      }
      for (const double value : values) image.pixels.push_back(static_cast<float>(value));
      for (const double variance : variances) image.pixels.push_back(static_cast<float>(variance));
    }
  return image;
}

double ramp(int x, int) { return 0.1 + 0.02 * x; }

TEST(ZTestOfPictures, AcceptsTheSameLightUnderOtherSeeds) {
  const Image reference = noisy_picture(0, ramp);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const auto test = z_test(noisy_picture(seed, ramp), reference);
    ASSERT_TRUE(test);
    EXPECT_TRUE(test->agrees()) << seed << ": " << test->p_of_means << ", " << test->accepted_share();
  }
}

// A sample in a hundred carries most of the light; and a pixel of which no variance is to be had.
TEST(ZTestOfPictures, AcceptsRareBrightSamples) {
  const auto rare = [](std::mt19937& random) {
    return std::uniform_real_distribution<double>()(random) < 0.01 ? 60.0 : -0.6;
  };
  const auto heavy = [](std::mt19937& random) {
    return 0.1 * std::pow(std::uniform_real_distribution<double>(1e-9, 1)(random), -0.7);
  };
  for (const Noise& noise : {Noise(rare), Noise(heavy)}) {
    int agree = 0;
    const Image reference = noisy_picture(0, ramp, noise);
    for (unsigned seed = 1; seed <= 200; ++seed)
      agree += z_test(noisy_picture(seed, ramp, noise), reference)->agrees();
    EXPECT_GE(agree, 199);
  }
}

TEST(ZTestOfPictures, FindsWhatEveryPixelHasALittleOf) {
  const Image reference = noisy_picture(0, ramp);
  const auto test = z_test(noisy_picture(1, [](int x, int y) { return 1.03 * ramp(x, y); }), reference);
  EXPECT_TRUE(test->pixels_agree()) << "no pixel tells";
  EXPECT_FALSE(test->means_agree());
  EXPECT_GT(test->least_likely.value, test->least_likely.reference);
}

TEST(ZTestOfPictures, FindsABlockAndTellsWhere) {
  const auto brighter = [](int x, int y) { return ramp(x, y) * (x >= 16 && x < 24 && y < 8 ? 1.2 : 1); };
  const auto test = z_test(noisy_picture(1, brighter), noisy_picture(0, ramp));
  EXPECT_FALSE(test->agrees());
  EXPECT_EQ(test->least_likely.x, 16);
  EXPECT_EQ(test->least_likely.y, 0);
  EXPECT_EQ(test->least_likely.width, 8);
}

TEST(ZTestOfPictures, FindsSinglePixelsThatAreGone) {
  const auto holes = [](int x, int y) { return x % 8 == 3 && y % 8 == 3 ? 0.0 : 0.5; };
  const auto test = z_test(noisy_picture(1, holes), noisy_picture(0, [](int, int) { return 0.5; }));
  EXPECT_FALSE(test->pixels_agree());
}

TEST(ZTestOfPictures, WhatHasNoNoiseMustBeEqual) {
  const auto one = [](int, int) { return 1.0; };
  const auto none = [](std::mt19937&) { return 0.0; };
  const Image exact = noisy_picture(0, one, none);
  EXPECT_TRUE(z_test(exact, exact)->agrees());
  EXPECT_FALSE(z_test(noisy_picture(
                          0, [](int, int) { return 1.0001; }, none),
                      exact)
                   ->agrees());
}

TEST(ZTestOfPictures, WantsAVariance) {
  const Image plain{2, 1, {"R", "G", "B"}, std::vector<float>(6, 1.0f)};
  EXPECT_FALSE(z_test(plain, plain));
  Image exact = noisy_picture(0, ramp);
  exact.channels = {"R", "G", "B", "x", "y", "z"};
  EXPECT_TRUE(z_test(noisy_picture(1, ramp), exact)) << "a picture without one is taken as exact";
}

}  // namespace UNNAMED
}  // namespace tyndall::image
