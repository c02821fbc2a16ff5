// The mean of a region of pictures of independent seeds, with its standard error.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/vec.h"
#include "render/film/film.h"

namespace tyndall::support {

// The mean radiance of a region and its standard error, by channel.
struct Estimate {
  Vec3d mean, standard_error;
};

// Over the pixels of [x0, x1) × [y0, y1).
inline Estimate region_estimate(const std::vector<render::Film>& films, int x0, int y0, int x1, int y1) {
  Vec3d sum, sum_of_squares;
  for (const render::Film& film : films) {
    Vec3d mean;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) mean += Vec3d(film.mean(x, y));
    mean /= static_cast<double>(x1 - x0) * (y1 - y0);
    sum += mean;
    sum_of_squares += mean * mean;
  }
  const auto n = static_cast<double>(films.size());
  Estimate estimate{sum / n, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    const double variance = std::max(0.0, sum_of_squares[c] / n - estimate.mean[c] * estimate.mean[c]);
    estimate.standard_error[c] = std::sqrt(variance / (n - 1));
  }
  return estimate;
}

}  // namespace tyndall::support
