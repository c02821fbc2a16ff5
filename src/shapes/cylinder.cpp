#include "shapes/cylinder.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "shapes/sphere.h"

namespace tyndall::shapes {

namespace {

// Both crossings; `entry_end`, `exit_end` tell whether they are on a flat end.
struct CylinderCrossings {
  Intervald inside;
  bool entry_end = false, exit_end = false;
  Vec3d axis;         // unit, from `from` to `to`
  double height = 0;  // the distance of the ends
};

CylinderCrossings crossings(const Cylinder& c, const Vec3d& origin, const Vec3d& direction) {
  CylinderCrossings out;
  out.height = length(c.to - c.from);
  out.axis = (c.to - c.from) / out.height;
  const Frame<double> frame = Frame<double>::around(out.axis);
  const Vec3d o = frame.local(origin - c.from), d = frame.local(direction);
  out.inside = between_planes(o.z, d.z, out.height);
  if (out.inside.empty()) return out;
  out.entry_end = out.exit_end = d.z != 0;
  if (d.x == 0 && d.y == 0) {
    if (!(o.x * o.x + o.y * o.y < sqr(c.radius))) out.inside = {};
    return out;
  }
  // The round side is a sphere's equation in the plane across the axis.
  const Intervald side = Sphere{{0, 0, 0}, c.radius}.inside({o.x, o.y, 0}, {d.x, d.y, 0});
  if (side.lo > out.inside.lo) out.inside.lo = side.lo, out.entry_end = false;
  if (side.hi < out.inside.hi) out.inside.hi = side.hi, out.exit_end = false;
  if (side.empty()) out.inside = {};
  return out;
}

}  // namespace

Intervald Cylinder::inside(const Vec3d& origin, const Vec3d& direction) const {
  return crossings(*this, origin, direction).inside;
}

// uv of the side is (angle, height), each in [0, 1]; of the ends as on a disk.
std::optional<ShapeHit> Cylinder::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                      double t_max) const {
  const CylinderCrossings i = crossings(*this, origin, direction);
  const double t = first_crossing(i.inside, t_min, t_max);
  if (t < 0) return std::nullopt;
  const bool entering = t == i.inside.lo;
  const Vec3d off = origin + direction * t - from, reach = rod_reach(from, to, radius);
  const double along = dot(off, i.axis);
  const Vec3d across = off - i.axis * along;
  if (entering ? i.entry_end : i.exit_end) {
    const bool at_to = (dot(direction, i.axis) > 0) != entering;
    const Vec3d normal = at_to ? i.axis : -i.axis;
    return ShapeHit{t, (at_to ? to : from) + across, normal, disk_uv(normal, across, radius), reach};
  }
  const Vec3d normal = normalize(across);
  const Frame<double> frame = Frame<double>::around(i.axis);
  const Pair<double> uv{turn_about(frame.x, frame.y, normal), along / i.height};
  return ShapeHit{t, from + i.axis * along + normal * radius, normal, uv, reach};
}

double Cylinder::depth(const Vec3d& p) const {
  const double height = length(to - from);
  const Vec3d axis = (to - from) / height;
  const double along = dot(p - from, axis);
  return std::min({along, height - along, radius - length(p - from - axis * along)});
}

Bounds Cylinder::bounds() const { return around(from, to, disk_extent(to - from, radius)); }
Bounds Cylinder::turned_bounds() const { return around(from, to, Vec3d(radius)); }
Ball Cylinder::ball() const { return {(from + to) * 0.5, std::hypot(length(to - from) / 2, radius)}; }
double Cylinder::area() const { return 2 * pi * radius * (length(to - from) + radius); }

SurfacePoint Cylinder::sample(double u0, double u1) const {
  const double height = length(to - from);
  const Vec3d axis = (to - from) / height;
  const auto frame = Frame<double>::around(axis);
  const double side = height / (height + radius), end = (1 - side) / 2;  // shares of the area
  if (u0 < side) {
    const double phi = 2 * pi * u1;
    const Vec3d n = frame.x * std::cos(phi) + frame.y * std::sin(phi);
    return {from + axis * (height * (u0 / side)) + n * radius, n};
  }
  const bool at_to = u0 >= side + end;
  const double part = std::clamp((u0 - side - (at_to ? end : 0)) / end, 0.0, 1.0);
  const auto [x, y] = disk_point(part, u1);
  return {(at_to ? to : from) + frame.x * (x * radius) + frame.y * (y * radius), at_to ? axis : -axis};
}

}  // namespace tyndall::shapes
