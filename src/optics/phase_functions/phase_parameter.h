// What a phase function says of one of its parameters.
#pragma once

#include <string_view>

#include "base/fields.h"

namespace tyndall::optics {

// The range has both its ends.
struct PhaseParameter {
  std::string_view name;
  std::string_view text;  // what it is, for the manual
  double lowest = 0, highest = 0;
  Quantity quantity = Quantity::plain;  // plain, or a length [m]
  std::string_view range = {};          // as scenes write it; empty: its numbers
};

}  // namespace tyndall::optics
