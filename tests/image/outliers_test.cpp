// Outlying pixels, and pictures in false colours.
#include "image/outliers.h"

#include <gtest/gtest.h>

#include <limits>

#include "image/false_colors.h"

namespace tyndall::image {
namespace UNNAMED {

Image grey_field(float value) {
  Image image{9, 7, {"R", "G", "B"}, {}};
  image.pixels.assign(image.index(0, 7, 0), value);
  return image;
}
void set_grey(Image& image, int x, int y, float value) {
  for (std::size_t c = 0; c < 3; ++c) image.at(x, y, c) = value;
}

TEST(Outliers, AreBrightAmongDarkOnes) {
  Image image = grey_field(0.1f);
  EXPECT_TRUE(outliers(image).empty());
  set_grey(image, 4, 3, 0.9f);
  set_grey(image, 7, 5, 0.5f);
  set_grey(image, 0, 0, 9);  // at the edge
  const std::vector<Outlier> found = outliers(image);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].x, 4);
  EXPECT_EQ(found[0].y, 3);
  EXPECT_GT(found[0].excess, found[1].excess);
  EXPECT_DOUBLE_EQ(share_of_outliers(image), 2.0 / 63);
}

TEST(Outliers, EdgesOfThingsAreNone) {
  Image image = grey_field(0.05f);
  for (int y = 0; y < image.height; ++y)
    for (int x = 4; x < image.width; ++x) set_grey(image, x, y, 0.9f);
  EXPECT_TRUE(outliers(image).empty());
}

TEST(FalseColors, BrightenWithTheNumber) {
  const Image numbers{5, 1, {"Y"}, {0, 0.25f, 0.5f, 1, std::numeric_limits<float>::quiet_NaN()}};
  const Image colors = in_false_colors(numbers);
  const auto luminance = [&](int x) {
    return 0.2126f * colors.at(x, 0, 0) + 0.7152f * colors.at(x, 0, 1) + 0.0722f * colors.at(x, 0, 2);
  };
  for (int x = 1; x < 4; ++x) EXPECT_GT(luminance(x), luminance(x - 1));
  EXPECT_EQ(colors.at(4, 0, 0), 1);
  EXPECT_EQ(colors.at(4, 0, 1), 0);
}

}  // namespace UNNAMED
}  // namespace tyndall::image
