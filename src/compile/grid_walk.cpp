#include "compile/grid_walk.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::compile {

namespace {

constexpr std::int64_t side = MajorantGrid::brick_side;

bool same(const CellBounds& a, const CellBounds& b) {
  return a.kind == b.kind && a.majorant == b.majorant && a.minorant == b.minorant && a.spread == b.spread;
}

}  // namespace

GridWalk::GridWalk(const MajorantGrid& grid, const Transform& medium_from_render, const Ray& ray, double t0,
                   double t1, BoundsScratch& scratch)
    : grid_(grid), scratch_(scratch), t_(t0), end_(t1) {
  const Vec3d o = medium_from_render.point(ray.origin) - grid.domain().box.lo,
              d = medium_from_render.vector(ray.direction);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double size = grid.cell_size()[axis];
    // A box without extent along an axis is one layer of cells.
    origin_[axis] = size > 0 ? o[axis] / size : 0.5;
    direction_[axis] = size > 0 ? d[axis] / size : 0;
    const double place = std::floor(origin_[axis] + direction_[axis] * t0);
    const std::int64_t last = grid.bricks()[axis] * side - 1;
    cell_[axis] = place > 0 ? static_cast<std::int64_t>(std::min(place, static_cast<double>(last))) : 0;
  }
  if (t_ < end_) {
    enter_brick();
    ahead_ = step();
  }
}

void GridWalk::enter_brick() {
  brick_ =
      &grid_.brick(static_cast<std::uint32_t>(cell_[0] / side), static_cast<std::uint32_t>(cell_[1] / side),
                   static_cast<std::uint32_t>(cell_[2] / side), scratch_);
}

// Where the ray leaves the slab of `count` cells from `low` along an axis; never for a ray that stays in it,
// or that leaves the grid with it (what lies outside by rounding counts with the outermost cells).
double GridWalk::exit(std::size_t axis, std::int64_t low, std::int64_t count) const {
  const double d = direction_[axis];
  if (d == 0) return infinity;
  const std::int64_t plane = d > 0 ? low + count : low;
  if (plane <= 0 || plane >= grid_.bricks()[axis] * side) return infinity;
  return (static_cast<double>(plane) - origin_[axis]) / d;
}

// The cell (or the whole brick) at t_; moves on to its end.
MajorantSegment GridWalk::step() {
  const bool whole = !brick_->cells;
  const std::int64_t count = whole ? side : 1;
  const auto low = [&](std::size_t axis) { return whole ? cell_[axis] / side * side : cell_[axis]; };
  std::size_t first = 0;
  double leave = infinity;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const double t = exit(axis, low(axis), count); t < leave) leave = t, first = axis;

  const auto inner =
      static_cast<std::uint32_t>((cell_[2] % side * side + cell_[1] % side) * side + cell_[0] % side);
  MajorantSegment segment{t_, std::min(std::max(leave, t_), end_), brick_->cell(inner)};
  t_ = segment.t1;
  if (!(leave < end_)) {
    t_ = end_;
    return segment;
  }
  const std::array<std::int64_t, 3> brick_before = {cell_[0] / side, cell_[1] / side, cell_[2] / side};
  if (whole)  // the other axes have moved inside the brick
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (axis != first) {
        const double place = std::floor(origin_[axis] + direction_[axis] * t_);
        const std::int64_t from = low(axis);
        cell_[axis] =
            place < static_cast<double>(from)
                ? from
                : std::min(from + side - 1,
                           static_cast<std::int64_t>(std::min(place, static_cast<double>(from + side))));
      }
  cell_[first] = direction_[first] > 0 ? low(first) + count : low(first) - 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (cell_[axis] / side != brick_before[axis]) {
      enter_brick();
      break;
    }
  return segment;
}

bool GridWalk::next(MajorantSegment& out) {
  if (!(ahead_.t0 < ahead_.t1) && !(t_ < end_)) return false;
  out = ahead_;
  ahead_ = {};
  while (t_ < end_) {
    const MajorantSegment s = step();
    if (s.t0 < s.t1 && !same(s.bounds, out.bounds)) {
      if (out.t0 < out.t1) {
        ahead_ = s;
        return true;
      }
      out = s;  // nothing of the one before
    }
    out.t1 = s.t1;
  }
  return out.t0 < out.t1;
}

}  // namespace tyndall::compile
