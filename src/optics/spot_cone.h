// The cone of a spot light: even but for a smooth rim.
#pragma once

#include "base/vec.h"

namespace tyndall::optics {

// `axis` is unit; angles are as 1 - cos, which keeps the digits of narrow cones.
struct SpotCone {
  Vec3d axis;
  double full = 0, rim = 0;  // 1 - cos where the fading begins, and where it ends

  // `angle`: from the axis to the rim [rad]; `blend`: the part of it in which it fades.
  static SpotCone around(const Vec3d& axis, double angle, double blend);
  // The part of the intensity on the axis that leaves in a unit direction: a smooth step between `full` and
  // `rim`.
  double share(const Vec3d& direction) const;
  // The integral of `share` over all directions.
  double solid_angle() const;
};

}  // namespace tyndall::optics
