#include "optics/light_sampling.h"

#include <algorithm>
#include <cmath>

namespace tyndall::optics {

ReachedParts reached_in_front(const Vec3d& center, const Vec3d& normal, const Vec3d& origin,
                              const Vec3d& direction, double t_max) {
  ReachedParts reached = whole_ray(t_max);
  const double at_origin = dot(normal, origin - center), slope = dot(normal, direction);
  if (slope == 0) {
    reached.count = at_origin > 0 ? 1 : 0;
    return reached;
  }
  const double crossing = -at_origin / slope;
  Intervald& part = reached.parts[0];
  part = part.clipped_to(slope > 0 ? Intervald{crossing, t_max} : Intervald{0, crossing});
  reached.count = part.empty() ? 0 : 1;
  return reached;
}

double nearest_irradiance(double intensity, double radius, const Vec3d& y, const RaySegment& s) {
  const double t = std::clamp(dot(y - s.origin, s.direction), s.t0, std::max(s.t0, s.t1));
  const double d2 = length_squared(y - (s.origin + s.direction * t));
  // Light from a nearby point arrives along a segment of the ray: its integral grows like 1/D, not 1/D².
  const double d = std::sqrt(std::max(d2, sqr(radius)));
  const double interval = std::max(s.t1 - s.t0, 0.0);
  return d > 0 ? intensity / (d * (d + interval)) : intensity;
}

Vec3d sample_cone(const Vec3d& axis, double m_max, float u0, float u1) {
  const double m = u0 * m_max, sin_theta = safe_sqrt(m * (2 - m)), phi = 2 * pi * u1;
  return Frame<double>::around(axis).world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1 - m});
}

}  // namespace tyndall::optics
