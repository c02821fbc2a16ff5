#include "shapes/sphere.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::shapes {

// From the point of closest approach, which keeps digits for far and for small spheres (Haines et al.,
// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems 2019).
Intervald Sphere::inside(const Vec3d& origin, const Vec3d& direction) const {
  const double d2 = length_squared(direction);
  const Vec3d to = center - origin;
  const double along = dot(to, direction) / d2;
  const double half2 = (sqr(radius) - length_squared(to - direction * along)) / d2;
  if (!(half2 > 0)) return {};
  const double half = std::sqrt(half2);
  // The nearer crossing to the origin comes from the product of both, without cancellation.
  const double product = (length_squared(to) - sqr(radius)) / d2;
  if (along >= 0) return {product / (along + half), along + half};
  return {along - half, product / (along - half)};
}

// uv is (longitude, latitude), each in [0, 1]: u 0.5 towards +z, v 1 at the top.
std::optional<ShapeHit> Sphere::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                    double t_max) const {
  const double t = first_crossing(inside(origin, direction), t_min, t_max);
  if (t < 0) return std::nullopt;
  const Vec3d normal = normalize(origin + direction * t - center);
  const Pair<double> uv{0.5 + std::atan2(normal.x, normal.z) / (2 * pi),
                        0.5 + std::asin(std::clamp(normal.y, -1.0, 1.0)) / pi};
  return ShapeHit{t, center + normal * radius, normal, uv, absolute(center) + Vec3d(radius)};
}

double Sphere::depth(const Vec3d& p) const { return radius - length(p - center); }
Bounds Sphere::bounds() const { return {center - Vec3d(radius), center + Vec3d(radius)}; }
Ball Sphere::ball() const { return {center, radius}; }
double Sphere::area() const { return 4 * pi * sqr(radius); }

SurfacePoint Sphere::sample(double u0, double u1) const {
  const double z = 1 - 2 * u0, r = safe_sqrt(1 - z * z), phi = 2 * pi * u1;
  const Vec3d n{r * std::cos(phi), r * std::sin(phi), z};
  return {center + n * radius, n};
}

}  // namespace tyndall::shapes
