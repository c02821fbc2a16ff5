#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "base/fields.h"
#include "generate/made.h"

namespace tyndall::generate {

// The height over a place, by its uv; nothing where there is none, which has been told.
using HeightFunction = std::function<std::optional<double>(const Pair<double>& uv)>;

// Heights over a rectangle: hills, waves, a relief.
struct HeightField {
  static constexpr std::string_view keyword = "heightfield";
  static constexpr std::string_view documentation =
      "Hills over a rectangle around the origin: each place has a height. With a `floor` it is a body that "
      "stands on it; without one it is an open sheet. `uv` goes from (0, 0) at low x and high z to (1, 1): "
      "an "
      "image lies as it is seen from above with -z upwards. Its upper side is smooth.";
  static constexpr bool closed = true;  // or so it should be
  static constexpr std::string_view way_to_close = "give it a `floor` below its lowest place";
  Pair<double> size;
  HeightFunction height;
  int resolution = 128;
  std::optional<double> floor;
  template <class F>
  static void fields(F&& field) {
    field(&HeightField::size,
          FieldInfo{"size", "its extent along x and along z, > 0 [m]", Quantity::length, required});
    field(&HeightField::height,
          FieldInfo{"height", "a function of uv, or an image of one channel: the y of a place [m]",
                    Quantity::length, required});
    field(&HeightField::resolution,
          FieldInfo{"resolution",
                    "cells along its longer side, at least 1; along the other as many of that size"});
    field(&HeightField::floor,
          FieldInfo{"floor", "the y of its flat underside, below all heights [m]; default: none",
                    Quantity::length});
  }
  Problems validate() const;
  double facets() const;
  Made make() const;
};

}  // namespace tyndall::generate
