// Steps that change from cell to cell of a volume's grids, for media that are rough in few places.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "compile/majorant/majorant_grid.h"

namespace tyndall::compile {

// The step [m] in a cell that is not empty: the widest, or where the bounds of extinction are `spread` [1/m]
// apart, one with spread x step <= most_spread. Powers of the square root of 2, so that neighbours often have
// the same.
inline double graded_step(double widest, double most_spread, float spread) {
  const double ratio = widest * double{spread} / most_spread;
  if (!(ratio > 1)) return widest;
  return widest * std::exp2(-0.5 * std::min(std::ceil(2 * std::log2(ratio)), 120.0));
}
// Of one value but for rounding: one segment.
inline double graded_step(double widest, double most_spread, const CellBounds& cell) {
  return cell.kind == CellKind::uniform ? infinity : graded_step(widest, most_spread, cell.spread);
}

}  // namespace tyndall::compile
