// What a limit of the light of a path (scene/clamp.h) took away.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "render/film/film.h"

namespace tyndall::render {

// Exact sums over camera samples: what the film lacks, in each channel, and what it has. A sum of parts is
// that of the whole.
struct ClampedLight {
  std::array<FixedSum, 3> removed, kept;

  void add(const Rgb& before, const Rgb& after) {
    for (std::size_t c = 0; c < 3; ++c) {
      kept[c].add(double{after[c]});
      removed[c].add(double{before[c]});
      removed[c].add(-double{after[c]});
    }
  }
  void add_all(const ClampedLight& other) {
    for (std::size_t c = 0; c < 3; ++c) {
      removed[c].add(other.removed[c]);
      kept[c].add(other.kept[c]);
    }
  }
  // Calls f with each sum.
  template <class F>
  void each(F&& f) {
    for (auto* sums : {&removed, &kept})
      for (FixedSum& sum : *sums) f(sum);
  }
  // The share of the light that is gone, the channels together.
  double share() const {
    FixedSum gone, all;
    for (std::size_t c = 0; c < 3; ++c) {
      gone.add(removed[c]);
      all.add(removed[c]);
      all.add(kept[c]);
    }
    return all.value() > 0 ? gone.value() / all.value() : 0;
  }
};

}  // namespace tyndall::render
