#include "shapes/disk.h"

#include "base/numerics.h"

namespace tyndall::shapes {

std::optional<ShapeHit> Disk::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                  double t_max) const {
  const double t = dot(normal, center - origin) / dot(normal, direction);
  if (!(t > t_min && t < t_max)) return std::nullopt;
  const Vec3d n = normalize(normal), off = origin + direction * t - center;
  const Vec3d from_center = off - n * dot(n, off);
  if (!(length_squared(from_center) <= sqr(radius))) return std::nullopt;
  return ShapeHit{t, center + from_center, n, disk_uv(n, from_center, radius),
                  absolute(center) + Vec3d(radius)};
}

Bounds Disk::bounds() const { return around(center, center, disk_extent(normal, radius)); }
Bounds Disk::turned_bounds() const { return around(center, center, Vec3d(radius)); }
Ball Disk::ball() const { return {center, radius}; }
double Disk::area() const { return pi * sqr(radius); }

SurfacePoint Disk::sample(double u0, double u1) const {
  const Vec3d n = normalize(normal);
  const auto frame = Frame<double>::around(n);
  const auto [x, y] = disk_point(u0, u1);
  return {center + frame.x * (x * radius) + frame.y * (y * radius), n};
}

}  // namespace tyndall::shapes
