#include "render/film/adaptive_sampling.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace tyndall::render {

namespace {

// The planned error, of the wanted one: estimates waver, and what is told must hold.
constexpr double aim = 0.8;

// The planned squared error is that which the estimate has with so many of its own standard errors added, at
// most twice the estimate: where it hangs on a few pixels it may as well be as much more.
constexpr double doubts = 1, most_doubt = 1;

// A block that shows no error of its own is taken to have this part of the picture's.
constexpr double least_share = 1.0 / 16;

Vec3d half_mean(const Film& film, int x, int y, int half) {
  return (film.group_mean(x, y, 2 * half) + film.group_mean(x, y, 2 * half + 1)) * 0.5;
}

// The scale below which errors do not count, as a half of the picture has it: 0.01 of the squared mean of its
// values, of all channels.
double scale_of(const Film& film, const std::vector<Tile>& tiles, int half) {
  double sum = 0, pixels = 0;
  for (const Tile& tile : tiles) {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const Vec3d c = half_mean(film, x, y, half);
        sum += (c.x + c.y + c.z) / 3;
      }
    pixels += tile.pixels();
  }
  const double mean = pixels > 0 ? sum / pixels : 0.0;
  return 0.01 * mean * mean;
}

// The squared relative error of one half's mean, from the spread of its two groups and the other half's mean.
double half_error(const Film& film, int x, int y, int half, double scale) {
  const Vec3d spread = (film.group_mean(x, y, 2 * half) - film.group_mean(x, y, 2 * half + 1)) * 0.5;
  const Vec3d value = half_mean(film, x, y, 1 - half);
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double below = value[c] * value[c] + scale;
    if (below > 0) sum += spread[c] * spread[c] / below;
  }
  return sum / 3;
}

}  // namespace

AdaptivePlan::AdaptivePlan(const std::vector<Tile>& tiles, double target, int most_samples)
    : target_(target), most_per_half_(std::max(most_samples / 2, 1)), states_(tiles.size()) {
  CHECK_GT(target, 0);
  int pixels = 0;
  for (const Tile& tile : tiles) pixels += tile.pixels();
  least_per_half_ = std::min(least_samples(pixels) / 2, most_per_half_);
  for (TileState& state : states_) state.wanted.fill(least_per_half_);
}

// 2, 2, 4, 8, … up to the least, then half as much again as there is, up to 64; pairs, for the half's two
// groups.
int AdaptivePlan::next_count(int taken, int wanted) const {
  const int step = taken == 0 ? 2 : taken < least_per_half_ ? taken : taken / 2;
  return std::min({(std::min(step, wanted - taken) + 1) / 2 * 2, longest_pass, most_per_half_ - taken});
}

SampleRun AdaptivePlan::run(std::size_t tile, int half) const {
  const TileState& state = states_[tile];
  const int taken = state.taken[half], wanted = state.wanted[half];
  return {taken, taken < wanted ? next_count(taken, wanted) : 0};
}

std::uint32_t AdaptivePlan::taken(std::size_t tile) const {
  return static_cast<std::uint32_t>(states_[tile].taken[0] + states_[tile].taken[1]);
}
std::uint32_t AdaptivePlan::taken_after(std::size_t tile) const {
  return taken(tile) + static_cast<std::uint32_t>(run(tile, 0).count + run(tile, 1).count);
}

void AdaptivePlan::save(ByteWriter& out) const {
  out.put(states_.size());
  for (const TileState& s : states_)
    for (int half = 0; half < 2; ++half) {
      out.put(s.taken[half]);
      out.put(s.wanted[half]);
      out.put(s.share[half]);
    }
  for (const bool decided : {decides_, final_[0], final_[1], done_}) out.put(decided);
  for (const double number : {estimate_.squared, estimate_.outliers, fraction_done_}) out.put(number);
}

bool AdaptivePlan::restore(ByteReader& in) {
  if (in.take<std::size_t>() != states_.size()) return false;
  bool good = true;
  for (TileState& s : states_)
    for (int half = 0; half < 2; ++half) {
      in.take(s.taken[half]);
      in.take(s.wanted[half]);
      in.take(s.share[half]);
      good = good && s.taken[half] >= 0 && s.taken[half] <= most_per_half_ && s.wanted[half] >= 0 &&
             s.wanted[half] <= most_per_half_ && s.share[half] >= 0;
    }
  for (bool* decided : {&decides_, &final_[0], &final_[1], &done_}) in.take(*decided);
  for (double* number : {&estimate_.squared, &estimate_.outliers, &fraction_done_}) in.take(*number);
  return good && in.good();
}

// The errors of each tile's halves, and of the picture.
void AdaptivePlan::measure(const Film& film, const std::vector<Tile>& tiles) {
  const std::array<double, 2> scale{scale_of(film, tiles, 0), scale_of(film, tiles, 1)};
  double pixels = 0;
  std::array<double, 2> sums{}, squares{};
  std::vector<double> errors;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const Tile& tile = tiles[i];
    TileState& state = states_[i];
    state.error = {};
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        double both = 0;
        for (int half = 0; half < 2; ++half) {
          const double error = half_error(film, x, y, half, scale[1 - half]);
          state.error[half] += error / tile.pixels();
          sums[half] += error;
          squares[half] += error * error;
          both += error / 4;
        }
        errors.push_back(both);
      }
    state.weight = tile.pixels();
    pixels += tile.pixels();
  }
  for (TileState& state : states_) state.weight /= pixels;
  for (int half = 0; half < 2; ++half) {
    const double spread = std::max(squares[half] - sums[half] * sums[half] / pixels, 0.0);
    doubt_[half] = sums[half] > 0 ? std::min(doubts * std::sqrt(spread) / sums[half], most_doubt) : 0;
  }
  double sum = 0;
  for (const double e : errors) sum += e;
  estimate_ = {sum / pixels, 0};
  for (const double e : errors)
    if (e > outlier * estimate_.squared) estimate_.outliers += e / pixels;
}

// The roots of what the other half's errors make of each tile's variance a sample: the sum of samples is
// least for an error where they are shared out like these.
void AdaptivePlan::set_shares() {
  for (int half = 0; half < 2; ++half) {
    const int other = 1 - half;
    double mean = 0;
    for (const TileState& s : states_) mean += s.weight * s.error[other] * s.taken[other];
    for (TileState& s : states_)
      s.share[half] = std::sqrt(s.error[other] * s.taken[other] + least_share * mean);
  }
}

// What one half wants of each tile: as much as would bring the picture to the aim, were this half as noisy as
// the other.
void AdaptivePlan::want(int half) {
  const int other = 1 - half;
  const auto count = [&](const TileState& s, double factor) {
    return std::clamp(factor * s.share[half], double(s.taken[half]), double(most_per_half_));
  };
  const auto planned = [&](double factor) {
    double sum = 0;
    for (const TileState& s : states_)
      sum += s.weight * s.error[other] * s.taken[other] / (2 * count(s, factor));
    return sum;
  };
  const double goal = aim * aim * target_ * target_ / (1 + doubt_[other]);
  double lo = 0, hi = 0;
  for (const TileState& s : states_)
    if (s.share[half] > 0) hi = std::max(hi, most_per_half_ / s.share[half]);
  if (planned(lo) <= goal) hi = lo;
  for (int i = 0; i < 60 && lo < hi; ++i) {
    const double middle = (lo + hi) / 2;
    (planned(middle) > goal ? lo : hi) = middle;
  }
  for (TileState& s : states_) s.wanted[half] = static_cast<int>(std::ceil(count(s, hi)));
}

bool AdaptivePlan::satisfied(int half) const {
  return std::all_of(states_.begin(), states_.end(),
                     [&](const TileState& s) { return s.taken[half] >= s.wanted[half]; });
}

void AdaptivePlan::finish_pass(const Film& film, const std::vector<Tile>& tiles) {
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const std::array<int, 2> counts{run(i, 0).count, run(i, 1).count};
    for (int half = 0; half < 2; ++half) states_[i].taken[half] += counts[half];
  }
  measure(film, tiles);
  if (!decides_ && satisfied(0)) {
    decides_ = true;
    set_shares();
  }
  if (decides_)
    for (int half = 0; half < 2; ++half) {
      if (final_[half]) continue;
      want(half);
      final_[half] = satisfied(half);
    }
  done_ = final_[0] && final_[1];
  double taken = 0, wanted = 0;
  for (const TileState& s : states_)
    for (int half = 0; half < 2; ++half) {
      taken += s.weight * s.taken[half];
      wanted += s.weight * std::max(s.taken[half], s.wanted[half]);
    }
  fraction_done_ = wanted > 0 ? taken / wanted : 1;
}

}  // namespace tyndall::render
