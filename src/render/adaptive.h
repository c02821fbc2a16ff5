// How many samples each block of the picture needs for a wanted error (transport §8).
//
// Counts that are decided from the very samples they sum favour blocks that look clean because they missed
// their fireflies: the mean comes out too dark. So each block's samples are two halves of independent random
// numbers, each half's count is decided from the errors that the other shows, and the picture is the mean of
// the two halves' means, however many samples each took.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/film.h"

namespace tyndall::render {

// A block of pixels, half-open.
struct Tile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int pixels() const { return (x1 - x0) * (y1 - y0); }
};

// Samples [first, first + count) of a half, counted within it.
struct SampleRun {
  int first = 0, count = 0;
};

// The number among all samples of a pixel of sample k of a half: the half's two groups take turns.
constexpr std::uint64_t sample_of_half(int half, int k) {
  return static_cast<std::uint64_t>(k / 2) * error_groups + static_cast<std::uint64_t>(2 * half + k % 2);
}

class AdaptivePlan {
 public:
  // `target` is the wanted root of the mean over the pixels of the squared error over (value² + e), with e =
  // 0.01 (mean value of the picture)². No pixel takes more than about `most_samples`.
  AdaptivePlan(std::size_t tiles, double target, int most_samples);

  // What a tile's half takes in the pass at hand.
  SampleRun run(std::size_t tile, int half) const;
  // Decides the next pass from the film.
  void finish_pass(const Film& film, const std::vector<Tile>& tiles);
  bool done() const { return done_; }
  // Of the picture so far, in the measure of `target`; 0 before the first decision.
  double estimated_error() const { return estimated_error_; }
  // Of all samples that will be taken, how many have been: a guess.
  double fraction_done() const { return fraction_done_; }

  // Each pixel takes at least so many, before anything is decided.
  static constexpr int least_samples = 64;

 private:
  struct TileState {
    std::array<int, 2> taken{};  // samples of each half
    std::array<bool, 2> active{true, true};
  };
  int next_count(int taken) const;
  static constexpr int longest_pass = 64;  // samples of a half: bounds what a tile holds in memory

  double target_;
  int most_per_half_;
  std::vector<TileState> states_;
  bool done_ = false;
  double estimated_error_ = 0, fraction_done_ = 0;
};

}  // namespace tyndall::render
