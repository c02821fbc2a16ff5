#pragma once

#include <string_view>
#include <vector>

#include "base/fields.h"
#include "generate/made.h"

namespace tyndall::generate {

// One radius, or a list.
struct Radii {
  std::vector<double> values;
  // At one of so many points: one for all, one each, or evenly from the first to the last of two.
  double at(std::size_t point, std::size_t points) const {
    if (values.size() == points) return values[point];
    const double along = static_cast<double>(point) / static_cast<double>(points - 1);
    return values.front() + along * (values.back() - values.front());
  }
};

// What a ball passes over.
struct Sweep {
  static constexpr std::string_view keyword = "sweep";
  static constexpr std::string_view documentation =
      "What a ball passes over that goes along the smooth curve through the points: a rope, a pipe, a horn. "
      "Its "
      "ends are round; when the last point is the first, it is a ring. Where it meets itself it is filled "
      "once. `uv.x` goes around the path, `uv.y` along it.";
  static constexpr bool closed = true;
  static constexpr std::string_view way_to_close = {};
  std::vector<Vec3d> path;
  Radii radius;
  int segments = 32;
  template <class F>
  static void fields(F&& field) {
    field(&Sweep::path, FieldInfo{"path", "a list of points that the ball goes through: [(0, 0, 0), …] [m]",
                                  Quantity::position, required});
    field(&Sweep::radius,
          FieldInfo{"radius", "of the ball, >= 0 [m]; or a list: [first, last], or one for each point",
                    Quantity::length, required});
    field(&Sweep::segments,
          FieldInfo{"segments", "flat pieces around, 3 to 4096: 32 are within 0.5 % of the radius"});
  }
  Problems validate() const;
  double facets() const;
  Made make() const;
};

}  // namespace tyndall::generate
