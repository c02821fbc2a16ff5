// What shapes are asked, in double and in their own space. Directions need not have unit length: t is the
// caller's.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/interval.h"
#include "base/numerics.h"
#include "base/vec.h"

namespace tyndall::shapes {

struct ShapeHit {
  double t = 0;
  Vec3d position, normal;  // outward, of any length but zero
  Pair<double> uv;
  Vec3d reach;             // what its error is measured in (compile/geometry/hit_error.h), by axis
  Vec3d shading_normal{};  // where the shape smooths its normals; zero: the same
  std::uint32_t part = 0;  // the number of the triangle or piece of a strand
  Pair<double> weights{};  // of a triangle's second and third corner
};

// Axis-aligned.
struct Bounds {
  Vec3d lo, hi;
  bool operator==(const Bounds&) const = default;
};
// The box around two points with as much room on each side of both.
Bounds around(const Vec3d& a, const Vec3d& b, const Vec3d& room);

// Holds a shape whichever way it turns.
struct Ball {
  Vec3d center;
  double radius = 0;
};

// Drawn on a surface; the normal is unit and outward.
struct SurfacePoint {
  Vec3d position, normal;
};

using Triangle = std::array<Vec3d, 3>;  // counter-clockwise seen from its front

// What follows is for the shapes themselves.

// The crossing of an interval's ends that lies in (t_min, t_max), the nearer one first; negative when none
// does.
inline double first_crossing(const Intervald& i, double t_min, double t_max) {
  if (i.empty()) return -1;
  if (i.lo > t_min) return i.lo < t_max ? i.lo : -1;
  return i.hi > t_min && i.hi < t_max ? i.hi : -1;
}

// Whether an end of an interval, or of several, lies in (t_min, t_max).
inline bool crosses(const Intervald& i, double t_min, double t_max) {
  return first_crossing(i, t_min, t_max) >= 0;
}
template <std::size_t N>
bool crosses(const std::array<Intervald, N>& intervals, double t_min, double t_max) {
  for (const Intervald& i : intervals)
    if (crosses(i, t_min, t_max)) return true;
  return false;
}

// Where a line passes between the planes z = 0 and z = height; empty for one that runs beside them.
inline Intervald between_planes(double z, double slope, double height) {
  if (slope == 0) return z < 0 || z >= height ? Intervald{} : Intervald{-infinity, infinity};
  const double t0 = -z / slope, t1 = (height - z) / slope;
  return {std::min(t0, t1), std::max(t0, t1)};
}

// Coordinates across a disk, 0.5 at its centre.
Pair<double> disk_uv(const Vec3d& unit_normal, const Vec3d& from_center, double radius);
// Half the sides of the box around a disk.
Vec3d disk_extent(const Vec3d& normal, double radius);
// Even over a disk of radius 1.
Pair<double> disk_point(double u0, double u1);
// The angle of a direction about a frame's z axis, 0 to 1.
double turn_about(const Vec3d& x, const Vec3d& y, const Vec3d& direction);

inline Vec3d absolute(const Vec3d& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }
// The larger of both by axis, without signs.
inline Vec3d larger(const Vec3d& a, const Vec3d& b) {
  return {std::max(std::abs(a.x), std::abs(b.x)), std::max(std::abs(a.y), std::abs(b.y)),
          std::max(std::abs(a.z), std::abs(b.z))};
}
// Of a round cone or rod between two places.
Vec3d rod_reach(const Vec3d& from, const Vec3d& to, double radius);

}  // namespace tyndall::shapes
