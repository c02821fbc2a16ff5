// How many samples each block of the picture needs for a wanted error (transport §8).
//
// Counts that are decided from the very samples they sum favour blocks that look clean because they missed
// their fireflies: the mean comes out too dark. So each block's samples are two halves of independent random
// numbers, each half's counts are decided from the errors that the other shows, and the picture is the mean
// of the two halves' means, however many samples each took.
//
// A half's error relative to the picture is its spread over what the *other* half says the picture is: over
// its own mean a firefly would hide itself, as no spread of two numbers passes their mean.
//
// A half cannot react to what it alone has met: it may end with an error above the goal. That is told, for
// more samples in answer to the very ones that are summed would thin out what is rare.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/bytes.h"
#include "render/film/film.h"

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
  AdaptivePlan(const std::vector<Tile>& tiles, double target, int most_samples);

  // What a tile's half takes in the pass at hand.
  SampleRun run(std::size_t tile, int half) const;
  // Samples of each pixel of a tile before and after the pass at hand.
  std::uint32_t taken(std::size_t tile) const;
  std::uint32_t taken_after(std::size_t tile) const;
  // Decides the next pass from the film.
  void finish_pass(const Film& film, const std::vector<Tile>& tiles);
  bool done() const { return done_; }
  // Of the picture so far, in the measure of `target`; 0 before the first decision.
  double estimated_error() const { return std::sqrt(estimate_.squared); }
  // The share of its square in pixels that have more than outlier times the mean: a few samples that met what
  // is rare and bright. What no sample has met is in no estimate, and where such samples make the most of it
  // there is more of their kind to be met.
  double outlier_share() const { return estimate_.squared > 0 ? estimate_.outliers / estimate_.squared : 0; }
  static constexpr double outlier = 100;
  // Of all samples that will be taken, how many have been: a guess.
  double fraction_done() const { return fraction_done_; }

  // All that is decided and the film does not tell; and back, into a plan of the same tiles and target. False
  // when it is not of one.
  void save(ByteWriter& out) const;
  bool restore(ByteReader& in);

  // Each pixel takes at least so many before anything is decided: what is rare must have had its chance to be
  // seen somewhere, which takes more samples per pixel in a picture of few.
  static constexpr int least_samples(int pixels) {
    return std::clamp(least_samples_of_picture / pixels / 8 * 8, 16, 64);
  }
  static constexpr int least_samples_of_picture = 1 << 15;

 private:
  struct TileState {
    std::array<int, 2> taken{};     // samples of each half
    std::array<int, 2> wanted{};    // of each half in the end, as it looks now
    std::array<double, 2> error{};  // squared, of each half's mean
    double weight = 0;              // of its pixels in the picture
    std::array<double, 2> share{};  // of each half's samples
  };
  int next_count(int taken, int wanted) const;
  void measure(const Film& film, const std::vector<Tile>& tiles);
  void set_shares();
  void want(int half);
  bool satisfied(int half) const;
  static constexpr int longest_pass = 64;  // samples of a half: bounds what a tile holds in memory

  double target_;
  int least_per_half_, most_per_half_;
  std::vector<TileState> states_;
  bool decides_ = false;  // the least samples are there
  std::array<bool, 2>
      final_{};  // a half that was satisfied stays so: what the other learns because of it tells it nothing
  bool done_ = false;
  std::array<double, 2> doubt_{};  // how much more each half's squared error may be, as a share of it
  struct Estimate {
    double squared = 0, outliers = 0;
  };
  Estimate estimate_;
  double fraction_done_ = 0;
};

}  // namespace tyndall::render
