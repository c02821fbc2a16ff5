// Numbers as people read them: errors in per cent, with as many digits as their intervals leave.
#pragma once

#include <fmt/format.h>

#include <string>

#include "tools/measure/accuracy.h"

namespace tyndall::tools {

// Three digits, and no exponent for what is large.
inline std::string three_digits(double value) {
  return value < 999 ? fmt::format("{:.3g}", value) : fmt::format("{:.0f}", value);
}

// So many digits, and no exponent for what is large.
inline std::string percent_digits(double value, int digits) {
  return 100 * value < 99 ? fmt::format("{:.{}g}", 100 * value, digits) : fmt::format("{:.0f}", 100 * value);
}

// "1.23 (1.1 to 1.3)"; "< 0.4" where the interval has 0.
inline std::string percent_text(const Estimate& estimate) {
  if (estimate.low <= 0) return "< " + percent_digits(estimate.high, 2);
  return fmt::format("{} ({} to {})", percent_digits(estimate.value, 3), percent_digits(estimate.low, 3),
                     percent_digits(estimate.high, 3));
}

// "-1.23 ± 0.1".
inline std::string signed_percent_text(const Estimate& estimate) {
  return fmt::format("{:+.2g} ± {:.2g}", 100 * estimate.value, 50 * (estimate.high - estimate.low));
}

}  // namespace tyndall::tools
