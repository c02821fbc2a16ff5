// Filters of planes that are products of one along the rows and one along the columns.
#pragma once

#include <vector>

namespace tyndall::image {

// Numbers row by row from the top.
struct FloatPlane {
  int width = 0, height = 0;
  std::vector<float> values;

  FloatPlane() = default;
  FloatPlane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

// Weights of what is at -radius … radius.
using Taps = std::vector<float>;

// out(x, y) = Σ across[i] down[j] in(x + i, y + j). Beyond an edge stand the numbers of the edge.
FloatPlane filter(const FloatPlane& in, const Taps& across, const Taps& down);

}  // namespace tyndall::image
