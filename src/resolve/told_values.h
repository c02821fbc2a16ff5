// How it is told that a number of a medium's body is out of its range: the same before a rendering, of a
// place where it is so, as the beginning of what is told after it (tools/run_report.cpp asks whether it was).
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "scene/medium.h"

namespace tyndall::resolve {

enum class OutOfRange : std::uint8_t { undefined, below, above };

// The beginning of the message.
inline std::string told_out_of_range(std::string_view name, OutOfRange kind, double lowest, double highest) {
  switch (kind) {
    case OutOfRange::undefined:
      return fmt::format("'{}' is not a number here", name);
    case OutOfRange::below:
      return fmt::format("'{}' is below {} here", name, lowest);
    case OutOfRange::above:
      return highest >= double{scene::largest_coefficient}
                 ? fmt::format("'{}' is infinite or above 1e30 here", name)
                 : fmt::format("'{}' is above {} here", name, highest);
  }
  return {};
}

// The way out.
inline std::string help_for_out_of_range(OutOfRange kind, double lowest, double highest) {
  switch (kind) {
    case OutOfRange::undefined:
      return "look for 0/0, or a root or logarithm of a negative number";
    case OutOfRange::below:
      return fmt::format("max({}, …) says that it is meant", lowest);
    case OutOfRange::above:
      return highest >= double{scene::largest_coefficient}
                 ? "look for a division by zero"
                 : fmt::format("min({}, …) says that it is meant", highest);
  }
  return {};
}

}  // namespace tyndall::resolve
