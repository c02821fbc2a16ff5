// The way from one transform to another.
#pragma once

#include <optional>

#include "base/transform.h"

namespace tyndall {

// A rotation, as a unit quaternion.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;
};

// The linear part of a transform, apart: a stretch, then a rotation. The stretch is symmetric, and negative
// where the transform mirrors. Shoemake and Duff, "Matrix animation and polar decomposition" (1992).
struct Pose {
  Quaternion rotation;
  Transform interval;
};
// Nothing when the transform flattens.
std::optional<Pose> pose_of(const Transform& m);

// The angle of the rotation from one to the other, the short way [rad].
double angle_between(const Quaternion& a, const Quaternion& b);

// The linear part between two poses, a at t = 0, b at t = 1: the rotation turns the short way at a steady
// rate (slerp), the stretch goes in a straight line.
class PoseMix {
 public:
  // Nothing when only one of them mirrors: there is no way that does not flatten.
  static std::optional<PoseMix> between(const Pose& a, const Pose& b);
  Transform at(double t) const;

 private:
  Pose a_, b_;
  double angle_ = 0, sine_ = 0;  // of the rotation as quaternions turn; 0 where it is straight enough
};

// a at t = 0, b at t = 1: the linear part as above, the offset in a straight line. Where one of them flattens
// or mirrors what the other does not, every number moves in a straight line.
Transform mix(const Transform& a, const Transform& b, double t);

}  // namespace tyndall
