// The error of places that go through a transform. How it comes about: compile/geometry/hit_error.h.
#pragma once

#include "base/transform.h"
#include "shapes/query.h"

namespace tyndall::shapes {

// 32 u, with u = 2^-53: four times the largest of the counts of hit_error.h, so that nothing hangs on their
// last unit.
inline constexpr double rounding = 0x1p-48;

// The longest of the image of a box of this half size, by axis.
inline Vec3d spread(const Transform& map, const Vec3d& v) {
  return absolute(map.x) * v.x + absolute(map.y) * v.y + absolute(map.z) * v.z;
}

// The error by axis of a place that is given in an inner space with its error there, in the outer space.
inline Vec3d placed_error(const Transform& outer_from_inner, const Transform& inner_from_outer,
                          const Vec3d& p_inner, const Vec3d& p_outer, const Vec3d& error_inner) {
  const Vec3d way_back = spread(inner_from_outer, absolute(p_outer)) + absolute(inner_from_outer.t);
  const Vec3d off_inverse = absolute(inner_from_outer.point(p_outer) - p_inner);
  const Vec3d way_out = spread(outer_from_inner, absolute(p_inner)) + absolute(outer_from_inner.t);
  return spread(outer_from_inner, error_inner + off_inverse + way_back * rounding) + way_out * rounding;
}

}  // namespace tyndall::shapes
