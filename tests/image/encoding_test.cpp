// What a picture's numbers are: as the file has it, or as its reader says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

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

TEST(Encodings, AreTheFilesOrOnesOwn) {
  const Image grey{1, 1, {"R", "G", "B"}, {0.2f, 0.2f, 0.2f}};
  const auto folder = test_folder();
  const std::string png = (folder / "tyndall-encoding.png").string(),
                    exr = (folder / "tyndall-encoding.exr").string();
  ASSERT_EQ(write(png, grey, {}), "");
  ASSERT_EQ(write(exr, grey, {}), "");
  const auto code = [](double linear) { return 1.055 * std::pow(linear, 1 / 2.4) - 0.055; };
  EXPECT_NEAR(red(png, std::nullopt), 0.2, 2e-3);  // of 255 steps
  EXPECT_NEAR(red(png, Encoding::srgb), 0.2, 2e-3);
  EXPECT_NEAR(red(png, Encoding::linear), code(0.2), 2e-3);
  EXPECT_EQ(red(exr, std::nullopt), 0.2f);
  EXPECT_EQ(red(exr, Encoding::linear), 0.2f);
  EXPECT_NEAR(code(static_cast<double>(red(exr, Encoding::srgb))), 0.2, 1e-6);
}

}  // namespace UNNAMED
}  // namespace tyndall::image
