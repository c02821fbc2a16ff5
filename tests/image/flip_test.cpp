// FLIP against values of the authors' program (github.com/NVlabs/flip, version 1.6, C++), which was run on
// these same pictures; and what must hold of any pictures.
#include "image/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>

namespace tyndall::image {
namespace UNNAMED {

// Light of a component at (u, v), both from 0 to 1 over the picture.
using Light = std::function<double(double u, double v, int component)>;

Image picture(const Light& light, int width = 96, int height = 64) {
  Image image{width, height, {"R", "G", "B"}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixels.push_back(static_cast<float>(light((x + 0.5) / width, (y + 0.5) / height, c)));
  return image;
}

// Waves and a disc with coloured edges.
double waves(double u, double v, int c) {
  return 0.25 + 0.2 * std::sin(20 * u + 2 * c) * std::cos(9 * v) +
         0.3 * (std::hypot(u - 0.5, v - 0.5) < 0.2 + 0.05 * c);
}
double tinted(double u, double v, int c) { return 0.9 * waves(u, v, c) + 0.05 * (c == 0); }

// Numbers from 0 to 1 that look random.
double hashed(unsigned x, unsigned y, unsigned c) {
  unsigned v = x * 73856093u ^ y * 19349663u ^ c * 83492791u;
  v ^= v >> 13;
  v *= 0x5bd1e995u;
  v ^= v >> 15;
  return (v % 1024) / 1023.0;
}
// Pictures of 96 x 64 alone.
double noisy(double u, double v, int c) {
  const auto x = static_cast<unsigned>(u * 96), y = static_cast<unsigned>(v * 64);
  return waves(u, v, c) * (0.7 + 0.6 * hashed(x, y, static_cast<unsigned>(c)));
}
// Ten stops from left to right.
Light over_ten_stops(const Light& light) {
  return [light](double u, double v, int c) { return light(u, v, c) * std::exp2(10 * u - 6); };
}

struct Known {
  const char* what;
  Light test, reference;
  double pixels_per_degree;
  double ldr, hdr;              // means
  double ldr_pixel, hdr_pixel;  // at (5, 7)
};

TEST(Flip, IsThatOfTheAuthorsProgram) {
  constexpr double usual = flip_pixels_per_degree;
  const Known known[] = {
      {"tint", tinted, waves, usual, 0.190948, 0.176122, 0.171371, 0.160666},
      {"tint", tinted, waves, 30, 0.184219, 0.172565, 0.165134, 0.158203},
      {"noise", noisy, waves, usual, 0.109732, 0.096482, 0.150492, 0.126226},
      {"noise", noisy, waves, 30, 0.215723, 0.183866, 0.319648, 0.299754},
      {"stops", over_ten_stops(noisy), over_ten_stops(waves), usual, 0.074822, 0.100978, 0.024247, 0.083981},
      {"stops", over_ten_stops(noisy), over_ten_stops(waves), 30, 0.132733, 0.195215, 0.040715, 0.161318},
  };
  for (const Known& k : known) {
    SCOPED_TRACE(k.what);
    SCOPED_TRACE(k.pixels_per_degree);
    const Image test = picture(k.test), reference = picture(k.reference);
    // Theirs is computed in 32 bits throughout.
    constexpr double rounding = 1e-5;
    EXPECT_NEAR(flip_ldr_mean(test, reference, k.pixels_per_degree), k.ldr, rounding);
    EXPECT_NEAR(flip_hdr_mean(test, reference, k.pixels_per_degree), k.hdr, rounding);
    EXPECT_NEAR(flip_ldr(test, reference, k.pixels_per_degree).at(5, 7, 0), k.ldr_pixel, rounding);
    EXPECT_NEAR(flip_hdr(test, reference, k.pixels_per_degree).at(5, 7, 0), k.hdr_pixel, rounding);
  }
}

TEST(Flip, ExposuresAreThoseOfTheAuthorsProgram) {
  const ExposureRange range = flip_exposures(picture(over_ten_stops(waves)));
  EXPECT_NEAR(range.first, -1.0709, 1e-4);
  EXPECT_NEAR(range.last, 3.5615, 1e-4);
  EXPECT_EQ(range.count, 5);
}

TEST(Flip, IsSymmetricAndZeroOfEqualPictures) {
  const Image a = picture(waves), b = picture(noisy);
  EXPECT_EQ(flip_ldr_mean(a, a), 0);
  EXPECT_EQ(flip_hdr_mean(a, a), 0);
  EXPECT_NEAR(flip_ldr_mean(a, b), flip_ldr_mean(b, a), 1e-7);
}

TEST(Flip, StaysWithinItsRange) {
  const Image black = picture([](double, double, int) { return 0.0; });
  const Image white = picture([](double, double, int) { return 1.0; });
  const Image green = picture([](double, double, int c) { return c == 1 ? 1.0 : 0.0; });
  const Image blue = picture([](double, double, int c) { return c == 2 ? 1.0 : 0.0; });
  EXPECT_NEAR(flip_ldr_mean(green, blue), 1, 1e-6) << "the colours that are farthest apart";
  for (const Image* a : {&black, &white, &green, &blue})
    for (const Image* b : {&black, &white, &green, &blue})
      for (const float error : flip_ldr(*a, *b).pixels) {
        EXPECT_GE(error, 0);
        EXPECT_LE(error, 1);
      }
}

TEST(Flip, OfLightOfAnyRangeDoesNotDependOnItsUnit) {
  const auto in_units = [](const Light& light, double unit) {
    return picture([=](double u, double v, int c) { return unit * light(u, v, c); });
  };
  const double once = flip_hdr_mean(in_units(noisy, 1), in_units(waves, 1));
  EXPECT_NEAR(flip_hdr_mean(in_units(noisy, 1024), in_units(waves, 1024)), once, 1e-6);
  EXPECT_NEAR(flip_hdr_mean(in_units(noisy, 1.0 / 4096), in_units(waves, 1.0 / 4096)), once, 1e-6);
}

TEST(Flip, DarkPicturesHaveExposuresToo) {
  const Image black = picture([](double, double, int) { return 0.0; });
  const Image lamp = picture([](double u, double, int) { return u < 0.1 ? 3.0 : 0.0; });
  EXPECT_EQ(flip_hdr_mean(black, black), 0);
  EXPECT_EQ(flip_exposures(lamp).first, flip_exposures(lamp).last);
  const double error = flip_hdr_mean(black, lamp);
  EXPECT_GT(error, 0.05);
  EXPECT_LT(error, 0.3);
}

TEST(Flip, PicturesMayBeSmallerThanTheFilters) {
  const Image a = picture([](double, double, int) { return 0.3; }, 1, 1),
              b = picture([](double, double, int) { return 0.6; }, 1, 1);
  EXPECT_GT(flip_ldr_mean(a, b), 0);
  const Image none{0, 0, {"R", "G", "B"}, {}};
  EXPECT_EQ(flip_ldr_mean(none, none), 0);
  EXPECT_EQ(flip_hdr_mean(none, none), 0);
}

}  // namespace UNNAMED
}  // namespace tyndall::image
