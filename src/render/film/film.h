// The film: exact sums of samples per pixel. Fixed-point addition is associative, so neither thread count nor
// order can change a bit (transport §8).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "image/image.h"
#include "render/film/aov.h"

namespace tyndall::render {

// A sum of numbers, exact to 2^-64: a 128-bit integer of 2^-64ths. An addend beyond ±2^38 counts as that
// much, so that 2^24 samples cannot overflow the sum.
class FixedSum {
 public:
  void add(double value) {
    sum_ += static_cast<__int128>(std::clamp(value, -largest_addend, largest_addend) * 0x1p64);
  }
  void add(const FixedSum& other) { sum_ += other.sum_; }
  double value() const { return static_cast<double>(sum_) * 0x1p-64; }
  // As two numbers, the upper and the lower half, and back.
  std::pair<std::uint64_t, std::uint64_t> halves() const {
    const auto bits = static_cast<unsigned __int128>(sum_);
    return {static_cast<std::uint64_t>(bits >> 64), static_cast<std::uint64_t>(bits)};
  }
  static FixedSum of_halves(std::uint64_t upper, std::uint64_t lower) {
    FixedSum sum;
    sum.sum_ = static_cast<__int128>(static_cast<unsigned __int128>(upper) << 64 | lower);
    return sum;
  }

  static constexpr double largest_addend = 0x1p38;
  static constexpr double fine_addend = 0x1p-40;  // kept to 2^-24 of itself

 private:
  __int128 sum_ = 0;
};

// Samples are summed in one group, or in four of independent random numbers, from which errors are estimated:
// sample s in group s mod 4. Groups 0 and 1 are the first half of a pixel's samples, 2 and 3 the second.
inline constexpr int error_groups = 4;

// A rectangle of pixels, half-open.
struct PixelWindow {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool operator==(const PixelWindow&) const = default;
  std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(x1 - x0) * static_cast<std::uint64_t>(y1 - y0);
  }
};

// Pixels are named as those of the whole picture, whatever part of it the film is.
class Film {
 public:
  // Whether there is such a film: `groups` is 1 or error_groups, which halves need, and the window lies
  // within the picture and has pixels.
  static bool can_be(int width, int height, int groups, const AovSet& aovs, const PixelWindow& window);
  // Only the outputs in `aovs` take memory, and only the pixels in `window` (without one: all). Such a film
  // can be.
  Film(int width, int height, int groups = 1, AovSet aovs = {}, std::optional<PixelWindow> window = {});

  // Of the whole picture.
  int width() const { return width_; }
  int height() const { return height_; }
  const PixelWindow& window() const { return window_; }
  int groups() const { return groups_; }
  const AovSet& aovs() const { return aovs_; }
  // Adds one sample's radiance (finite: bad samples are counted by the caller and add as black).
  void add(int x, int y, const Rgb& radiance, int group = 0);
  // Adds what the same sample recorded for the outputs beside the picture.
  void add(int x, int y, const AovSample& sample, int group = 0);

  // Adds what another film of the same picture, groups and outputs has; its window lies within this one.
  void add(const Film& part);
  // Whether it can be added.
  bool takes(const Film& part) const;
  // The sums of all pixels, and of the other outputs, as they lie in memory (part_file.h tells how).
  std::pair<std::span<const std::byte>, std::span<const std::byte>> bytes() const {
    return {std::as_bytes(std::span(sums_)), std::as_bytes(std::span(planes_))};
  }
  std::pair<std::span<std::byte>, std::span<std::byte>> bytes() {
    return {std::as_writable_bytes(std::span(sums_)), std::as_writable_bytes(std::span(planes_))};
  }
  // How many these are.
  static std::uint64_t bytes_of(const PixelWindow& window, int groups, const AovSet& aovs);

  std::uint32_t samples(int x, int y) const;
  // Mean radiance; black where nothing was sampled. Of groups: the mean of the two halves' means, which does
  // not depend on how many samples each got (adaptive_sampling.h).
  Rgb mean(int x, int y) const;
  // Mean of the groups of one half; of the other where it has none.
  Rgb half_mean(int x, int y, int half) const;
  // Mean of one group; black where nothing was sampled.
  Vec3d group_mean(int x, int y, int group) const;
  // Estimated variance of mean(): from the spread of the groups, unbiased when they are of one size; 0 with
  // one group.
  Vec3d variance(int x, int y) const;
  std::uint64_t pixels_without_samples() const;
  // The window's pixels, with its place in the whole. Channels R G B, then those of the outputs: "depth",
  // "normal.X", "albedo.R", …; with halves "half.R", …, and those of the first half: "half.depth", …
  image::Image image() const;

 private:
  struct Sums {
    FixedSum r, g, b;
    std::uint32_t samples = 0, unused[3] = {};
  };
  static_assert(sizeof(Sums) == 64);
  std::size_t window_width() const { return static_cast<std::size_t>(window_.x1 - window_.x0); }
  std::size_t pixel_count() const {
    return window_width() * static_cast<std::size_t>(window_.y1 - window_.y0);
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - window_.y0) * window_width() +
           static_cast<std::size_t>(x - window_.x0);
  }
  const Sums& sums(int x, int y, int group) const { return sums_[index(x, y) * groups_ + group]; }
  // Sets of planes: one of all samples, or one of each half.
  int plane_sets() const { return aovs_.has(Aov::halves) ? 2 : 1; }
  std::size_t set_size() const { return planes_.size() / static_cast<std::size_t>(plane_sets()); }
  std::uint32_t half_samples(int x, int y, int half) const {
    return sums(x, y, 2 * half).samples + sums(x, y, 2 * half + 1).samples;
  }
  Vec3d half_sum_mean(int x, int y, int half) const;
  Vec3d recorded_value(const AovInfo& info, std::size_t plane, int x, int y) const;
  Vec3d half_value(const AovInfo& info, std::size_t plane, int x, int y, int half) const;
  Vec3d aov_value(const AovInfo& info, std::size_t plane, int x, int y) const;
  void put_pixel(int x, int y, std::vector<float>& to) const;

  int width_, height_, groups_;
  AovSet aovs_;
  PixelWindow window_;
  std::vector<Sums> sums_;
  // In each set a plane after another: each channel of each recorded output; after those, with depth, how
  // many samples hit a surface.
  std::vector<FixedSum> planes_;
};

}  // namespace tyndall::render
