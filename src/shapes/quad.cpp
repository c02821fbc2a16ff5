#include "shapes/quad.h"

#include <cmath>

#include "base/numerics.h"

namespace tyndall::shapes {

// uv goes along u and v, each from 0 to 1.
std::optional<ShapeHit> Quad::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                  double t_max) const {
  const Vec3d normal = cross(u, v);
  const double t = dot(normal, center - origin) / dot(normal, direction);
  if (!(t > t_min && t < t_max)) return std::nullopt;
  // Coordinates along u and v from the dual basis: u and v need not be perpendicular.
  const Vec3d from_center = origin + direction * t - center;
  const double n2 = length_squared(normal);
  const double a = dot(cross(from_center, v), normal) / n2, b = dot(cross(u, from_center), normal) / n2;
  if (!(std::abs(a) <= 1 && std::abs(b) <= 1)) return std::nullopt;
  const double u_length = length(u), v_length = length(v);
  const Vec3d reach =
      absolute(center) + Vec3d((u_length + v_length) * (u_length * v_length / length(normal)));
  return ShapeHit{t, center + u * a + v * b, normal, {(a + 1) / 2, (b + 1) / 2}, reach};
}

Bounds Quad::bounds() const {
  const Vec3d extent = absolute(u) + absolute(v);
  return {center - extent, center + extent};
}
Ball Quad::ball() const { return {center, length(u) + length(v)}; }

std::vector<Triangle> Quad::triangles() const {
  const Vec3d a = center - u - v, b = center + u - v, c = center + u + v, d = center - u + v;
  return {{a, b, c}, {a, c, d}};
}

}  // namespace tyndall::shapes
