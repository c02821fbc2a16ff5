#include "compile/shape_queries.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "base/overloaded.h"
#include "compile/hit_error.h"

namespace tyndall::compile {

namespace {

// Both crossings of a sphere, or an empty interval. From the point of closest approach, which keeps digits
// for far and for small spheres (Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray
// Tracing Gems 2019).
Intervald crossings(const scene::Sphere& s, const Vec3d& origin, const Vec3d& direction) {
  const double d2 = length_squared(direction);
  const Vec3d to = s.center - origin;
  const double along = dot(to, direction) / d2;
  const double half2 = (sqr(s.radius) - length_squared(to - direction * along)) / d2;
  if (!(half2 > 0)) return {};
  const double half = std::sqrt(half2);
  // The nearer crossing to the origin comes from the product of both, without cancellation.
  const double product = (length_squared(to) - sqr(s.radius)) / d2;
  if (along >= 0) return {product / (along + half), along + half};
  return {along - half, product / (along - half)};
}

// Where the line passes between the two faces of a box across an axis that it does not run along.
Intervald between_faces(const scene::Box& b, const Vec3d& origin, const Vec3d& direction, int axis) {
  const double t0 = (b.min[axis] - origin[axis]) / direction[axis],
               t1 = (b.max[axis] - origin[axis]) / direction[axis];
  return {std::min(t0, t1), std::max(t0, t1)};
}

// Both crossings of a box by slabs, without branches that are hard to foretell.
Intervald crossings(const scene::Box& b, const Vec3d& origin, const Vec3d& direction) {
  Intervald inside{-infinity, infinity};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < b.min[axis] || origin[axis] >= b.max[axis]) return {};
      continue;
    }
    const Intervald slab = between_faces(b, origin, direction, axis);
    inside.lo = std::max(inside.lo, slab.lo);
    inside.hi = std::min(inside.hi, slab.hi);
  }
  return inside;
}

// Both crossings of a cylinder with its flat ends; `entry_end`, `exit_end` tell whether they are on an end.
struct CylinderCrossings {
  Intervald inside;
  bool entry_end = false, exit_end = false;
  Vec3d axis;         // unit, from `from` to `to`
  double height = 0;  // the distance of the ends
};
CylinderCrossings crossings(const scene::Cylinder& c, const Vec3d& origin, const Vec3d& direction) {
  CylinderCrossings out;
  out.height = length(c.to - c.from);
  out.axis = (c.to - c.from) / out.height;
  const Frame<double> frame = Frame<double>::around(out.axis);
  const Vec3d o = frame.local(origin - c.from), d = frame.local(direction);
  out.inside = {-infinity, infinity};
  if (d.z == 0) {
    if (o.z < 0 || o.z >= out.height) return {};
  } else {
    const double t0 = -o.z / d.z, t1 = (out.height - o.z) / d.z;
    out.inside = {std::min(t0, t1), std::max(t0, t1)};
    out.entry_end = out.exit_end = true;
  }
  // The round side is a sphere's equation in the plane across the axis.
  const Intervald side = crossings(scene::Sphere{{0, 0, 0}, c.radius}, {o.x, o.y, 0}, {d.x, d.y, 0});
  if (d.x == 0 && d.y == 0) {
    if (o.x * o.x + o.y * o.y < sqr(c.radius)) return out;
    return {};
  }
  if (side.lo > out.inside.lo) out.inside.lo = side.lo, out.entry_end = false;
  if (side.hi < out.inside.hi) out.inside.hi = side.hi, out.exit_end = false;
  if (side.empty()) out.inside = {};
  return out;
}

// The crossing of an interval's ends that lies in (t_min, t_max), the nearer one first; negative when none
// does.
double first_crossing(const Intervald& i, double t_min, double t_max) {
  if (i.empty()) return -1;
  if (i.lo > t_min) return i.lo < t_max ? i.lo : -1;
  return i.hi > t_min && i.hi < t_max ? i.hi : -1;
}

std::optional<ShapeHit> hit(const scene::Sphere& s, const Vec3d& origin, const Vec3d& direction, double t_min,
                            double t_max) {
  const double t = first_crossing(crossings(s, origin, direction), t_min, t_max);
  if (t < 0) return std::nullopt;
  const Vec3d normal = normalize(origin + direction * t - s.center);
  const Pair<double> uv{0.5 + std::atan2(normal.x, normal.z) / (2 * pi),
                        0.5 + std::asin(std::clamp(normal.y, -1.0, 1.0)) / pi};
  return ShapeHit{t, s.center + normal * s.radius, normal, uv, reach(s)};
}

std::optional<ShapeHit> hit(const scene::Box& b, const Vec3d& origin, const Vec3d& direction, double t_min,
                            double t_max) {
  const Intervald i = crossings(b, origin, direction);
  const double t = first_crossing(i, t_min, t_max);
  if (t < 0) return std::nullopt;
  const bool entering = t == i.lo;
  // Through the first face that lies there.
  int axis = 0;
  for (; axis < 2; ++axis) {
    if (direction[axis] == 0) continue;
    const Intervald slab = between_faces(b, origin, direction, axis);
    if ((entering ? slab.lo : slab.hi) == t) break;
  }
  const bool at_max = (direction[axis] > 0) != entering;
  Vec3d position = origin + direction * t, normal;
  position[axis] = at_max ? b.max[axis] : b.min[axis];
  normal[axis] = at_max ? 1 : -1;
  const int a = (axis + 1) % 3, c = (axis + 2) % 3;
  const Vec3d size = b.max - b.min;
  const Pair<double> uv{(position[a] - b.min[a]) / size[a], (position[c] - b.min[c]) / size[c]};
  return ShapeHit{t, position, normal, uv, reach(b)};
}

std::optional<ShapeHit> hit(const scene::Plane& p, const Vec3d& origin, const Vec3d& direction, double t_min,
                            double t_max) {
  const double slope = dot(p.normal, direction);
  const double t = dot(p.normal, p.point - origin) / slope;
  if (!(t > t_min && t < t_max)) return std::nullopt;  // also a parallel ray, whose t is infinite or NaN
  const Vec3d normal = normalize(p.normal);
  const Vec3d met = origin + direction * t, position = met - normal * dot(normal, met - p.point);
  const Frame<double> frame = Frame<double>::around(normal);
  const Pair<double> uv{dot(frame.x, position - p.point), dot(frame.y, position - p.point)};
  return ShapeHit{t, position, p.normal, uv, reach(p, position)};
}

std::optional<ShapeHit> hit(const scene::Quad& q, const Vec3d& origin, const Vec3d& direction, double t_min,
                            double t_max) {
  const Vec3d normal = cross(q.u, q.v);
  const double t = dot(normal, q.center - origin) / dot(normal, direction);
  if (!(t > t_min && t < t_max)) return std::nullopt;
  // Coordinates along u and v from the dual basis: u and v need not be perpendicular.
  const Vec3d from_center = origin + direction * t - q.center;
  const double n2 = length_squared(normal);
  const double a = dot(cross(from_center, q.v), normal) / n2, b = dot(cross(q.u, from_center), normal) / n2;
  if (!(std::abs(a) <= 1 && std::abs(b) <= 1)) return std::nullopt;
  return ShapeHit{t, q.center + q.u * a + q.v * b, normal, {(a + 1) / 2, (b + 1) / 2}, reach(q)};
}

// Coordinates across a disk, 0.5 in its middle.
Pair<double> disk_uv(const Vec3d& unit_normal, const Vec3d& from_center, double radius) {
  const Frame<double> frame = Frame<double>::around(unit_normal);
  return {0.5 + dot(frame.x, from_center) / (2 * radius), 0.5 + dot(frame.y, from_center) / (2 * radius)};
}

std::optional<ShapeHit> hit(const scene::Disk& k, const Vec3d& origin, const Vec3d& direction, double t_min,
                            double t_max) {
  const double t = dot(k.normal, k.center - origin) / dot(k.normal, direction);
  if (!(t > t_min && t < t_max)) return std::nullopt;
  const Vec3d normal = normalize(k.normal), off = origin + direction * t - k.center;
  const Vec3d from_center = off - normal * dot(normal, off);
  if (!(length_squared(from_center) <= sqr(k.radius))) return std::nullopt;
  return ShapeHit{t, k.center + from_center, normal, disk_uv(normal, from_center, k.radius), reach(k)};
}

// uv of the side is (angle, height), each in [0, 1]; of the ends as on a disk.
std::optional<ShapeHit> hit(const scene::Cylinder& c, const Vec3d& origin, const Vec3d& direction,
                            double t_min, double t_max) {
  const CylinderCrossings i = crossings(c, origin, direction);
  const double t = first_crossing(i.inside, t_min, t_max);
  if (t < 0) return std::nullopt;
  const bool entering = t == i.inside.lo;
  const Vec3d off = origin + direction * t - c.from;
  const double along = dot(off, i.axis);
  const Vec3d across = off - i.axis * along;
  if (entering ? i.entry_end : i.exit_end) {
    const bool at_to = (dot(direction, i.axis) > 0) != entering;
    const Vec3d normal = at_to ? i.axis : -i.axis;
    return ShapeHit{t, (at_to ? c.to : c.from) + across, normal, disk_uv(normal, across, c.radius), reach(c)};
  }
  const Vec3d normal = normalize(across);
  const Frame<double> frame = Frame<double>::around(i.axis);
  const double angle = std::atan2(dot(frame.y, normal), dot(frame.x, normal)) / (2 * pi);
  const Vec3d position = c.from + i.axis * along + normal * c.radius;
  return ShapeHit{t, position, normal, {0.5 + angle, along / i.height}, reach(c)};
}

// Meshes are asked with their trees: see mesh.h.
std::optional<ShapeHit> hit(const scene::Mesh&, const Vec3d&, const Vec3d&, double, double) {
  return std::nullopt;
}
Intervald stay(const scene::Mesh&, const Vec3d&, const Vec3d&) { return {}; }
std::optional<ShapeHit> hit(const scene::Curves&, const Vec3d&, const Vec3d&, double, double) {
  return std::nullopt;
}
Intervald stay(const scene::Curves&, const Vec3d&, const Vec3d&) { return {}; }

Intervald stay(const scene::Sphere& s, const Vec3d& origin, const Vec3d& direction) {
  return crossings(s, origin, direction);
}
Intervald stay(const scene::Box& b, const Vec3d& origin, const Vec3d& direction) {
  return crossings(b, origin, direction);
}
Intervald stay(const scene::Plane&, const Vec3d&, const Vec3d&) { return {}; }
Intervald stay(const scene::Quad&, const Vec3d&, const Vec3d&) { return {}; }
Intervald stay(const scene::Disk&, const Vec3d&, const Vec3d&) { return {}; }
Intervald stay(const scene::Cylinder& c, const Vec3d& origin, const Vec3d& direction) {
  return crossings(c, origin, direction).inside;
}

// Half the sides of the box around a disk: the extent along an axis is the radius times the sine to the
// normal.
Vec3d disk_extent(const Vec3d& normal, double radius) {
  const Vec3d n = normalize(normal);
  return {radius * safe_sqrt(1 - sqr(n.x)), radius * safe_sqrt(1 - sqr(n.y)),
          radius * safe_sqrt(1 - sqr(n.z))};
}

}  // namespace

std::optional<ShapeHit> intersect(const scene::Shape& shape, const Vec3d& origin, const Vec3d& direction,
                                  double t_max, const After& after) {
  return std::visit([&](const auto& s) { return hit(s, origin, direction, after.t, t_max); }, shape);
}

bool blocks(const scene::Shape& shape, const Vec3d& origin, const Vec3d& direction, double t_max) {
  return std::visit(
      [&](const auto& s) {
        using Shape = std::decay_t<decltype(s)>;
        // Of a closed shape where it is met tells enough: no place, normal or coordinates.
        if constexpr (std::is_same_v<Shape, scene::Sphere> || std::is_same_v<Shape, scene::Box> ||
                      std::is_same_v<Shape, scene::Cylinder>)
          return first_crossing(stay(s, origin, direction), 0, t_max) >= 0;
        else
          return hit(s, origin, direction, 0, t_max).has_value();
      },
      shape);
}

Intervald inside(const scene::Shape& shape, const Vec3d& origin, const Vec3d& direction, double t_max) {
  return std::visit([&](const auto& s) { return stay(s, origin, direction); }, shape).clipped_to({0, t_max});
}

std::optional<Bounds> bounds(const scene::Shape& shape) {
  return std::visit(Overloaded{[](const scene::Sphere& s) -> std::optional<Bounds> {
                                 return Bounds{s.center - Vec3d(s.radius), s.center + Vec3d(s.radius)};
                               },
                               [](const scene::Box& b) -> std::optional<Bounds> {
                                 return Bounds{b.min, b.max};
                               },
                               [](const scene::Plane&) -> std::optional<Bounds> { return std::nullopt; },
                               [](const scene::Mesh&) -> std::optional<Bounds> { return std::nullopt; },
                               [](const scene::Curves&) -> std::optional<Bounds> { return std::nullopt; },
                               [](const scene::Quad& q) -> std::optional<Bounds> {
                                 const Vec3d extent{std::abs(q.u.x) + std::abs(q.v.x),
                                                    std::abs(q.u.y) + std::abs(q.v.y),
                                                    std::abs(q.u.z) + std::abs(q.v.z)};
                                 return Bounds{q.center - extent, q.center + extent};
                               },
                               [](const scene::Disk& k) -> std::optional<Bounds> {
                                 const Vec3d extent = disk_extent(k.normal, k.radius);
                                 return Bounds{k.center - extent, k.center + extent};
                               },
                               [](const scene::Cylinder& c) -> std::optional<Bounds> {
                                 const Vec3d extent = disk_extent(c.to - c.from, c.radius);
                                 const Vec3d lo{std::min(c.from.x, c.to.x), std::min(c.from.y, c.to.y),
                                                std::min(c.from.z, c.to.z)};
                                 const Vec3d hi{std::max(c.from.x, c.to.x), std::max(c.from.y, c.to.y),
                                                std::max(c.from.z, c.to.z)};
                                 return Bounds{lo - extent, hi + extent};
                               }},
                    shape);
}

}  // namespace tyndall::compile
