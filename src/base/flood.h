// Texts with errors beyond number are no scenes: reading them ends, for each error costs time.
#pragma once

#include "base/diagnostics.h"

namespace tyndall {

inline constexpr int max_counted_errors = 1000;

// True once further errors are not even worth counting.
inline bool flooded(const Diagnostics& diagnostics) {
  return diagnostics.error_count() >= max_counted_errors;
}

}  // namespace tyndall
