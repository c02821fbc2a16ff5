#pragma once

#include <string_view>
#include <vector>

#include "base/fields.h"
#include "generate/made.h"

namespace tyndall::generate {

// A profile turned about the y axis.
struct Lathe {
  static constexpr std::string_view keyword = "lathe";
  static constexpr std::string_view documentation =
      "A profile turned about the y axis: a vase, a bottle, a turned leg. It is a body when the profile "
      "begins "
      "and ends on the axis, or ends where it began; otherwise it is an open sheet. Corners of more than "
      "30deg "
      "are edges. `uv.x` goes around, counter-clockwise seen from above, and `uv.y` along the profile.";
  static constexpr bool closed = true;  // or so it should be
  static constexpr std::string_view way_to_close =
      "begin and end the profile on the axis, at radius 0, or end it where it began";
  std::vector<Pair<double>> profile;
  bool smooth = false;
  int segments = 96;
  template <class F>
  static void fields(F&& field) {
    field(&Lathe::profile, FieldInfo{"profile", "a list of its points: [(radius, y), …], the radius >= 0 [m]",
                                     Quantity::length, required});
    field(&Lathe::smooth,
          FieldInfo{"smooth",
                    "whether it is a smooth curve through its points; one that is given twice in a row is a "
                    "corner still"});
    field(&Lathe::segments,
          FieldInfo{"segments", "flat pieces around, 3 to 4096: 96 are within 0.06 % of the radius"});
  }
  Problems validate() const;
  double facets() const;
  Made make() const;
};

}  // namespace tyndall::generate
