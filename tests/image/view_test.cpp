// From radiance to what is seen: the laws of exposure, white balance, bloom and tone curves.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "image/bloom.h"
#include "image/develop.h"
#include "image/metering.h"
#include "image/tone_curve.h"
#include "image/white_balance.h"

namespace tyndall::image {
namespace UNNAMED {

constexpr float infinite = std::numeric_limits<float>::infinity();

// Numbers in [0, 1) that are the same in every run.
class Numbers {
 public:
  float next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<float>(state_ >> 40) * 0x1p-24f;
  }
  // Light over 24 stops about 1.
  float light() { return std::exp2(24 * next() - 12); }

 private:
  std::uint64_t state_ = 1;
};

Image picture_of(int width, int height, auto&& color) {
  Image image{width, height, {"R", "G", "B"}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb c = color(x, y);
      image.pixels.insert(image.pixels.end(), {c.x, c.y, c.z});
    }
  return image;
}
Image lights(int width, int height) {
  return picture_of(width, height, [numbers = Numbers()](int, int) mutable {
    return Rgb{numbers.light(), numbers.light(), numbers.light()};
  });
}

// ------------------------------------------------------------------------------------------------- tone
// curves

TEST(ToneCurve, GreyStaysGreyAndGrowsFromBlackToWhite) {
  for (const TonemapInfo& info : tonemaps) {
    EXPECT_EQ(tone_curve(info.tonemap, Rgb(0.0f)), Rgb(0.0f)) << info.name;
    float before = 0;
    for (double stops = -20; stops <= 20; stops += 1.0 / 64) {
      const Rgb shown = tone_curve(info.tonemap, Rgb(static_cast<float>(std::exp2(stops))));
      EXPECT_NEAR(shown.x, shown.y, 1e-6) << info.name << " " << stops;
      EXPECT_NEAR(shown.x, shown.z, 1e-6) << info.name << " " << stops;
      EXPECT_GE(shown.y, before) << info.name << " " << stops;
      before = shown.y;
    }
    EXPECT_NEAR(before, 1, 1e-4) << info.name;
  }
}

// More of the same light makes no channel darker.
TEST(ToneCurve, AllChannelsGrowWithTheLight) {
  Numbers numbers;
  for (const TonemapInfo& info : tonemaps)
    for (int i = 0; i < 20'000; ++i) {
      const Rgb color{numbers.light(), numbers.light(), numbers.light()};
      const Rgb less = tone_curve(info.tonemap, color), more = tone_curve(info.tonemap, color * 1.1f);
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_GE(more[k], less[k] - 1e-6f)
            << info.name << " " << color.x << " " << color.y << " " << color.z << " " << k;
    }
}

// What is redder than green stays so, however bright: hues do not turn over on the way to white. AgX's
// published matrix sees green and blue a little less alike than its rows should; it is no step of 8 bits.
TEST(ToneCurve, ChannelsKeepTheirOrder) {
  Numbers numbers;
  for (const TonemapInfo& info : tonemaps) {
    const float most = info.tonemap == Tonemap::agx ? 1e-3f : 1e-6f;
    for (int i = 0; i < 20'000; ++i) {
      const Rgb color{numbers.light(), numbers.light(), numbers.light()};
      const Rgb shown = tone_curve(info.tonemap, color);
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
          if (color[a] > color[b]) {
            ASSERT_GE(shown[a], shown[b] - most)
                << info.name << " " << color.x << " " << color.y << " " << color.z;
          }
        }
    }
  }
}

TEST(ToneCurve, NoneClamps) {
  Numbers numbers;
  for (int i = 0; i < 1000; ++i) {
    const Rgb color{numbers.light(), -numbers.light(), numbers.light()};
    const Rgb shown = tone_curve(Tonemap::none, color);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(shown[k], std::clamp(color[k], 0.0f, 1.0f));
  }
}

// Middle grey stays about where it is: a camera's exposure means the same with each curve, within half a
// stop.
TEST(ToneCurve, MiddleGreyStaysInTheMiddle) {
  for (const TonemapInfo& info : tonemaps)
    EXPECT_NEAR(std::log2(tone_curve(info.tonemap, Rgb(0.18f)).y / 0.18f), 0, 0.5) << info.name;
}

TEST(ToneCurve, NoNumberIsBlackAndInfiniteIsBright) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const TonemapInfo& info : tonemaps) {
    EXPECT_EQ(tone_curve(info.tonemap, Rgb(nan)), Rgb(0.0f)) << info.name;
    EXPECT_EQ(tone_curve(info.tonemap, Rgb(-infinite)), Rgb(0.0f)) << info.name;
    EXPECT_NEAR(tone_curve(info.tonemap, Rgb(infinite)).y, 1, 1e-6) << info.name;
    const Rgb red = tone_curve(info.tonemap, {infinite, nan, 0});
    EXPECT_TRUE(all_finite(red)) << info.name;
    EXPECT_GT(red.x, 0.9f) << info.name;
  }
}

// ----------------------------------------------------------------------------------------------------
// exposure

TEST(Metering, BringsTheMiddleOfThePictureToMiddleGrey) {
  // Within six stops, whose bright fiftieth is no more than three above the middle.
  const Image range = picture_of(
      50, 50, [numbers = Numbers()](int, int) mutable { return Rgb(std::exp2(6 * numbers.next())); });
  double sum = 0;
  for (std::size_t i = 0; i < range.pixels.size(); i += 3) sum += std::log2(range.pixels[i]);
  EXPECT_NEAR(metered_stops(range) + sum / 2500, std::log2(middle_grey), 1e-4);
}

TEST(Metering, KeepsTheBrightPartsInTheirBounds) {
  const auto bright_of = [](const Image& image, double bright) {
    return bright * std::exp2(metered_stops(image));
  };
  EXPECT_NEAR(bright_of(picture_of(8, 8, [](int, int) { return Rgb(3.7f); }), 3.7), least_bright, 1e-6);
  const Image fire = picture_of(40, 40, [](int x, int y) { return Rgb(x < 4 && y < 20 ? 30.0f : 0.1f); });
  EXPECT_NEAR(bright_of(fire, 30), most_bright, 1e-5);
}

TEST(Metering, IsOfThePictureAndNotOfItsScale) {
  const Image image = lights(40, 30);
  for (const int stops : {-90, -7, 1, 30}) {
    Image scaled = image;
    for (float& value : scaled.pixels) value = std::ldexp(value, stops);
    EXPECT_NEAR(metered_stops(scaled), metered_stops(image) - stops, 1e-4);
    const View view{.exposure = {0.5, true}, .tonemap = Tonemap::none};
    const Image a = develop(image, view), b = develop(scaled, view);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) ASSERT_NEAR(a.pixels[i], b.pixels[i], 1e-4);
  }
}

// Neither darkness around the subject, nor a few bright pixels, nor what is no light.
TEST(Metering, DoesNotCountWhatIsNotThePicture) {
  const auto subject = [](int x, int) { return Rgb(x % 2 ? 0.25f : 4.0f); };
  const double alone = metered_stops(picture_of(40, 40, subject));
  for (const float around : {0.0f, 1e-5f, -1.0f, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_NEAR(
        metered_stops(picture_of(40, 80, [&](int x, int y) { return y < 40 ? subject(x, y) : Rgb(around); })),
        alone, 1e-9)
        << around;
  for (const float spot : {1e9f, infinite})
    EXPECT_NEAR(metered_stops(
                    picture_of(40, 40, [&](int x, int y) { return x + y == 0 ? Rgb(spot) : subject(x, y); })),
                alone, 0.05)
        << spot;
  EXPECT_EQ(metered_stops(picture_of(4, 4, [](int, int) { return Rgb(0.0f); })), 0);
}

TEST(Metering, IsTheSameForAPartAndForItsPlaceInThePicture) {
  Image part = lights(12, 9);
  part.place = {3, 4, 20, 16};
  const View view{.exposure = {0, true}};
  Image whole = picture_of(20, 16, [&](int x, int y) {
    if (x < 3 || y < 4 || x >= 15 || y >= 13) return Rgb(0.0f);
    return Rgb{part.at(x - 3, y - 4, 0), part.at(x - 3, y - 4, 1), part.at(x - 3, y - 4, 2)};
  });
  EXPECT_EQ(develop(part, view).pixels, develop(whole, view).pixels);
}

// ----------------------------------------------------------------------------------------------- white
// balance

TEST(WhiteBalance, TheLightBecomesGreyAndKeepsItsLuminance) {
  for (const Rgb light : {Rgb{1, 0.6f, 0.25f}, Rgb{0.7f, 0.8f, 1.6f}, Rgb{1, 1, 1}, Rgb{1.0f, 0.3f, 0.0f}}) {
    ASSERT_TRUE(WhiteBalance::can_balance(light));
    const WhiteBalance balance(light);
    for (const float scale : {1e-4f, 1.0f, 300.0f}) {
      const Rgb grey = balance.balanced(light * scale);
      const float wanted = luminance(light) * scale;
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(grey[k], wanted, 1e-5f * wanted);
    }
  }
}

TEST(WhiteBalance, OfGreyLightNothingChanges) {
  const WhiteBalance balance(Rgb(0.3f));
  Numbers numbers;
  for (int i = 0; i < 100; ++i) {
    const Rgb color{numbers.light(), numbers.light(), numbers.light()}, same = balance.balanced(color);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(same[k], color[k], 1e-5f * max_component(color));
  }
}

TEST(WhiteBalance, WhatIsNoLightIsToldApart) {
  for (const Rgb light : {Rgb(0.0f), Rgb(-1.0f), Rgb(infinite), Rgb{0, -1, 1}})
    EXPECT_FALSE(WhiteBalance::can_balance(light));
}

// -------------------------------------------------------------------------------------------------------
// bloom

double sum_of(const Image& image) {
  double sum = 0;
  for (const float value : image.pixels) sum += value;
  return sum;
}

TEST(Bloom, KeepsAllLight) {
  for (const double share : {0.02, 0.3, 1.0})
    for (const auto& [width, height] : {std::pair{61, 37}, {1, 1}, {300, 2}}) {
      Image image = lights(width, height);
      image.pixels[0] = 1e4f;
      const double before = sum_of(image);
      add_bloom(image, color_channels(image.channels), share);
      EXPECT_NEAR(sum_of(image), before, 1e-5 * before) << share << " " << width << "x" << height;
      for (const float value : image.pixels) EXPECT_GE(value, 0);
    }
}

TEST(Bloom, WhatIsEvenStaysEven) {
  Image image = picture_of(90, 50, [](int, int) { return Rgb{0.2f, 3, 70}; });
  const Image before = image;
  add_bloom(image, color_channels(image.channels), 0.5);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_NEAR(image.pixels[i], before.pixels[i], 1e-5f * before.pixels[i]);
}

// All that leaves a pixel is the share; it falls with the distance, alike to all sides.
TEST(Bloom, APointGlowsAroundItself) {
  constexpr int size = 129, middle = 64;
  Image image =
      picture_of(size, size, [](int x, int y) { return Rgb(x == middle && y == middle ? 1.0f : 0.0f); });
  add_bloom(image, color_channels(image.channels), 0.1);
  EXPECT_GT(image.at(middle, middle, 1), 0.9f);
  for (int d = 1; d < middle; ++d) {
    EXPECT_LE(image.at(middle + d, middle, 1), image.at(middle + d - 1, middle, 1) + 1e-9f) << d;
    EXPECT_NEAR(image.at(middle + d, middle, 1), image.at(middle - d, middle, 1), 1e-8f) << d;
    EXPECT_NEAR(image.at(middle + d, middle, 1), image.at(middle, middle + d, 1), 1e-8f) << d;
  }
}

TEST(Bloom, WhatIsNotFiniteStaysAlone) {
  Image image = picture_of(20, 20, [](int x, int y) { return Rgb(x + y == 0 ? infinite : 1.0f); });
  add_bloom(image, color_channels(image.channels), 0.2);
  EXPECT_EQ(image.pixels[0], infinite);
  for (std::size_t i = 3; i < image.pixels.size(); ++i) EXPECT_LE(image.pixels[i], 1.0001f);
}

// ------------------------------------------------------------------------------------------------ the whole
// way

TEST(Develop, ExposureWhiteBalanceAndCurveAreInThisOrder) {
  const Rgb lamp{2, 1, 0.5f};
  const Image image = picture_of(3, 2, [&](int x, int) { return lamp * static_cast<float>(x); });
  const Image shown = develop(image, {.exposure = {-1}, .tonemap = Tonemap::none, .white = lamp});
  for (int x = 0; x < 3; ++x)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(linear_from_srgb(shown.at(x, 1, k)),
                  std::min(luminance(lamp) * static_cast<float>(x) / 2, 1.0f), 1e-5f);
}

TEST(Develop, ChannelsBesideColoursAreLeftAlone) {
  const Image image{1, 1, {"A", "B", "G", "R", "Z"}, {0.5f, 0.1f, 0.2f, 0.4f, 7}};
  const Image exposed = expose(image, {.exposure = {1}});
  EXPECT_EQ(exposed.pixels, (std::vector<float>{0.5f, 0.2f, 0.4f, 0.8f, 7}));
  const Image grey{1, 1, {"Y"}, {0.25f}};
  EXPECT_EQ(develop(grey, {.exposure = {1}}).pixels[0],
            develop(picture_of(1, 1, [](int, int) { return Rgb(0.25f); }), {.exposure = {1}}).pixels[1]);
}

TEST(View, TextsAreReadBack) {
  for (const Exposure exposure : {Exposure{0}, Exposure{-1.25}, Exposure{0, true}, Exposure{0.1, true}})
    EXPECT_EQ(read_exposure(describe(exposure)), exposure) << describe(exposure);
  for (const TonemapInfo& info : tonemaps) EXPECT_EQ(read_tonemap(describe(info.tonemap)), info.tonemap);
  for (const char* none : {"", "x", "auto()", "auto(", "auto(x)", "1stop", "inf", "nan", "+1"})
    EXPECT_FALSE(read_exposure(none)) << none;
}

}  // namespace UNNAMED
}  // namespace tyndall::image
