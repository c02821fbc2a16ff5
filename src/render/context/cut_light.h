// How much light the limit of bounces leaves out of a picture.
//
// What a path still carries when it is cut says little: most of it may go where there is no light. So the
// later half of the bounces tells what it is worth. A throughput that falls from `from` to `cut` over them
// found the light `found`; at that rate the rest finds found * cut / (from - cut). That is exact where every
// bounce takes the same part, as deep in a cloud, and where what leaves finds the same light everywhere, as
// under a white sky. Where throughput falls ever more slowly it is too low: by a fifth of itself in a bank of
// cloud.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/vec.h"

namespace tyndall::render {

// The number of the first bounce whose light is looked at. A scattering has the number of the ray that it
// ends.
constexpr std::uint32_t first_late_bounce(int bounces) {
  return (static_cast<std::uint32_t>(bounces) + 1) / 2;
}

// Sums over samples, of each channel.
struct CutLight {
  Vec3d from, cut;  // throughput
  Vec3d found;      // light that the late bounces added, or that their rays hit

  void add_all(const CutLight& other) {
    from += other.from;
    cut += other.cut;
    found += other.found;
  }
  // What was left out, the channels together.
  double lost() const {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(cut[c] > 0 && found[c] > 0)) continue;
      // A throughput that does not fall would find light for ever.
      sum += found[c] * cut[c] / std::max(from[c] - cut[c], least_fall * cut[c]);
    }
    return sum;
  }
  // The part of the throughput that the late bounces left.
  double left() const {
    const double all = from.x + from.y + from.z;
    return all > 0 ? (cut.x + cut.y + cut.z) / all : 0;
  }

 private:
  static constexpr double least_fall = 1e-3;
};

}  // namespace tyndall::render
