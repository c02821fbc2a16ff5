#include "reference/reference_shapes.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"

namespace tyndall::reference {

namespace {

// Where the line is inside the unit-free slab or ball: empty when it misses.
Intervald inside(const scene::Sphere& sphere, const LocalRay& ray) {
  const Vec3d o = ray.origin - sphere.center;
  const double a = length_squared(ray.direction), b = dot(o, ray.direction);
  // The distance of the line from the centre, without the cancellation of b² - a c.
  const Vec3d nearest = o - ray.direction * (b / a);
  const double rest = sqr(sphere.radius) - length_squared(nearest);
  if (rest <= 0) return {};
  const double half = std::sqrt(rest / a);
  return {-b / a - half, -b / a + half};
}

Intervald inside(const scene::Box& box, const LocalRay& ray) {
  Intervald all{-infinity, infinity};
  for (std::size_t i = 0; i < 3; ++i) {
    if (ray.direction[i] == 0) {
      if (ray.origin[i] < box.min[i] || ray.origin[i] >= box.max[i]) return {};
      continue;
    }
    const double t0 = (box.min[i] - ray.origin[i]) / ray.direction[i];
    const double t1 = (box.max[i] - ray.origin[i]) / ray.direction[i];
    all = all.clipped_to({std::min(t0, t1), std::max(t0, t1)});
  }
  return all.empty() ? Intervald{} : all;
}

// Between the planes of the ends, and in the round: a quadratic in the plane across the axis.
Intervald inside(const scene::Cylinder& cylinder, const LocalRay& ray) {
  const Vec3d axis = cylinder.to - cylinder.from, o = ray.origin - cylinder.from;
  const double axis2 = length_squared(axis), o_along = dot(o, axis) / axis2,
               d_along = dot(ray.direction, axis) / axis2;
  Intervald slab{-infinity, infinity};
  if (d_along != 0) {
    const double t0 = -o_along / d_along, t1 = (1 - o_along) / d_along;
    slab = {std::min(t0, t1), std::max(t0, t1)};
  } else if (o_along < 0 || o_along >= 1) {
    return {};
  }
  const Vec3d o_across = o - axis * o_along, d_across = ray.direction - axis * d_along;
  const double a = length_squared(d_across);
  if (a <= 1e-30 * length_squared(ray.direction))
    return length_squared(o_across) < sqr(cylinder.radius) ? slab : Intervald{};
  const double nearest = -dot(o_across, d_across) / a;
  const double rest = sqr(cylinder.radius) - length_squared(o_across + d_across * nearest);
  if (rest <= 0) return {};
  const double half = std::sqrt(rest / a);
  const Intervald all = slab.clipped_to({nearest - half, nearest + half});
  return all.empty() ? Intervald{} : all;
}

Vec3d normal_at(const scene::Sphere& sphere, const Vec3d& p) { return p - sphere.center; }

// The face whose plane is nearest, in units of the box.
Vec3d normal_at(const scene::Box& box, const Vec3d& p) {
  double best = infinity;
  Vec3d normal;
  for (std::size_t i = 0; i < 3; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double distance =
          std::abs(p[i] - (side < 0 ? box.min[i] : box.max[i])) / (box.max[i] - box.min[i]);
      if (distance >= best) continue;
      best = distance;
      normal = {};
      normal[i] = side;
    }
  return normal;
}

// An end or the side, whichever is nearest.
Vec3d normal_at(const scene::Cylinder& cylinder, const Vec3d& p) {
  const Vec3d axis = normalize(cylinder.to - cylinder.from);
  const double along = dot(p - cylinder.from, axis), height = length(cylinder.to - cylinder.from);
  const Vec3d across = p - cylinder.from - axis * along;
  const double to_side = std::abs(length(across) - cylinder.radius), to_low = std::abs(along),
               to_high = std::abs(height - along);
  if (to_side < to_low && to_side < to_high) return across;
  return to_low < to_high ? -axis : axis;
}

template <class Closed>
std::optional<LocalHit> hit_closed(const Closed& shape, const LocalRay& ray, double t_min, double t_max) {
  const Intervald line = inside(shape, ray);
  if (line.empty()) return {};
  for (const double t : {line.lo, line.hi})
    if (t > t_min && t < t_max) return LocalHit{t, normal_at(shape, ray.origin + ray.direction * t)};
  return {};
}

std::optional<LocalHit> hit(const scene::Sphere& s, const LocalRay& ray, double t_min, double t_max) {
  return hit_closed(s, ray, t_min, t_max);
}
std::optional<LocalHit> hit(const scene::Box& b, const LocalRay& ray, double t_min, double t_max) {
  return hit_closed(b, ray, t_min, t_max);
}
std::optional<LocalHit> hit(const scene::Cylinder& c, const LocalRay& ray, double t_min, double t_max) {
  return hit_closed(c, ray, t_min, t_max);
}
std::optional<LocalHit> hit(const scene::Plane& plane, const LocalRay& ray, double t_min, double t_max) {
  const double t = dot(plane.point - ray.origin, plane.normal) / dot(ray.direction, plane.normal);
  if (!(t > t_min && t < t_max)) return {};
  return LocalHit{t, plane.normal};
}
std::optional<LocalHit> hit(const scene::Quad& quad, const LocalRay& ray, double t_min, double t_max) {
  const Vec3d n = cross(quad.u, quad.v);
  const double t = dot(quad.center - ray.origin, n) / dot(ray.direction, n);
  if (!(t > t_min && t < t_max)) return {};
  const Vec3d d = ray.origin + ray.direction * t - quad.center;
  const double n2 = length_squared(n);
  if (std::abs(dot(cross(d, quad.v), n)) > n2 || std::abs(dot(cross(quad.u, d), n)) > n2) return {};
  return LocalHit{t, n};
}

std::optional<LocalHit> hit(const scene::Disk& disk, const LocalRay& ray, double t_min, double t_max) {
  const auto found = hit(scene::Plane{disk.center, disk.normal}, ray, t_min, t_max);
  if (!found || length_squared(ray.origin + ray.direction * found->t - disk.center) > sqr(disk.radius))
    return {};
  return found;
}

// Shapes without a formula of their own here: by the sign of their depth, looked at along the line through
// the ball around them, and halved where it changes.
template <class S>
std::optional<LocalHit> hit(const S& shape, const LocalRay& ray, double t_min, double t_max) {
  const shapes::Ball ball = shape.ball();
  const Intervald line = inside(scene::Sphere{ball.center, 1.001 * ball.radius}, ray);
  if (line.empty()) return {};
  constexpr int steps = 2000;
  const auto depth = [&](double t) { return shape.depth(ray.origin + ray.direction * t); };
  for (int i = 0; i < steps; ++i) {
    double low = lerp(line.lo, line.hi, i / double(steps)),
           high = lerp(line.lo, line.hi, (i + 1) / double(steps));
    const bool was_inside = depth(low) > 0;
    if (was_inside == (depth(high) > 0)) continue;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      ((depth(middle) > 0) == was_inside ? low : high) = middle;
    }
    if (!(low > t_min && low < t_max)) continue;
    const Vec3d p = ray.origin + ray.direction * low;
    Vec3d normal;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3d off;
      off[axis] = 1e-6 * ball.radius;
      normal[axis] = shape.depth(p - off) - shape.depth(p + off);
    }
    return LocalHit{low, normal};
  }
  return {};
}

// Scenes for the reference have no curves.
std::optional<LocalHit> hit(const scene::Curves&, const LocalRay&, double, double) {
  CHECK(false);
  return {};
}

// Every triangle, by Cramer's rule (Möller and Trumbore 1997).
std::optional<LocalHit> hit(const scene::TriangleMesh& mesh, const LocalRay& ray, double t_min,
                            double t_max) {
  std::optional<LocalHit> nearest;
  for (const auto& triangle : mesh.triangles) {
    const Vec3d &a = mesh.points[triangle[0]], e1 = mesh.points[triangle[1]] - a,
                e2 = mesh.points[triangle[2]] - a;
    const Vec3d across = cross(ray.direction, e2), from_a = ray.origin - a, other = cross(from_a, e1);
    const double determinant = dot(e1, across);
    const double u = dot(from_a, across) / determinant, v = dot(ray.direction, other) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
    const double t = dot(e2, other) / determinant;
    if (t > t_min && t < t_max) {
      nearest = LocalHit{t, cross(e1, e2)};
      t_max = t;
    }
  }
  return nearest;
}

// By the solid angle that the triangles fill, seen from p (van Oosterom and Strackee 1983): 4 pi times the
// winding.
bool contains(const scene::TriangleMesh& mesh, const Vec3d& p) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3d a = normalize(mesh.points[triangle[0]] - p), b = normalize(mesh.points[triangle[1]] - p),
                c = normalize(mesh.points[triangle[2]] - p);
    sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return std::abs(sum) > 2 * pi;
}

// The ball around a mesh, as far as rays in it are concerned.
Intervald hull(const scene::TriangleMesh& mesh, const LocalRay& ray) {
  double radius = 0;
  for (const Vec3d& p : mesh.points) radius = std::max(radius, length(p - mesh.points[0]));
  return inside(scene::Sphere{mesh.points[0], 1.001 * radius}, ray);
}

}  // namespace

Intervald interval_inside(const scene::Scene& scene, const scene::Shape& shape, const LocalRay& ray) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape)) return hull(*scene.meshes[mesh->mesh.index], ray);
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { inside(s, ray); }) {
          return inside(s, ray);
        } else {
          CHECK(s.closed);
          if constexpr (shapes::Closed<std::decay_t<decltype(s)>>)
            return inside(scene::Sphere{s.ball().center, 1.001 * s.ball().radius}, ray);
          else
            return Intervald{};
        }
      },
      shape);
}

std::optional<LocalHit> hit(const scene::Scene& scene, const scene::Shape& shape, const LocalRay& ray,
                            double t_min, double t_max) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.mesh; })
          return hit(*scene.meshes[s.mesh.index], ray, t_min, t_max);
        else
          return hit(s, ray, t_min, t_max);
      },
      shape);
}

bool contains(const scene::Scene& scene, const scene::Shape& shape, const Vec3d& p) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape)) return contains(*scene.meshes[mesh->mesh.index], p);
  if (const auto* sphere = std::get_if<scene::Sphere>(&shape))
    return length_squared(p - sphere->center) < sqr(sphere->radius);
  if (const auto* cylinder = std::get_if<scene::Cylinder>(&shape)) {
    const Vec3d axis = cylinder->to - cylinder->from, d = p - cylinder->from;
    const double along = dot(d, axis) / length_squared(axis);
    return along >= 0 && along < 1 && length_squared(d - axis * along) < sqr(cylinder->radius);
  }
  if (const auto* box = std::get_if<scene::Box>(&shape)) {
    for (std::size_t i = 0; i < 3; ++i)
      if (p[i] < box->min[i] || p[i] >= box->max[i]) return false;
    return true;
  }
  return std::visit(
      [&](const auto& s) {
        CHECK(s.closed);
        if constexpr (shapes::Closed<std::decay_t<decltype(s)>>)
          return s.depth(p) > 0;
        else
          return false;
      },
      shape);
}

}  // namespace tyndall::reference
