// The film: exact sums of samples per pixel. Fixed-point addition is associative, so neither thread count nor
// order can change a bit (transport §8).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "image/image.h"

namespace tyndall::render {

// A sum of numbers, exact to 2^-64: a 128-bit integer of 2^-64ths. An addend beyond ±2^38 counts as that
// much, so that 2^24 samples cannot overflow the sum.
class FixedSum {
 public:
  void add(double value) {
    sum_ += static_cast<__int128>(std::clamp(value, -largest_addend, largest_addend) * 0x1p64);
  }
  double value() const { return static_cast<double>(sum_) * 0x1p-64; }

 private:
  static constexpr double largest_addend = 0x1p38;
  __int128 sum_ = 0;
};

class Film {
 public:
  Film(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  // Adds one sample's radiance (finite: bad samples are counted by the caller and add as black).
  void add(int x, int y, const Rgb& radiance);
  std::uint32_t samples(int x, int y) const { return pixels_[index(x, y)].samples; }
  // Mean radiance; black where nothing was sampled.
  Rgb mean(int x, int y) const;
  image::Image image() const;  // channels R G B

 private:
  struct Pixel {
    FixedSum r, g, b;
    std::uint32_t samples = 0;
  };
  static_assert(sizeof(Pixel) <= 64);
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace tyndall::render
