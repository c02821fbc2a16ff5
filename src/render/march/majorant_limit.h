// The majorants that free paths and ratio tracking draw their candidates from.
#pragma once

#include <algorithm>

#include "compile/majorant/majorant_dda.h"
#include "render/context/thread_context.h"

namespace tyndall::render {

// The majorant of a part of a ray, cut (and counted) where it is so far above the minorant that the optical
// depth between the two is beyond 1e5: shaders without a bound would never let a ray through.
inline double limited_majorant(const compile::MajorantSegment& s, ThreadContext& thread) {
  constexpr double greatest_depth = 1e5;
  const double majorant = s.bounds.majorant, minorant = s.bounds.minorant;
  const double most = greatest_depth / std::max(s.t1 - s.t0, 1e-300);
  if (!(majorant - minorant > most)) return majorant;
  ++thread.statistics.cut_majorants;
  return minorant + most;
}

}  // namespace tyndall::render
