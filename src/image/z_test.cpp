#include "image/z_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/numerics.h"
#include "base/student_t.h"
#include "image/colors.h"

namespace tyndall::image {
namespace {

// Sums over some pixels of one channel.
struct Sums {
  double value = 0, reference = 0;
  double variance = 0;          // of the sums' difference
  double squared_variance = 0;  // of each picture's pixels, for the degrees of freedom
  std::uint64_t count = 0;

  Sums& operator+=(const Sums& other) {
    value += other.value;
    reference += other.reference;
    variance += other.variance;
    squared_variance += other.squared_variance;
    count += other.count;
    return *this;
  }
};

// The renderer's estimates are from four groups of samples (render/film/film.h).
constexpr double freedom_of_pixel = 3;

// Of a sum of estimates that have freedom_of_pixel each (Welch 1947): equal to it for one.
double freedom_of(const Sums& sums) {
  if (!(sums.squared_variance > 0)) return infinity;
  return std::max(sqr(sums.variance) * (freedom_of_pixel + 2) / sums.squared_variance - 2, 1.0);
}

double significance(const Sums& sums) {
  const double difference = sums.value - sums.reference;
  if (difference == 0) return 1;
  if (!(sums.variance > 0)) return 0;
  return student_t_two_sided(difference / std::sqrt(sums.variance), freedom_of(sums));
}

// Where a channel and its variance are; nothing for a variance that is not there.
struct Channel {
  std::size_t value = 0;
  std::optional<std::size_t> variance;
};
std::optional<Channel> channel_of(const Image& image, const std::string& name) {
  const auto index = [&](const std::string& wanted) -> std::optional<std::size_t> {
    const std::size_t found = find_channel(image.channels, wanted);
    return found < image.channels.size() ? std::optional(found) : std::nullopt;
  };
  const auto value = index(name);
  if (!value) return std::nullopt;
  return Channel{*value, index("variance." + name)};
}

// What rounding to 32 bits, on whatever way, may change.
constexpr double rounding = 1e-6;

class Pixels {
 public:
  Pixels(const Image& x, const Channel& x_channel, const Image& reference, const Channel& reference_channel)
      : width_(x.width), height_(x.height) {
    pixels_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int row = 0; row < height_; ++row)
      for (int column = 0; column < width_; ++column) {
        Sums sums{x.at(column, row, x_channel.value), reference.at(column, row, reference_channel.value), 0,
                  0, 1};
        add_variance(sums, x, x_channel, column, row);
        add_variance(sums, reference, reference_channel, column, row);
        sums.variance += sqr(rounding * std::max(std::abs(sums.value), std::abs(sums.reference)));
        pixels_.push_back(sums);
      }
  }

  const Sums& at(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  // Without those pixels that differ most, one of so many.
  Sums over_most(int x0, int y0, int x1, int y1) const {
    constexpr std::size_t one_of = 64;
    std::vector<Sums> all;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) all.push_back(at(x, y));
    const auto left_out = static_cast<std::ptrdiff_t>((all.size() + one_of - 1) / one_of);
    std::nth_element(all.begin(), all.begin() + left_out, all.end(), [](const Sums& a, const Sums& b) {
      return std::abs(a.value - a.reference) > std::abs(b.value - b.reference);
    });
    Sums sums;
    std::for_each(all.begin() + left_out, all.end(), [&](const Sums& of_pixel) { sums += of_pixel; });
    return sums;
  }
  Sums over(int x0, int y0, int x1, int y1) const {
    Sums sums;
    for (int y = std::max(y0, 0); y < std::min(y1, height_); ++y)
      for (int x = std::max(x0, 0); x < std::min(x1, width_); ++x) sums += at(x, y);
    return sums;
  }
  // Its variance is that of the pixels around it where that is larger: one that happened to have nothing
  // bright in it knows nothing of its own.
  Sums with_neighbours(int x, int y) const {
    Sums sums = at(x, y);
    const Sums around = over(x - 1, y - 1, x + 2, y + 2);
    const double pooled = around.variance / static_cast<double>(around.count);
    if (pooled <= sums.variance) return sums;
    const double scale = pooled / around.variance;
    sums.variance = pooled;
    sums.squared_variance = around.squared_variance * sqr(scale);
    return sums;
  }

 private:
  static void add_variance(Sums& sums, const Image& image, const Channel& channel, int x, int y) {
    if (!channel.variance) return;
    const double variance = image.at(x, y, *channel.variance);
    sums.variance += variance;
    sums.squared_variance += sqr(variance);
  }

  int width_, height_;
  std::vector<Sums> pixels_;
};

// Finds the least likely of all that is tested of means.
class Means {
 public:
  // One mean; gives its significance.
  double test(const Pixels& pixels, const std::string& channel, ZTest::Mean place) {
    const int x1 = place.x + place.width, y1 = place.y + place.height;
    const Sums sums = pixels.over(place.x, place.y, x1, y1);
    const double p = std::max(significance(sums), significance(pixels.over_most(place.x, place.y, x1, y1)));
    least_ = std::min(least_, p);
    if (tested_++ > 0 && p >= least_mean_) return p;
    least_mean_ = p;
    const auto count = static_cast<double>(sums.count);
    place.channel = channel;
    place.value = sums.value / count;
    place.reference = sums.reference / count;
    place.standard_error = std::sqrt(sums.variance) / count;
    least_likely_ = place;
    return p;
  }
  // Many means of which each may be likely, by the sum of the logarithms of their significances (Fisher).
  void test_together(double sum_of_logarithms, int count) {
    ++tested_;
    least_ = std::min(least_, fisher_together(sum_of_logarithms, count));
  }
  void tell(ZTest& result) const {
    result.p_of_means = sidak_together(least_, tested_);
    result.least_likely = least_likely_;
  }

 private:
  double tested_ = 0, least_ = 1, least_mean_ = 1;
  ZTest::Mean least_likely_{};
};

void test_channel(const Pixels& pixels, int width, int height, const std::string& channel, double least,
                  ZTest& result, Means& means) {
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      ++result.pixels;
      if (significance(pixels.with_neighbours(x, y)) >= least) ++result.accepted;
    }
  means.test(pixels, channel, {0, 0, width, height, {}});
  for (int side = 8; side < std::max(width, height); side *= 2) {
    double sum_of_logarithms = 0;
    int count = 0;
    for (int y = 0; y < height; y += side)
      for (int x = 0; x < width; x += side, ++count)
        sum_of_logarithms += std::log(
            means.test(pixels, channel, {x, y, std::min(side, width - x), std::min(side, height - y), {}}));
    means.test_together(sum_of_logarithms, count);
  }
}

}  // namespace

std::optional<ZTest> z_test(const Image& x, const Image& reference) {
  CHECK_EQ(x.width, reference.width);
  CHECK_EQ(x.height, reference.height);
  ZTest result;
  Means means;
  const double least = sidak_each(ZTest::significance_of_pixels, 3.0 * x.width * std::max(x.height, 1));
  for (const char* name : {"R", "G", "B"}) {
    const auto of_x = channel_of(x, name), of_reference = channel_of(reference, name);
    if (!of_x || !of_reference || (!of_x->variance && !of_reference->variance)) return std::nullopt;
    test_channel(Pixels(x, *of_x, reference, *of_reference), x.width, x.height, name, least, result, means);
  }
  means.tell(result);
  return result;
}

std::string describe_place(const ZTest::Mean& mean, const Image& image) {
  if (mean.width >= image.width && mean.height >= image.height) return "in the whole picture";
  return fmt::format("at x {}..{}, y {}..{}", mean.x, mean.x + mean.width - 1, mean.y,
                     mean.y + mean.height - 1);
}

}  // namespace tyndall::image
