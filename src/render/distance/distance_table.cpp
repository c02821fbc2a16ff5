#include "render/distance/distance_table.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {

namespace {

// The cell's variable at t.
double variable_at(const TableCell& cell, double t) {
  const double x = std::clamp((t - cell.t.lo) / (cell.t.hi - cell.t.lo), 0.0, 1.0);
  return cell.ratio * x / (1 - x + cell.ratio * x);
}

// Where the mass from the cell's start is `mass`. The form of the root that loses no digits.
double variable_of_mass(const TableCell& cell, double mass) {
  const double root = std::sqrt(std::max(sqr(cell.lo) + 2 * (cell.hi - cell.lo) * mass, 0.0));
  const double sum = cell.lo + root;
  return sum > 0 ? std::min(2 * mass / sum, 1.0) : 0.0;
}

}  // namespace

void DistanceTable::finish() {
  total_ = 0;
  for (TableCell& cell : cells_) {
    cell.before = total_;
    total_ += cell.mass();
  }
  if (!(total_ < infinity)) total_ = 0;
}

DistanceTable::Drawn DistanceTable::sample(double u) const {
  const double target = u * total_;
  auto after = std::upper_bound(cells_.begin(), cells_.end(), target,
                                [](double value, const TableCell& cell) { return value < cell.before; });
  do --after;  // the first cell begins at 0
  while (!(after->mass() > 0) && after != cells_.begin());
  const TableCell& cell = *after;
  const double s = variable_of_mass(cell, std::clamp(target - cell.before, 0.0, cell.mass()));
  const double t = cell.t.lo + (cell.t.hi - cell.t.lo) * (s / (cell.ratio + (1 - cell.ratio) * s));
  return {std::clamp(t, cell.t.lo, cell.t.hi), cell.segment};
}

const TableCell* DistanceTable::cell_at(double t) const {
  const auto after = std::upper_bound(cells_.begin(), cells_.end(), t,
                                      [](double value, const TableCell& cell) { return value < cell.t.lo; });
  if (after == cells_.begin() || t > (after - 1)->t.hi) return nullptr;
  return &*(after - 1);
}

double DistanceTable::pdf(double t) const {
  if (!available()) return 0;
  const TableCell* const cell = cell_at(t);
  if (cell == nullptr) return 0;
  const double width = cell->t.hi - cell->t.lo;
  const double x = (t - cell->t.lo) / width, scale = 1 - x + cell->ratio * x;
  const double s = cell->ratio * x / scale;
  return (cell->lo + (cell->hi - cell->lo) * s) / total_ * (cell->ratio / (width * sqr(scale)));
}

double DistanceTable::cdf(double t) const {
  if (!available()) return 0;
  const auto after = std::upper_bound(cells_.begin(), cells_.end(), t,
                                      [](double value, const TableCell& cell) { return value < cell.t.lo; });
  if (after == cells_.begin()) return 0;
  const TableCell& cell = *(after - 1);
  const double s = variable_at(cell, t);
  return std::min((cell.before + s * (cell.lo + 0.5 * (cell.hi - cell.lo) * s)) / total_, 1.0);
}

}  // namespace tyndall::render
