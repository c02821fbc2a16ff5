#include "image/false_colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tyndall::image {

SrgbColor color_of_level(double level) {
  constexpr std::array<SrgbColor, 7> stops = {{{0.03, 0.03, 0.12},
                                               {0.19, 0.09, 0.42},
                                               {0.45, 0.14, 0.48},
                                               {0.74, 0.25, 0.38},
                                               {0.93, 0.47, 0.22},
                                               {0.98, 0.75, 0.30},
                                               {0.99, 0.98, 0.78}}};
  const double place = std::clamp(level, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  SrgbColor color{};
  for (std::size_t k = 0; k < 3; ++k)
    color[k] = stops[i][k] + (stops[i + 1][k] - stops[i][k]) * (place - static_cast<double>(i));
  return color;
}

Image in_false_colors(const Image& numbers, double most) {
  Image colors{numbers.width, numbers.height, {"R", "G", "B"}, {}, numbers.place};
  colors.pixels.reserve(3 * numbers.pixels.size() / numbers.channels.size());
  for (std::size_t i = 0; i < numbers.pixels.size(); i += numbers.channels.size()) {
    const double number = numbers.pixels[i];
    const SrgbColor color = std::isfinite(number) ? color_of_level(number / most) : color_of_no_number;
    for (const double c : color) colors.pixels.push_back(linear_from_srgb(static_cast<float>(c)));
  }
  return colors;
}

}  // namespace tyndall::image
