// Where a light is, how strong, and which way it shines: what choosing among many of them goes by.
//
// Nodes of a light tree after Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting" (HPG 2018); here the receiver is a stretch of a ray, of which a point is the shortest.
#pragma once

#include <optional>

#include "base/vec.h"
#include "optics/lights.h"

namespace tyndall::optics {

// Normals lie within theta_o of the axis; light leaves within theta_e of the normals. Angles in [0, pi].
struct LightBounds {
  Vec3d lo, hi;         // box around the places
  Vec3d axis{0, 0, 1};  // unit
  double theta_o = 0, theta_e = 0;
  double intensity = 0;  // greatest mean intensity in any direction, summed [W/sr]

  Vec3d center() const { return (lo + hi) * 0.5; }
};

// Nothing for lights at infinity and black ones.
std::optional<LightBounds> bounds_of(const Light& light);
// The bounds of both together.
LightBounds united(const LightBounds& a, const LightBounds& b);

// A stretch of a ray (unit direction), or a point of it: t0 = t1.
struct Stretch {
  Vec3d origin, direction;
  double t0 = 0, t1 = 0;
};

// How much the lights within the bounds may bring to the stretch, in the measure of optics::importance. 0
// only where they cannot reach it at all.
double importance(const LightBounds& bounds, const Stretch& stretch);

}  // namespace tyndall::optics
