// Sampling the lights, seen from a point in the scene.
//
// Joint strategies choose the light's point y before the point on the ray (transport §3), so sampling is in
// two steps: a pivot on the light, then a direction from x towards it.
#pragma once

#include <optional>

#include "base/interval.h"
#include "base/vec.h"
#include "optics/lights.h"

namespace tyndall::optics {

// What arrives at a point x from one sampled direction.
struct LightSample {
  Vec3d direction;             // unit, from x to the light
  double distance = 0;         // to the light along it; infinity for lights at infinity
  Rgb radiance_over_pdf;       // radiance / pdf_solid_angle; for lights of no extent: intensity / distance²
  double pdf_solid_angle = 0;  // of `direction`; 0 for lights of no extent (point, distant with angle 0)
};

// The point about which equi-angular sampling turns; of mesh lights with the unit normal there.
struct Pivot {
  Vec3d position, normal{};
};

// True when no ray can hit the light: points, and distant lights of angle 0.
bool is_delta(const Light& light);

// Drawn on a quad, disk or mesh, the centre of a sphere, the point or spot itself. Nothing for lights without
// a place (distant, environment).
std::optional<Pivot> sample_pivot(const Light& light, float u0, float u1);
// True when the pivot is the point of the light's surface that sample_light then aims at.
bool pivot_on_surface(const Light& light);

// Draws a direction from x to the light, through the pivot where the light is flat or a point, within the
// cone of a sphere, over the disc of a distant light. Nothing when the light does not reach x (behind a quad,
// inside a sphere, outside a cone). Environments of one colour are gathered where rays end and are never
// drawn: nothing.
std::optional<LightSample> sample_light(const Light& light, const Vec3d& x, const Pivot& pivot, float u0,
                                        float u1);

// Density per solid angle with which sample_light draws, from x, a direction that meets the light at `y` (of
// its surface) with unit normal `normal`; averaged over pivots. 0 for lights of no extent.
double pdf_light(const Light& light, const Vec3d& x, const Vec3d& direction, const Vec3d& y,
                 const Vec3d& normal);

// Radiance that leaves the light's surface at normal `normal` towards -direction, for rays that hit it.
Rgb emitted(const Light& light, const Vec3d& direction, const Vec3d& normal);

// Radiance from infinity along a ray's direction: environments, and the discs of distant lights.
Rgb radiance_from_infinity(const Light& light, const Vec3d& direction);

// The parts of a ray (origin, unit direction, [0, t_max)) that the light's surface can shine on: the front
// side of a quad or disk, the outside of a sphere, the cone of a spot. At most two, in order.
struct ReachedParts {
  Intervald parts[2];
  int count = 0;
};
// Of a mesh light: the front side of its surface at the pivot.
ReachedParts reached_parts(const Light& light, const Pivot& pivot, const Vec3d& origin,
                           const Vec3d& direction, double t_max);

// A rough measure of what the light sends to the ray's stretch [t0, t1): for choosing among lights. >= 0.
double importance(const Light& light, const Vec3d& origin, const Vec3d& direction, double t0, double t1);

}  // namespace tyndall::optics
