#include "optics/light_bounds.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "base/transform.h"

namespace tyndall::optics {

namespace {

// The angle of a cosine, however it was rounded.
double angle_of(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

// The least angle between `axis` and a direction of the arc from a to b (unit, the shorter way).
double angle_to_arc(const Vec3d& axis, const Vec3d& a, const Vec3d& b) {
  const double ends = std::min(angle_of(dot(axis, a)), angle_of(dot(axis, b)));
  const Vec3d n = cross(a, b);
  const double n2 = length_squared(n);
  if (!(n2 > 0)) return ends;
  const Vec3d in_plane = axis - n * (dot(axis, n) / n2);
  if (dot(cross(a, in_plane), n) < 0 || dot(cross(in_plane, b), n) < 0) return ends;
  return std::min(ends, angle_of(length(in_plane)));
}

}  // namespace

LightBounds bounds_around(const Vec3d& center, const Vec3d& extent, double intensity) {
  LightBounds b{center - extent, center + extent};
  b.theta_o = pi;
  b.theta_e = pi / 2;
  b.intensity = intensity;
  return b;
}

LightBounds bounds_facing(const Vec3d& center, const Vec3d& extent, double intensity, const Vec3d& normal,
                          double theta_e) {
  LightBounds b = bounds_around(center, extent, intensity);
  b.axis = normalize(normal);
  b.theta_o = 0;
  b.theta_e = theta_e;
  return b;
}

LightBounds united(const LightBounds& a, const LightBounds& b) {
  LightBounds out;
  for (std::size_t k = 0; k < 3; ++k) {
    out.lo[k] = std::min(a.lo[k], b.lo[k]);
    out.hi[k] = std::max(a.hi[k], b.hi[k]);
  }
  out.intensity = a.intensity + b.intensity;
  out.theta_e = std::max(a.theta_e, b.theta_e);
  // The smallest cone around both cones.
  const LightBounds &wide = a.theta_o >= b.theta_o ? a : b, &narrow = a.theta_o >= b.theta_o ? b : a;
  const double between = angle_of(dot(wide.axis, narrow.axis));
  out.axis = wide.axis;
  out.theta_o = wide.theta_o;
  if (std::min(between + narrow.theta_o, pi) <= wide.theta_o) return out;
  const double theta = (wide.theta_o + between + narrow.theta_o) / 2;
  const Vec3d pole = cross(wide.axis, narrow.axis);
  if (theta >= pi || !(length_squared(pole) > 0)) {
    out.theta_o = pi;
    return out;
  }
  out.axis = normalize(Transform::rotate(pole, theta - wide.theta_o).vector(wide.axis));
  // Rounding must not lose an edge of the cone.
  out.theta_o = std::min(theta + 1e-9, pi);
  return out;
}

double importance(const LightBounds& bounds, const RaySegment& s) {
  const Vec3d center = bounds.center();
  const double radius = length(bounds.hi - bounds.lo) / 2;
  const double t = std::clamp(dot(center - s.origin, s.direction), s.t0, std::max(s.t0, s.t1));
  const Vec3d nearest = s.origin + s.direction * t;
  const double d_center = length(center - nearest);
  double facing = 1;
  if (bounds.theta_o + bounds.theta_e < pi && d_center > radius) {
    // Seen from the centre the segment is an arc; from elsewhere in the box it is turned by at most so much.
    const double turned = radius > 0 ? std::asin(radius / d_center) : 0;
    const Vec3d first = s.origin + s.direction * s.t0 - center;
    const Vec3d last = s.t1 < infinity ? s.origin + s.direction * s.t1 - center : s.direction;
    const double theta =
        std::max(0.0, angle_to_arc(bounds.axis, normalize(first), normalize(last)) - bounds.theta_o - turned);
    if (theta >= bounds.theta_e + 1e-9) return 0;
    facing = std::max(std::cos(theta), 0.1);  // cones of lights wider than a half space shine sideways too
  }
  const double d = std::max(d_center, radius), interval = std::max(s.t1 - s.t0, 0.0);
  if (!(d > 0)) return bounds.intensity;
  if (!(interval < infinity)) return bounds.intensity * facing / d;
  return bounds.intensity * facing / (d * (d + interval));
}

}  // namespace tyndall::optics
