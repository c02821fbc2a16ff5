// Comparisons: values worked out by hand.
#include "image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tyndall::image {
namespace UNNAMED {

Image grey(std::vector<float> values) {
  return {static_cast<int>(values.size()), 1, {"Y"}, std::move(values)};
}

TEST(Compare, RelativeMseOfKnownPictures) {
  // mean(r) = 2, e = 0.04: ((0.5²)/(1.04) + (1²)/(9.04)) / 2.
  const Comparison c = compare(grey({1.5f, 2}), grey({1, 3}));
  EXPECT_NEAR(c.relative_mse, (0.25 / 1.04 + 1 / 9.04) / 2, 1e-15);
  EXPECT_EQ(c.max_difference, 1);
  EXPECT_EQ(c.mean, 1.75);
  EXPECT_EQ(c.reference_mean, 2);
}

TEST(Compare, EqualPicturesDifferByZero) {
  EXPECT_EQ(compare(grey({0, 0}), grey({0, 0})).relative_mse, 0);
  EXPECT_EQ(compare(grey({3, -1}), grey({3, -1})).relative_mse, 0);
}

TEST(Compare, TheScaleOfThePicturesDoesNotMatter) {
  EXPECT_NEAR(compare(grey({1e-4f, 2e-4f}), grey({2e-4f, 2e-4f})).relative_mse,
              compare(grey({1, 2}), grey({2, 2})).relative_mse, 1e-7);
}

TEST(Compare, ABlackPictureOfADimSceneIsFarAway) {
  EXPECT_GT(compare(grey({0, 0}), grey({1e-6f, 2e-6f})).relative_mse, 0.9);
}

TEST(Compare, NotFiniteIsNeverClose) {
  const Comparison c = compare(grey({std::numeric_limits<float>::quiet_NaN(), 1}), grey({1, 1}));
  EXPECT_EQ(c.not_finite, 1u);
  EXPECT_FALSE(c.relative_mse <= 1e9);
}

}  // namespace
}  // namespace tyndall::image
