// Pictures of known truth and noise, for the laws of denoising.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "image/image.h"

namespace tyndall::denoise {

// Of a pixel.
using ColorAt = std::function<std::array<double, 3>(int x, int y)>;

inline std::size_t channel_of(const image::Image& image, const std::string& name) {
  std::size_t i = 0;
  while (i < image.channels.size() && image.channels[i] != name) ++i;
  return i;
}

// A picture in the making: channels with values for each pixel, as the renderer would write them.
class NoisyPicture {
 public:
  NoisyPicture(int width, int height, unsigned seed)
      : image_{width, height, {"R", "G", "B", "half.R", "half.G", "half.B"}, {}}, random_(seed) {
    planes_.resize(6, std::vector<double>(static_cast<std::size_t>(width * height)));
  }

  // Adds light to the picture, each half of it with noise of this standard deviation times `spread`; if it
  // has a name, as a layer, too. The noise is Gaussian and the same in all channels but for a third of it.
  void add_light(const ColorAt& truth, const std::function<double(int x, int y)>& deviation,
                 const std::string& layer = {}) {
    std::size_t to = 0;
    if (!layer.empty())
      to = add_channels({layer + ".R", layer + ".G", layer + ".B", "half." + layer + ".R",
                         "half." + layer + ".G", "half." + layer + ".B"});
    std::normal_distribution<double> normal;
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x) {
        std::array<std::array<double, 3>, 2> halves{};
        for (auto& half : halves) {
          const double common = normal(random_);
          for (std::size_t c = 0; c < 3; ++c)
            half[c] = truth(x, y)[c] + deviation(x, y) * (0.943 * common + 0.333 * normal(random_));
        }
        for (std::size_t c = 0; c < 3; ++c) {
          const double mean = (halves[0][c] + halves[1][c]) / 2;
          at(c, x, y) += mean;
          at(3 + c, x, y) += halves[0][c];
          if (to == 0) continue;
          at(to + c, x, y) = mean;
          at(to + 3 + c, x, y) = halves[0][c];
        }
      }
  }
  // A feature, each half of it with noise of this standard deviation.
  void add_feature(const std::string& name, const std::string& suffixes, const ColorAt& truth,
                   double deviation = 0) {
    std::normal_distribution<double> normal;
    for (std::size_t c = 0; c < suffixes.size(); ++c) {
      const std::size_t to = add_channels({name + '.' + suffixes[c], "half." + name + '.' + suffixes[c]});
      for (int y = 0; y < image_.height; ++y)
        for (int x = 0; x < image_.width; ++x) {
          const double first = truth(x, y)[c] + deviation * normal(random_),
                       second = truth(x, y)[c] + deviation * normal(random_);
          at(to, x, y) = (first + second) / 2;
          at(to + 1, x, y) = first;
        }
    }
  }
  // Adds to one sample of one half: what is rare and bright.
  void add_firefly(int x, int y, double light) {
    for (std::size_t c = 0; c < 3; ++c) {
      at(c, x, y) += light / 2;
      at(3 + c, x, y) += light;
    }
  }

  image::Image image() const {
    image::Image out = image_;
    for (std::size_t i = 0; i < planes_[0].size(); ++i)
      for (const std::vector<double>& plane : planes_) out.pixels.push_back(static_cast<float>(plane[i]));
    return out;
  }

 private:
  std::size_t add_channels(const std::vector<std::string>& names) {
    const std::size_t first = image_.channels.size();
    image_.channels.insert(image_.channels.end(), names.begin(), names.end());
    planes_.resize(image_.channels.size(), std::vector<double>(planes_[0].size()));
    return first;
  }
  double& at(std::size_t channel, int x, int y) {
    return planes_[channel][static_cast<std::size_t>(y * image_.width + x)];
  }

  image::Image image_;
  std::vector<std::vector<double>> planes_;
  std::mt19937 random_;
};

// The mean squared error of R, G and B relative to the truth's square and a hundredth of its mean's.
inline double relative_error(const image::Image& image, const ColorAt& truth) {
  double mean = 0, sum = 0;
  const double count = 3.0 * image.width * image.height;
  const auto for_values = [&](auto&& body) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (std::size_t c = 0; c < 3; ++c) body(double(image.at(x, y, c)), truth(x, y)[c]);
  };
  for_values([&](double, double true_value) { mean += true_value / count; });
  for_values([&](double value, double true_value) {
    sum += (value - true_value) * (value - true_value) / (true_value * true_value + 0.01 * mean * mean);
  });
  return sum / count;
}

}  // namespace tyndall::denoise
