#include "shapes/plane.h"

#include "base/numerics.h"

namespace tyndall::shapes {

// uv is in metres, from `point`.
std::optional<ShapeHit> Plane::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                   double t_max) const {
  const double slope = dot(normal, direction);
  const double t = dot(normal, point - origin) / slope;
  if (!(t > t_min && t < t_max)) return std::nullopt;  // also a parallel ray, whose t is infinite or NaN
  const Vec3d n = normalize(normal);
  const Vec3d hit_point = origin + direction * t, position = hit_point - n * dot(n, hit_point - point);
  const Frame<double> frame = Frame<double>::around(n);
  const Pair<double> uv{dot(frame.x, position - point), dot(frame.y, position - point)};
  return ShapeHit{t, position, normal, uv, absolute(point) + absolute(position)};
}

// A metre of it about its point: how it moves is seen by that.
Ball Plane::ball() const { return {point, 1}; }

}  // namespace tyndall::shapes
