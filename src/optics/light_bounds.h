// Where a light is, how strong, and which way it shines: what choosing among many of them goes by.
//
// Nodes of a light tree after Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting" (HPG 2018); here the receiver is a segment of a ray, of which a point is the shortest.
#pragma once

#include "base/vec.h"

namespace tyndall::optics {

// Normals lie within theta_o of the axis; light leaves within theta_e of the normals. Angles in [0, pi].
struct LightBounds {
  Vec3d lo, hi;         // box around the places
  Vec3d axis{0, 0, 1};  // unit
  double theta_o = 0, theta_e = 0;
  double intensity = 0;  // greatest mean intensity in any direction, summed [W/sr]

  Vec3d center() const { return (lo + hi) * 0.5; }
};

// Of a light that shines to all sides from within a box, and of one that shines from one side of a plane or
// within theta_e of an axis.
LightBounds bounds_around(const Vec3d& center, const Vec3d& extent, double intensity);
LightBounds bounds_facing(const Vec3d& center, const Vec3d& extent, double intensity, const Vec3d& normal,
                          double theta_e);
// The bounds of both together.
LightBounds united(const LightBounds& a, const LightBounds& b);

// A segment of a ray (unit direction), or a point of it: t0 = t1.
struct RaySegment {
  Vec3d origin, direction;
  double t0 = 0, t1 = 0;
};

// How much the lights within the bounds may bring to the segment, in the measure of the lights' own
// importance. 0 only where they cannot reach it at all.
double importance(const LightBounds& bounds, const RaySegment& segment);

}  // namespace tyndall::optics
