#include "image/metering.h"

#include <algorithm>
#include <cmath>

#include "image/colors.h"

namespace tyndall::image {

double metered_stops(const Image& image) {
  constexpr double bright_share = 0.02, stops_below = 10;
  const ColorChannels channels = color_channels(image.channels);
  std::vector<float> lit;  // log2 of luminance
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size()) {
    const float light = luminance(channels.color(&image.pixels[i]));
    if (light > 0 && std::isfinite(light)) lit.push_back(std::log2(light));
  }
  if (lit.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(static_cast<double>(lit.size() - 1) * (1 - bright_share));
  std::nth_element(lit.begin(), lit.begin() + rank, lit.end());
  const double bright = lit[static_cast<std::size_t>(rank)], least = bright - stops_below;
  double sum = 0, count = 0;
  for (const float light : lit)
    if (light >= least) {
      sum += light;
      ++count;
    }
  return std::clamp(std::log2(middle_grey) - sum / count, std::log2(least_bright) - bright,
                    std::log2(most_bright) - bright);
}

}  // namespace tyndall::image
