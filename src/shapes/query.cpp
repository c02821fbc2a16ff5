#include "shapes/query.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::shapes {

Bounds around(const Vec3d& a, const Vec3d& b, const Vec3d& room) {
  const Vec3d lo{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  const Vec3d hi{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  return {lo - room, hi + room};
}

Pair<double> disk_uv(const Vec3d& unit_normal, const Vec3d& from_center, double radius) {
  const Frame<double> frame = Frame<double>::around(unit_normal);
  return {0.5 + dot(frame.x, from_center) / (2 * radius), 0.5 + dot(frame.y, from_center) / (2 * radius)};
}

// The extent along an axis is the radius times the sine to the normal.
Vec3d disk_extent(const Vec3d& normal, double radius) {
  const Vec3d n = normalize(normal);
  return {radius * safe_sqrt(1 - sqr(n.x)), radius * safe_sqrt(1 - sqr(n.y)),
          radius * safe_sqrt(1 - sqr(n.z))};
}

Pair<double> disk_point(double u0, double u1) {
  const double r = std::sqrt(u0), phi = 2 * pi * u1;
  return {r * std::cos(phi), r * std::sin(phi)};
}

double turn_about(const Vec3d& x, const Vec3d& y, const Vec3d& direction) {
  return 0.5 + std::atan2(dot(y, direction), dot(x, direction)) / (2 * pi);
}

Vec3d rod_reach(const Vec3d& from, const Vec3d& to, double radius) {
  return larger(from, to) + Vec3d(length(to - from) + radius);
}

}  // namespace tyndall::shapes
