// A tabulated density of distances along a ray, whose map from a number to a distance is monotone and smooth:
// low-discrepancy points keep their rate behind it.
//
// A cell [a, b] has a variable s in [0, 1] of its own,
//
//   t = a + (b - a) s / (k + (1 - k) s),   k = r(b) / r(a),
//
// with r the distance to a pivot. It is the angle seen from the pivot to second order in that angle, and
// needs no trigonometry: s = 1/2 is where the angle is halved. The density per unit of s is linear in it, so
// the inverse solves a quadratic equation. Where the densities of neighbours agree at their common end, the
// map's derivative is continuous.
#pragma once

#include <cstdint>
#include <vector>

#include "base/interval.h"
#include "render/march/march.h"

namespace tyndall::render {

struct TableCell {
  Intervald t;            // [m], not empty
  double ratio = 1;       // k
  double lo = 0, hi = 0;  // at the ends, per unit of s; not normalised
  std::uint32_t segment = 0;
  double before = 0;  // sum of the masses of the cells before: set by the table

  double mass() const { return 0.5 * (lo + hi); }
};

// Reused, with its memory.
class DistanceTable {
 public:
  void clear() { cells_.clear(), total_ = 0; }
  // In order of t; gaps have no density.
  void add(const TableCell& cell) { cells_.push_back(cell); }
  // After the last one.
  void finish();

  bool available() const { return total_ > 0; }
  // The distance for u in [0, 1), and the segment that the cell belongs to: never decreasing in u. There must
  // be mass.
  struct Drawn {
    double t = 0;
    std::uint32_t segment = 0;
  };
  Drawn sample(double u) const;
  // Per metre.
  double pdf(double t) const;
  // The probability of distances up to t.
  double cdf(double t) const;
  std::size_t size() const { return cells_.size(); }

 private:
  // The cell that holds t; null in gaps.
  const TableCell* cell_at(double t) const;

  std::vector<TableCell> cells_;
  double total_ = 0;
};

}  // namespace tyndall::render
