#include "denoise/planes.h"

#include "base/parallel.h"

namespace tyndall::denoise {

void Plane::extend() {
  if (width_ == 0 || height_ == 0) return;
  for (int y = 0; y < height_; ++y) {
    std::fill(at(-border, y), at(0, y), *at(0, y));
    std::fill(at(width_, y), at(width_, y) + border, *at(width_ - 1, y));
  }
  for (int y = 1; y <= border; ++y) {
    std::copy_n(at(-border, 0), stride_, at(-border, -y));
    std::copy_n(at(-border, height_ - 1), stride_, at(-border, height_ - 1 + y));
  }
}

void for_rows(int height, int threads, const std::function<void(int y)>& body) {
  constexpr int band = 8;
  const auto bands = static_cast<std::size_t>((height + band - 1) / band);
  parallel_for(bands, threads, [&](std::size_t i, int) {
    const int y0 = static_cast<int>(i) * band;
    for (int y = y0; y < std::min(y0 + band, height); ++y) body(y);
  });
}

// Sums are made anew for each pixel: what a running sum loses beside one bright pixel would stay in it.
Plane box_mean(const Plane& of, int radius, int threads) {
  const int width = of.width(), height = of.height();
  Plane mean(width, height);
  for_rows(height, threads, [&](int y) {
    // Of the columns, with zeros beside them.
    std::vector<float> columns(static_cast<std::size_t>(width + 2 * radius));
    const int first = std::max(y - radius, 0), last = std::min(y + radius, height - 1);
    float* column = columns.data() + radius;
    for (int from = first; from <= last; ++from) {
      const float* values = of.at(0, from);
      for (int x = 0; x < width; ++x) column[x] += values[x];
    }
    float* to = mean.at(0, y);
    for (int k = -radius; k <= radius; ++k)
      for (int x = 0; x < width; ++x) to[x] += column[x + k];
    const int rows = last - first + 1;
    for (int x = 0; x < width; ++x) {
      const int across = std::min(x + radius, width - 1) - std::max(x - radius, 0) + 1;
      to[x] /= static_cast<float>(rows * across);
    }
  });
  return mean;
}

}  // namespace tyndall::denoise
