#include "compile/geometry/boxes_over_time.h"

#include <algorithm>

namespace tyndall::compile {

namespace {

// Boxes that move are met more slowly: they must be smaller by this factor, all in all.
constexpr double least_gain = 1.25;

// As often as a box is met by rays from everywhere.
double area_of(const Bounds& b) {
  const Vec3d size = b.hi - b.lo;
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

}  // namespace

Bounds united(const Bounds& a, const Bounds& b) {
  Bounds out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.lo[axis] = std::min(a.lo[axis], b.lo[axis]);
    out.hi[axis] = std::max(a.hi[axis], b.hi[axis]);
  }
  return out;
}

Bounds BoxesOverTime::around(std::uint32_t part) const {
  Bounds out = box(0, part);
  for (std::uint32_t i = 1; i < size(); ++i) out = united(out, box(i, part));
  return out;
}

Bounds BoxesOverTime::over_all_time(std::uint32_t i) const {
  Bounds out = box(i, 0);
  for (std::uint32_t k = 1; k < parts && moves(i); ++k) out = united(out, box(i, k));
  return out;
}

bool BoxesOverTime::pays_by_parts() const {
  if (!any_moves()) return false;
  double whole = 0, by_parts = 0;
  for (std::uint32_t i = 0; i < size(); ++i) {
    whole += area_of(over_all_time(i));
    const std::uint32_t count = moves(i) ? parts : 1;
    for (std::uint32_t k = 0; k < count; ++k) by_parts += area_of(box(i, k)) / count;
  }
  return whole > least_gain * by_parts;
}

BoundsTree BoxesOverTime::tree() const {
  const auto count = static_cast<std::uint32_t>(size());
  if (!pays_by_parts())
    return BoundsTree(count, 1, [&](std::uint32_t i, std::uint32_t) { return over_all_time(i); });
  // At the moment between two parts a box holds those of both, so that what goes evenly from one such moment
  // to the next holds that of the part between them.
  return BoundsTree(count, parts + 1, [&](std::uint32_t i, std::uint32_t moment) {
    return united(box(i, moment == 0 ? 0 : moment - 1), box(i, std::min(moment, parts - 1)));
  });
}

}  // namespace tyndall::compile
