// What a picture's numbers are: as the file has it, or as its reader says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "image/develop.h"
#include "image/image.h"
#include "image/plane_maker.h"
#include "support/test_folder.h"

namespace tyndall::image {
namespace UNNAMED {

// The red of the one pixel.
float red(const std::string& path, std::optional<Encoding> encoding) {
  PictureMemory memory;
  PlaneMaker maker("a", PlaneMaker::Negative::kept, memory);
  EXPECT_EQ(read_rows(path, "", encoding, maker), "");
  std::string error;
  const auto planes = maker.finish(error);
  return planes.empty() ? -1 : planes[0]->at(0, 0);
}

// Of a whole number of the 255 steps, which every format keeps.
TEST(Encodings, AreTheFilesOrOnesOwn) {
  constexpr double code = 124.0 / 255;
  const double linear = std::pow((code + 0.055) / 1.055, 2.4);
  const auto value = static_cast<float>(linear);
  const Image grey{1, 1, {"R", "G", "B"}, {value, value, value}};
  const auto folder = test_folder();
  const std::string png = (folder / "tyndall-encoding.png").string(),
                    exr = (folder / "tyndall-encoding.exr").string();
  ASSERT_EQ(write(png, grey, {}), "");
  ASSERT_EQ(write(exr, grey, {}), "");
  EXPECT_NEAR(red(png, std::nullopt), linear, 1e-6);
  EXPECT_NEAR(red(png, Encoding::srgb), linear, 1e-6);
  EXPECT_NEAR(red(png, Encoding::linear), code, 1e-6);
  EXPECT_EQ(red(exr, std::nullopt), value);
  EXPECT_EQ(red(exr, Encoding::linear), value);
  const auto again = static_cast<double>(red(exr, Encoding::srgb));
  EXPECT_NEAR(1.055 * std::pow(again, 1 / 2.4) - 0.055, linear, 1e-6);
}

// Between two steps of 8 bits, pixels take either, so often that their mean is the value: no bands. Without a
// film curve they are the nearest.
TEST(Encodings, OfEightBitsAreDitheredUnderAFilmCurve) {
  const std::string png = (test_folder() / "grey.png").string();
  for (const Tonemap tonemap : {Tonemap::film, Tonemap::none})
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const View view{.tonemap = tonemap};
      const float value = linear_from_srgb(static_cast<float>((60 + part) / 255));
      Image grey{64, 64, {"R", "G", "B"}, {}};
      grey.pixels.assign(64 * 64 * 3, value);
      const double step = 255 * double{develop(grey, view).pixels[0]};
      ASSERT_EQ(write(png, grey, {}, view), "");
      const ReadResult back = read(png);
      ASSERT_TRUE(back.image) << back.error;
      double sum = 0;
      for (std::size_t i = 0; i < back.image->pixels.size(); ++i) {
        const double code = 255 * (1.055 * std::pow(double{back.image->pixels[i]}, 1 / 2.4) - 0.055);
        EXPECT_LT(std::abs(code - step), tonemap == Tonemap::film ? 1.01 : 0.51);
        EXPECT_EQ(back.image->pixels[i], back.image->pixels[i - i % 3]);
        sum += code;
      }
      EXPECT_NEAR(sum / (64 * 64 * 3), step, tonemap == Tonemap::film ? 0.03 : 0.51) << step;
    }
}

}  // namespace UNNAMED
}  // namespace tyndall::image
