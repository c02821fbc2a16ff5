#include "compile/majorant/majorant_dda.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::compile {

namespace {

constexpr std::int32_t side = MajorantGrid::brick_side, block_side = MajorantGrid::block_side;

}  // namespace

MajorantDda::MajorantDda(const MajorantGrid& grid, const Transform& medium_from_render, const Ray& ray,
                         double t0, double t1, BoundsScratch& scratch)
    : grid_(grid), scratch_(scratch), t_(t0), end_(t1) {
  const Vec3d o = medium_from_render.point(ray.origin) - grid.domain().box.lo,
              d = medium_from_render.vector(ray.direction);
  std::array<std::int32_t, 3> cell{};
  for (std::size_t i = 0; i < 3; ++i) {
    Axis& a = axes_[i];
    const double size = grid.cell_size()[i];
    // A box without extent along an axis is one layer of cells.
    a.origin = size > 0 ? o[i] / size : 0.5;
    a.speed = size > 0 ? d[i] / size : 0;
    a.inverse = 1 / a.speed;
    a.up = a.speed > 0;
    a.stride = (i == 0 ? 1 : i == 1 ? side : side * side) * (a.up ? 1 : -1);
    const std::int32_t cells = static_cast<std::int32_t>(grid.bricks()[i]) * side;
    // The plane that bounds the grid is never crossed: what lies outside by rounding counts with the
    // outermost cells.
    a.last = a.speed == 0 ? -1 : a.up ? cells : 0;
    const double place = std::floor(a.origin + a.speed * t0);
    cell[i] = place > 0 ? static_cast<std::int32_t>(std::min(place, static_cast<double>(cells - 1))) : 0;
  }
  if (!(t_ < end_)) return;
  enter(cell);
  ahead_ = step();
}

// When the ray reaches an axis' next plane.
void MajorantDda::aim(Axis& a) const {
  a.leave =
      a.plane == a.last || a.speed == 0 ? infinity : (static_cast<double>(a.plane) - a.origin) * a.inverse;
}

// The block of the cell, or its whole brick: passed in one step where all of it is the same to the caller.
void MajorantDda::enter(const std::array<std::int32_t, 3>& cell) {
  const std::array<std::int32_t, 3> at = {cell[0] / side, cell[1] / side, cell[2] / side};
  if (!brick_ || at != brick_at_) {
    brick_at_ = at;
    brick_ = &grid_.brick(static_cast<std::uint32_t>(at[0]), static_cast<std::uint32_t>(at[1]),
                          static_cast<std::uint32_t>(at[2]), scratch_);
  }
  inner_ = 0;
  for (std::size_t i = 0; i < 3; ++i) inner_ += (cell[i] - at[i] * side) * std::abs(axes_[i].stride);
  if (!brick_->cells) {
    width_ = side;
    one_step_ = true;
  } else {
    width_ = block_side;
    one_step_ = brick_->cells->empty_block[MajorantGrid::block_of(static_cast<std::uint32_t>(inner_))];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Axis& a = axes_[i];
    a.low = cell[i] / width_ * width_;
    const std::int32_t inside = cell[i] - a.low;
    a.plane = one_step_ ? (a.up ? a.low + width_ : a.low) : a.up ? cell[i] + 1 : cell[i];
    a.left = one_step_ ? 1 : a.up ? width_ - inside : inside + 1;
    aim(a);
  }
}

// Into the next block along an axis; the others are where t_ says, in the block that is left.
void MajorantDda::leave(std::size_t along) {
  std::array<std::int32_t, 3> cell{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Axis& a = axes_[i];
    if (i == along) {
      cell[i] = a.up ? a.low + width_ : a.low - 1;
    } else if (!one_step_) {
      cell[i] = a.up ? a.low + width_ - a.left : a.low + a.left - 1;
    } else {
      const double place = std::floor(a.origin + a.speed * t_) - a.low;
      cell[i] = a.low + (place > 0 ? static_cast<std::int32_t>(std::min(place, width_ - 1.0)) : 0);
    }
  }
  enter(cell);
}

// The cell (or the whole block) at t_; moves on to its end.
MajorantSegment MajorantDda::step() {
  const std::size_t along = axes_[0].leave <= axes_[1].leave   ? (axes_[0].leave <= axes_[2].leave ? 0 : 2)
                            : axes_[1].leave <= axes_[2].leave ? 1
                                                               : 2;
  Axis& a = axes_[along];
  MajorantSegment segment{t_, end_, brick_->cell(static_cast<std::uint32_t>(inner_))};
  if (!(a.leave < end_)) {
    t_ = end_;
    return segment;
  }
  segment.t1 = t_ = std::max(a.leave, t_);
  if (--a.left == 0) {
    leave(along);
  } else {
    inner_ += a.stride;
    a.plane += a.up ? 1 : -1;
    aim(a);
  }
  return segment;
}

bool MajorantDda::next(MajorantSegment& out) {
  if (!(ahead_.t0 < ahead_.t1) && !(t_ < end_)) return false;
  out = ahead_;
  ahead_ = {};
  while (t_ < end_) {
    const MajorantSegment s = step();
    if (s.t0 < s.t1 && s.bounds != out.bounds) {
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
