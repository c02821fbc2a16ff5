#include "image/separable.h"

#include <algorithm>
#include <cstddef>

#include "base/parallel.h"

namespace tyndall::image {
namespace {

// sum[x] += weight * row[x], which compilers make vectors of.
void add_scaled(float* sum, const float* row, float weight, int width) {
  for (int x = 0; x < width; ++x) sum[x] += weight * row[x];
}

int radius_of(const Taps& taps) { return static_cast<int>(taps.size() / 2); }

void filter_row(const float* in, int width, const Taps& taps, float* out) {
  const int radius = radius_of(taps);
  std::vector<float> wide(static_cast<std::size_t>(width + 2 * radius));
  std::fill_n(wide.begin(), radius, in[0]);
  std::copy_n(in, width, wide.begin() + radius);
  std::fill_n(wide.end() - radius, radius, in[width - 1]);
  for (std::size_t k = 0; k < taps.size(); ++k) add_scaled(out, wide.data() + k, taps[k], width);
}

}  // namespace

FloatPlane filter(const FloatPlane& in, const Taps& across, const Taps& down) {
  FloatPlane rows(in.width, in.height), out(in.width, in.height);
  if (in.values.empty()) return out;
  const auto height = static_cast<std::size_t>(in.height);
  parallel_for(height, 0, [&](std::size_t y, int) {
    filter_row(in.row(static_cast<int>(y)), in.width, across, rows.row(static_cast<int>(y)));
  });
  const int radius = radius_of(down);
  parallel_for(height, 0, [&](std::size_t index, int) {
    const int y = static_cast<int>(index);
    for (int k = -radius; k <= radius; ++k)
      add_scaled(out.row(y), rows.row(std::clamp(y + k, 0, in.height - 1)),
                 down[static_cast<std::size_t>(k + radius)], in.width);
  });
  return out;
}

}  // namespace tyndall::image
