// Rays that want more segments than a ray may have: what each part of them gets, and what that makes of steps
// and of tolerances.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/numerics.h"
#include "compile/compiled_scene.h"
#include "render/context/statistics.h"
#include "render/march/marched_intervals.h"

namespace tyndall::render {

// At most this many segments a ray; one that wants more gets wider ones (told).
inline constexpr std::uint32_t max_segments = 4096;

// How many segments of at most `step` metres, at least one; an infinite step: one. Not more than sums of them
// are exact for.
inline double wanted_segments(double length, double step) {
  constexpr double most = 0x1p40;
  return std::clamp(std::ceil(length / step), 1.0, most);
}

// Shares the limit out over the parts of a ray, in proportion to what each wants beyond the one segment that
// it has in any case. All parts together get what they want or the limit, whichever is less, so a finer step
// never gives fewer.
class SegmentAllotment {
 public:
  // `wanted` segments, in `parts` parts.
  SegmentAllotment(double wanted, std::size_t parts) {
    const double own = static_cast<double>(parts);
    if (wanted > max_segments) share_ = std::max(max_segments - own, 0.0) / (wanted - own);
  }
  // The next part's, one after the other; rounded so that the sum is.
  std::uint32_t next(double wanted) {
    wanted_ += wanted - 1;
    const double end = std::round(wanted_ * share_), more = end - given_;
    given_ = end;
    return 1 + static_cast<std::uint32_t>(more);
  }

 private:
  double share_ = 1, wanted_ = 0, given_ = 0;
};

// What a ray's segments are worth when they are fewer than wanted.
class SegmentShortage {
 public:
  explicit SegmentShortage(const compile::CompiledScene& world) : world_(&world) {}

  // Part by part along the ray: `count` segments over `length` metres, which share these intervals.
  void begin_part() { asked_step_ = infinity, spread_ = minorant_ = 0; }
  void add(const MarchedInterval& interval);
  void end_part(double length, std::uint32_t count);
  // Notes the ray.
  void count_in(Statistics& statistics) const;

 private:
  const compile::CompiledScene* world_;
  double asked_step_ = 0, spread_ = 0, minorant_ = 0;  // of the part at hand
  double worst_asked_ = 1, worst_step_ = 0;            // of given steps: the one that was widened most
  double tolerance_ = 0;                               // the laxest of those to be kept; 0: none
  double spent_ = 0, depth_ = 0, reached_ = 0;         // error_bounded_steps.h
};

}  // namespace tyndall::render
