#pragma once

#include <string_view>
#include <vector>

#include "base/fields.h"
#include "generate/extrude.h"

namespace tyndall::generate {

// Closed outlines in the plane y = 0.
struct Outlines {
  std::vector<Outline> closed;
};

// A flat shape given a height.
struct Prism {
  static constexpr std::string_view keyword = "prism";
  static constexpr std::string_view documentation =
      "A flat shape, seen from above, from y = 0 up to its height. Outlines within others are holes. Corners "
      "of "
      "more than 30deg are edges. On its faces `uv` goes from 0 to 1 along x and -z over the box around the "
      "outlines; on its sides `uv.x` goes around each outline and `uv.y` upwards.";
  static constexpr bool closed = true;
  static constexpr std::string_view way_to_close = {};
  Outlines outline;
  double height = 1;
  template <class F>
  static void fields(F&& field) {
    field(&Prism::outline,
          FieldInfo{
              "outline",
              "a list of its corners: [(x, z), …]; or a list of such lists, those within others holes [m]",
              Quantity::length, required});
    field(&Prism::height, FieldInfo{"height", "how high it is, > 0 [m]", Quantity::length, required});
  }
  Problems validate() const;
  double facets() const;
  Made make() const;
};

}  // namespace tyndall::generate
