// Every SIMD class of this processor, one after the other.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "hwy/targets.h"
#include "vm/run/machine.h"

namespace tyndall::support {

// Runs body(name) once for every SIMD class of this processor that the program was compiled for. Gives their
// number.
template <class Body>
std::size_t for_each_simd_class(const Body& body) {
  const std::int64_t supported = hwy::SupportedTargets();
  std::vector<std::string> seen;
  for (std::int64_t bit = 1; bit > 0 && bit < (std::int64_t{1} << 16); bit <<= 1) {
    hwy::GetChosenTarget().Update(supported & bit);
    const std::string name = vm::simd_name();
    if (std::find(seen.begin(), seen.end(), name) == seen.end()) {
      seen.push_back(name);
      SCOPED_TRACE(name);
      body(name);
    }
  }
  hwy::GetChosenTarget().Update(supported);
  return seen.size();
}

}  // namespace tyndall::support
