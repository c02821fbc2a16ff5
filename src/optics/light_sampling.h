// What sampling a light gives, seen from a point in the scene, and what several lights are sampled with.
//
// Joint strategies choose the light's point y before the point on the ray (transport §3), so sampling is in
// two steps: a pivot on the light, then a direction from x towards it. The lights themselves: compile/lights.
#pragma once

#include "base/interval.h"
#include "base/numerics.h"
#include "base/vec.h"
#include "optics/light_bounds.h"

namespace tyndall::optics {

// What arrives at a point x from one sampled direction.
struct LightSample {
  Vec3d direction;             // unit, from x to the light
  double distance = 0;         // to the light along it; infinity for lights at infinity
  Rgb radiance_over_pdf;       // radiance / pdf_solid_angle; for lights of no extent: intensity / distance²
  double pdf_solid_angle = 0;  // of `direction`; 0 for lights of no extent (point, distant with angle 0)
};

// The point about which equi-angular sampling turns; with the unit normal there where light is drawn by area.
struct Pivot {
  Vec3d position, normal{};
};

// The parts of a ray (origin, unit direction, [0, t_max)) that the light's surface can shine on: the front
// side of a quad or disk, the outside of a sphere, the cone of a spot. At most two, in order.
struct ReachedParts {
  Intervald parts[2];
  int count = 0;
};
inline ReachedParts whole_ray(double t_max) { return {{Intervald{0, t_max}, {}}, 1}; }
// The part of the ray on the side of a plane to which `normal` (of any length) points.
ReachedParts reached_in_front(const Vec3d& center, const Vec3d& normal, const Vec3d& origin,
                              const Vec3d& direction, double t_max);

inline double mean(const Rgb& c) { return (double{c.x} + c.y + c.z) / 3; }

// A rough measure of what a light of mean intensity I [W/sr] at y, of this radius, sends to the segment: its
// irradiance at the nearest approach.
double nearest_irradiance(double intensity, double radius, const Vec3d& y, const RaySegment& segment);

// 1 - cos of a cone's half angle from the squared sine: stable for narrow cones.
inline double one_minus_cos_of(double sin_squared) { return sin_squared / (1 + safe_sqrt(1 - sin_squared)); }
// Of the cone around an axis whose 1 - cos is m_max.
inline double cone_solid_angle(double m_max) { return 2 * pi * m_max; }
// A unit direction within it, uniform in solid angle.
Vec3d sample_cone(const Vec3d& axis, double m_max, float u0, float u1);

}  // namespace tyndall::optics
