#include "render/adaptive.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace tyndall::render {

namespace {

// Mean of the picture's values, of all channels: sets the scale below which errors do not count.
double mean_value(const Film& film, const std::vector<Tile>& tiles) {
  double sum = 0, pixels = 0;
  for (const Tile& tile : tiles) {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Rgb c = film.mean(x, y);
        sum += (double{c.x} + c.y + c.z) / 3;
      }
    pixels += tile.pixels();
  }
  return pixels > 0 ? sum / pixels : 0.0;
}

// Mean over a tile of the squared relative error of one half's mean, from the spread of its two groups.
double half_error(const Film& film, const Tile& tile, int half, double scale) {
  double sum = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const Vec3d a = film.group_mean(x, y, 2 * half), b = film.group_mean(x, y, 2 * half + 1);
      for (int c = 0; c < 3; ++c) {
        const double mean = (a[c] + b[c]) / 2, spread = (a[c] - b[c]) / 2, below = mean * mean + scale;
        if (below > 0) sum += spread * spread / below;
      }
    }
  return sum / (3.0 * tile.pixels());
}

}  // namespace

AdaptivePlan::AdaptivePlan(std::size_t tiles, double target, int most_samples)
    : target_(target), most_per_half_(std::max(most_samples / 2, 1)), states_(tiles) {
  CHECK_GT(target, 0);
}

// 2, 2, 4, 8, 16, then half as much again as there is, up to 64; pairs, for the half's two groups.
int AdaptivePlan::next_count(int taken) const {
  const int wanted = taken == 0 ? 2 : taken < least_samples / 2 ? taken : taken / 2;
  return std::min({(wanted + 1) / 2 * 2, longest_pass, most_per_half_ - taken});
}

SampleRun AdaptivePlan::run(std::size_t tile, int half) const {
  const TileState& state = states_[tile];
  return {state.taken[half], state.active[half] ? next_count(state.taken[half]) : 0};
}

void AdaptivePlan::finish_pass(const Film& film, const std::vector<Tile>& tiles) {
  const double mean = mean_value(film, tiles), scale = 0.01 * mean * mean;
  double error = 0, pixels = 0, taken = 0, wanted = 0;
  done_ = true;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    TileState& state = states_[i];
    const std::array<double, 2> errors{half_error(film, tiles[i], 0, scale),
                                       half_error(film, tiles[i], 1, scale)};
    for (int half = 0; half < 2; ++half) state.taken[half] += run(i, half).count;
    const std::array<int, 2> n = state.taken;
    for (int half = 0; half < 2; ++half) {
      // Were this half as noisy a sample as the other: the error of the mean of both.
      const int other = 1 - half;
      const double both = errors[other] * (1 + double(n[other]) / std::max(n[half], 1)) / 4;
      state.active[half] =
          n[half] < most_per_half_ && (n[half] < least_samples / 2 || both > target_ * target_);
      done_ &= !state.active[half];
      taken += double(tiles[i].pixels()) * n[half];
      wanted += double(tiles[i].pixels()) *
                std::min<double>(most_per_half_, n[half] * std::max(1.0, both / (target_ * target_)));
    }
    error += (errors[0] + errors[1]) / 4 * tiles[i].pixels();
    pixels += tiles[i].pixels();
  }
  estimated_error_ = pixels > 0 ? std::sqrt(error / pixels) : 0;
  fraction_done_ = wanted > 0 ? taken / wanted : 1;
}

}  // namespace tyndall::render
