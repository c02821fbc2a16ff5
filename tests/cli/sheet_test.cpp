// `tyndall sheet`: pictures side by side.
#include <gtest/gtest.h>

#include <cmath>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

using image::Image;

class Sheet : public CliTest {
 protected:
  std::string picture(const std::string& name, int width, int height, const std::vector<float>& color,
                      double exposure = 0) const {
    Image out{width, height, {"R", "G", "B"}, {}};
    for (int i = 0; i < width * height; ++i) out.pixels.insert(out.pixels.end(), color.begin(), color.end());
    EXPECT_EQ(image::write(path(name), out, {}, {.exposure = {exposure}, .tonemap = image::Tonemap::none}),
              "");
    return path(name);
  }
  Image read(const std::string& name) const {
    const image::ReadResult result = image::read(path(name));
    EXPECT_TRUE(result.image) << result.error;
    return result.image.value_or(Image{});
  }
};

// Two columns of 40 pixels with gaps of 4: a wide picture, a high one, and one of an EXR with its exposure.
TEST_F(Sheet, HoldsEachPictureInItsCell) {
  const std::vector<std::string> pictures{picture("a.png", 20, 10, {1, 0, 0}),
                                          picture("b.png", 10, 20, {0, 1, 0}),
                                          picture("c.exr", 8, 8, {0.25f, 0.25f, 8}, 1)};
  std::vector<std::string> arguments{"sheet", "-o", path("s.exr"), "--columns", "2", "--width", "92"};
  arguments.insert(arguments.begin() + 1, pictures.begin(), pictures.end());
  const Outcome outcome = tyndall(arguments);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Image sheet = read("s.exr");
  ASSERT_EQ(sheet.width, 92);
  ASSERT_EQ(sheet.height, 4 + 2 * (80 + 4));
  const auto expect_color = [&](int x, int y, const std::vector<double>& color) {
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(sheet.at(x, y, c), color[c], 1e-4) << x << " " << y << " " << c;
  };
  expect_color(24, 44, {1, 0, 0});
  expect_color(68, 44, {0, 1, 0});
  // Exposed, then clamped and kept in 8 bits: linear light of the byte 188.
  const double half = image::linear_from_srgb(188 / 255.0f);
  expect_color(24, 128, {half, half, 1});
  for (const auto& [x, y] : {std::pair{1, 1}, {46, 44}, {24, 10}, {68, 128}})
    expect_color(x, y, {0.01, 0.01, 0.01});

  arguments[arguments.size() - 1] = "300";
  arguments.push_back("--label");
  ASSERT_EQ(tyndall(arguments).status, 0);
  const Image labelled = read("s.exr");
  // Below each picture something light is written, beyond the last there is nothing.
  const int cell = (300 - 4) / 2 - 4, label = (labelled.height - 4) / 2 - 4 - 2 * cell;
  ASSERT_GT(label, 8);
  const auto brightest = [&](int column, int row) {
    float most = 0;
    for (int y = 0; y < label; ++y)
      for (int x = 0; x < cell; ++x)
        most = std::max(most, labelled.at(4 + column * (cell + 4) + x,
                                          4 + row * (2 * cell + label + 4) + 2 * cell + y, 1));
    return most;
  };
  EXPECT_GT(brightest(0, 0), 0.3f);
  EXPECT_GT(brightest(1, 0), 0.3f);
  EXPECT_GT(brightest(0, 1), 0.3f);
  EXPECT_LT(brightest(1, 1), 0.02f);
}

TEST_F(Sheet, WhatCannotBeOneIsRefused) {
  const std::string a = picture("a.png", 4, 4, {1, 1, 1}), narrow = picture("n.png", 1, 400, {1, 1, 1}),
                    text = file("t.png", "no picture");
  const struct {
    std::vector<std::string> words;
    int status;
    const char* told;
  } rows[] = {
      {{"-o", path("s.png")}, 2, "pictures is required"},
      {{a}, 2, "--output is required"},
      {{a, path("none.png"), text, "-o", path("s.png")}, 1, "none.png': no such file"},
      {{a, path("none.png"), text, "-o", path("s.png")}, 1, "t.png"},
      {{a, "-o", a}, 1, "would overwrite the picture"},
      {{a, "-o", path("s.gif")}, 1, "unknown extension '.gif'"},
      {{a, a, a, "-o", path("s.png"), "--width", "16", "--columns", "3"}, 2, "fewer --columns"},
      {{narrow, "-o", path("s.png")}, 1, "n.png' would make a sheet of"},
      {{a, a, "-o", path("s.png"), "--width", "16384", "--columns", "1"},
       1,
       "more --columns or less --width"},
  };
  for (const auto& row : rows) {
    std::vector<std::string> words{"sheet"};
    words.insert(words.end(), row.words.begin(), row.words.end());
    const Outcome outcome = tyndall(words);
    EXPECT_EQ(outcome.status, row.status) << outcome.err;
    EXPECT_NE(outcome.err.find(row.told), std::string::npos) << row.told << "\n" << outcome.err;
  }
  EXPECT_EQ(file_count(), 3u);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
