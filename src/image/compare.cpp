#include "image/compare.h"

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

}  // namespace

std::uint64_t count_not_finite(const Image& image) {
  return static_cast<std::uint64_t>(std::count_if(image.pixels.begin(), image.pixels.end(),
                                                  [](float value) { return !std::isfinite(value); }));
}

Comparison compare(const Image& x, const Image& reference) {
  CHECK_EQ(x.pixels.size(), reference.pixels.size());
  Comparison result;
  result.not_finite = count_not_finite(x) + count_not_finite(reference);
  if (result.not_finite > 0) {
    result.relative_mse = result.max_difference = result.mean = result.reference_mean =
        std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  result.mean = mean_of(x);
  result.reference_mean = mean_of(reference);
  const double floor = 0.01 * sqr(result.reference_mean);
  double sum = 0;
  for (std::size_t i = 0; i < x.pixels.size(); ++i) {
    const double r = reference.pixels[i];
    const double difference = x.pixels[i] - r;
    if (difference == 0) continue;  // equal values of an all-black reference: 0/0 is meant as 0
    sum += sqr(difference) / (sqr(r) + floor);
    result.max_difference = std::max(result.max_difference, std::abs(difference));
  }
  if (!x.pixels.empty()) result.relative_mse = sum / static_cast<double>(x.pixels.size());
  return result;
}

}  // namespace tyndall::image
