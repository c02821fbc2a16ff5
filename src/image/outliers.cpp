#include "image/outliers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tyndall::image {

std::vector<Outlier> outliers(const Image& picture, int least) {
  const Image::Place whole = whole_of(picture);
  const std::vector<std::uint8_t> rgb = display_rgb(picture, View::of_numbers());
  const auto shown = [&](int x, int y) {
    const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(whole.whole_width) +
                               static_cast<std::size_t>(x));
    return static_cast<int>(0.2126 * rgb[i] + 0.7152 * rgb[i + 1] + 0.0722 * rgb[i + 2]);
  };
  std::vector<Outlier> out;
  for (int y = whole.y + 1; y + 1 < whole.y + picture.height; ++y)
    for (int x = whole.x + 1; x + 1 < whole.x + picture.width; ++x) {
      std::array<int, 8> around;
      for (int k = 0, n = 0; k < 9; ++k)
        if (k != 4) around[static_cast<std::size_t>(n++)] = shown(x + k % 3 - 1, y + k / 3 - 1);
      std::sort(around.begin(), around.end());
      const int excess = shown(x, y) - (around[3] + around[4]) / 2;
      if (excess > least) out.push_back({x, y, excess});
    }
  std::stable_sort(out.begin(), out.end(),
                   [](const Outlier& a, const Outlier& b) { return a.excess > b.excess; });
  return out;
}

double share_of_outliers(const Image& picture) {
  const double pixels = static_cast<double>(picture.width) * picture.height;
  return pixels > 0 ? static_cast<double>(outliers(picture).size()) / pixels : 0;
}

}  // namespace tyndall::image
