#include "image/bloom.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tyndall::image {

namespace {

// One channel of a picture.
struct Layer {
  int width = 0, height = 0;
  std::vector<float> values;
};

// The mean of 2 radius + 1 neighbours of each of `count` values that stand `stride` apart, which go on as in
// a mirror at both ends: then the mean of all of them stays what it was.
void average(float* values, int count, std::ptrdiff_t stride, int radius, std::vector<double>& sums) {
  const auto mirrored = [&](int i) {
    const int period = 2 * count;
    i = ((i % period) + period) % period;
    return i < count ? i : period - 1 - i;
  };
  // sums[k]: of those from -radius to before k - radius.
  const int reach = count + 2 * radius;
  sums.resize(static_cast<std::size_t>(reach) + 1);
  sums[0] = 0;
  for (int k = 0; k < reach; ++k)
    sums[static_cast<std::size_t>(k) + 1] =
        sums[static_cast<std::size_t>(k)] + double{values[mirrored(k - radius) * stride]};
  const double share = 1.0 / (2 * radius + 1);
  for (int i = 0; i < count; ++i)
    values[i * stride] = static_cast<float>(
        (sums[static_cast<std::size_t>(i + 2 * radius + 1)] - sums[static_cast<std::size_t>(i)]) * share);
}

// Three boxes are nearly a bell: W. M. Wells, "Efficient Synthesis of Gaussian Filters by Cascaded Uniform
// Filters", PAMI 1986.
void blur(Layer& layer, double sigma) {
  constexpr int boxes = 3;
  const int radius =
      std::max(static_cast<int>(std::lround((std::sqrt(12 * sigma * sigma / boxes + 1) - 1) / 2)), 1);
  std::vector<double> sums;
  for (int i = 0; i < boxes; ++i) {
    for (int y = 0; y < layer.height; ++y)
      average(layer.values.data() + std::ptrdiff_t{y} * layer.width, layer.width, 1, radius, sums);
    for (int x = 0; x < layer.width; ++x)
      average(layer.values.data() + x, layer.height, layer.width, radius, sums);
  }
}

}  // namespace

void add_bloom(Image& image, const ColorChannels& channels, double share) {
  constexpr int surroundings = 5;
  constexpr double ratio = 4, widest = 1.0 / 8;
  const auto part = static_cast<float>(share / surroundings), kept = static_cast<float>(1 - share);
  const double diagonal = std::hypot(image.width, image.height);
  const std::size_t stride = image.channels.size();
  for (std::size_t k = 0; k < (channels.is_grey() ? 1u : 3u); ++k) {
    const std::size_t channel = channels.rgb[k];
    Layer sharp{image.width, image.height, {}};
    for (std::size_t i = channel; i < image.pixels.size(); i += stride)
      sharp.values.push_back(std::isfinite(image.pixels[i]) ? image.pixels[i] : 0);
    std::vector<float> glow(sharp.values.size());
    for (int i = 0; i < surroundings; ++i) {
      Layer layer = sharp;
      blur(layer, diagonal * widest / std::pow(ratio, i));
      for (std::size_t p = 0; p < glow.size(); ++p) glow[p] += part * layer.values[p];
    }
    for (std::size_t p = 0; p < glow.size(); ++p) {
      float& value = image.pixels[p * stride + channel];
      if (std::isfinite(value)) value = kept * value + glow[p];
    }
  }
}

}  // namespace tyndall::image
