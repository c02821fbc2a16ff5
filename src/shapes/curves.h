#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/fields.h"
#include "base/id.h"
#include "base/vec.h"

namespace tyndall::shapes {

// Where the points of strands are at a moment, and how thick they are there.
struct StrandPose {
  std::vector<Vec3d> points;
  std::vector<double> radii;
};

// Tubes along smooth curves: hair, grass, threads. Each strand goes through its points, by Catmull and Rom's
// spline; its radius goes from point to point along with it.
struct StrandSet {
  std::vector<Vec3d> points;         // of all strands, one strand after the other
  std::vector<double> radii;         // one a point, >= 0
  std::vector<std::uint32_t> begin;  // of each strand, and the end of the last
  // Of strands that move among themselves: their poses after that of when the shutter opens, evenly apart
  // until it closes. Between two poses everything is interpolated linearly.
  std::vector<StrandPose> later{};
  std::size_t strands() const { return begin.empty() ? 0 : begin.size() - 1; }
};
using StrandSetId = Id<StrandSet>;

// One of the scene's strand sets, as a shape.
struct Curves {
  static constexpr std::string_view keyword = "curves";
  static constexpr std::string_view documentation =
      "Tubes along smooth curves. `uv.x` tells strands apart, `uv.y` goes from the root to the tip.";
  static constexpr bool closed = false;
  StrandSetId strands;
  template <class F>
  static void fields(F&& field) {
    field(&Curves::strands, FieldInfo{"strands", "the number of the strand set"});
  }
};

}  // namespace tyndall::shapes
