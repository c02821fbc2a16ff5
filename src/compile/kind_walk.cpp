#include "compile/kind_walk.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::compile {

KindWalk::KindWalk(const MajorantGrid& grid, const Transform& medium_from_render, const Ray& ray, double t0,
                   double t1, double step, BoundsScratch& scratch)
    : grid_(grid), scratch_(scratch), t_(t0), end_(t1) {
  const Vec3d o = medium_from_render.point(ray.origin) - grid.domain().box.lo,
              d = medium_from_render.vector(ray.direction), size = grid.cell_size();
  // A box without extent along an axis is one layer of cells.
  Vec3d origin(0.5), speed(0);  // in cells
  for (std::size_t i = 0; i < 3; ++i)
    if (size[i] > 0) origin[i] = o[i] / size[i], speed[i] = d[i] / size[i];
  const double step_in_cells = step * std::max({std::abs(speed.x), std::abs(speed.y), std::abs(speed.z)});
  while (level_ + 1 < MajorantGrid::levels && step_in_cells >= 2 << level_) ++level_;
  const double shrink = 1.0 / (1 << level_);
  std::size_t stride = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    Axis& a = axes_[i];
    const std::int32_t groups = static_cast<std::int32_t>(grid.groups(level_)[i]);
    const double from = origin[i] * shrink, rate = speed[i] * shrink;
    // The plane that bounds the grid is never crossed: what lies outside by rounding counts with the
    // outermost cells.
    const double place = std::floor(from + rate * t0);
    const std::int32_t at = place > 0 ? static_cast<std::int32_t>(std::min(place, groups - 1.0)) : 0;
    const bool up = rate > 0;
    a.left = rate == 0 ? 0 : up ? groups - 1 - at : at;
    a.apart = std::abs(1 / rate);
    a.first = ((up ? at + 1 : at) - from) / rate;
    a.leave = a.left > 0 ? a.first : infinity;
    a.stride = up ? static_cast<std::ptrdiff_t>(stride) : -static_cast<std::ptrdiff_t>(stride);
    index_ += static_cast<std::size_t>(at) * stride;
    stride *= static_cast<std::size_t>(groups);
  }
}

bool KindWalk::next(KindSegment& out) {
  if (!(t_ < end_)) return false;
  const MajorantGrid::Kinds kinds = grid_.kinds(level_);
  out = {t_, t_, kinds.at(index_, scratch_)};
  std::size_t begin = index_;
  // What changes from group to group stays in registers.
  Axis x = axes_[0], y = axes_[1], z = axes_[2];
  std::size_t index = index_;
  double t = t_;
  const auto cross = [&](Axis& a) {
    t = a.leave;
    index += static_cast<std::size_t>(a.stride);
    a.crossed += 1;
    a.leave = --a.left > 0 ? a.first + a.crossed * a.apart : infinity;
  };
  for (;;) {
    if (x.leave < y.leave) {
      if (x.leave < z.leave)
        cross(x);
      else
        cross(z);
    } else if (y.leave < z.leave) {
      cross(y);
    } else {
      cross(z);
    }
    if (!(t < end_)) break;
    const CellKind kind = kinds.at(index, scratch_);
    if (kind == out.kind && (kind != CellKind::uniform || grid_.same_values(level_, begin, index, scratch_)))
      continue;
    if (t > out.t0) break;
    out.kind = kind;  // nothing of the one before
    begin = index;
  }
  index_ = index;
  axes_ = {x, y, z};
  out.t1 = t_ = std::min(t, end_);
  return true;
}

}  // namespace tyndall::compile
