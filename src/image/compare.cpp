#include "image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::image {
namespace {

double mean_of(const Image& image) {
  if (image.pixels.empty()) return 0;
  return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) /
         static_cast<double>(image.pixels.size());
}

double floor_of(double reference_mean) { return 0.01 * sqr(reference_mean); }

double squared_relative_error(double x, double r, double floor) {
  return x == r ? 0
                : sqr(x - r) / (sqr(r) + floor);  // equal values of an all-black reference: 0/0 is meant as 0
}

}  // namespace

double Comparison::psnr(double peak) const {
  return mse == 0 ? infinity : 10 * std::log10(sqr(peak) / mse);
}

std::uint64_t count_not_finite(const Image& image) {
  return static_cast<std::uint64_t>(std::count_if(image.pixels.begin(), image.pixels.end(),
                                                  [](float value) { return !std::isfinite(value); }));
}

std::string first_not_finite(const Image& image) {
  const auto found = std::find_if(image.pixels.begin(), image.pixels.end(),
                                  [](float value) { return !std::isfinite(value); });
  if (found == image.pixels.end()) return {};
  const auto index = static_cast<std::size_t>(found - image.pixels.begin());
  const std::size_t pixel = index / image.channels.size(), width = static_cast<std::size_t>(image.width);
  return fmt::format("{} at pixel {},{} in {}", std::isnan(*found) ? "NaN" : "infinity", pixel % width,
                     pixel / width, image.channels[index % image.channels.size()]);
}

Comparison compare(const Image& x, const Image& reference) {
  CHECK_EQ(x.pixels.size(), reference.pixels.size());
  Comparison result;
  result.not_finite = count_not_finite(x) + count_not_finite(reference);
  if (result.not_finite > 0) {
    result.relative_mse = result.mse = result.max_difference = result.mean = result.reference_mean =
        result.reference_max = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  result.mean = mean_of(x);
  result.reference_mean = mean_of(reference);
  const double floor = floor_of(result.reference_mean);
  double sum = 0, sum_of_squares = 0;
  for (std::size_t i = 0; i < x.pixels.size(); ++i) {
    const double value = x.pixels[i], r = reference.pixels[i];
    sum += squared_relative_error(value, r, floor);
    sum_of_squares += sqr(value - r);
    result.max_difference = std::max(result.max_difference, std::abs(value - r));
    result.reference_max = std::max(result.reference_max, r);
  }
  if (x.pixels.empty()) return result;
  result.relative_mse = sum / static_cast<double>(x.pixels.size());
  result.mse = sum_of_squares / static_cast<double>(x.pixels.size());
  return result;
}

Image relative_errors(const Image& x, const Image& reference) {
  CHECK_EQ(x.pixels.size(), reference.pixels.size());
  const std::size_t channels = reference.channels.size();
  double sum = 0;
  for (const float value : reference.pixels)
    if (std::isfinite(value)) sum += static_cast<double>(value);
  const double floor = floor_of(sum / std::max(static_cast<double>(reference.pixels.size()), 1.0));
  Image errors{x.width, x.height, {"Y"}, {}, x.place};
  for (std::size_t i = 0; i < x.pixels.size(); i += channels) {
    double of_pixel = 0;
    for (std::size_t k = i; k < i + channels; ++k)
      of_pixel += squared_relative_error(x.pixels[k], reference.pixels[k], floor);
    errors.pixels.push_back(static_cast<float>(std::sqrt(of_pixel / static_cast<double>(channels))));
  }
  return errors;
}

void clear_common_infinities(Image& a, Image& b) {
  CHECK_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (std::isinf(a.pixels[i]) && a.pixels[i] == b.pixels[i]) a.pixels[i] = b.pixels[i] = 0;
}

}  // namespace tyndall::image
