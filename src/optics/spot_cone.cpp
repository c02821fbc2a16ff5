#include "optics/spot_cone.h"

#include <cmath>

#include "base/numerics.h"

namespace tyndall::optics {

SpotCone SpotCone::around(const Vec3d& axis, double angle, double blend) {
  const auto one_minus_cos = [](double a) { return 2 * sqr(std::sin(a / 2)); };
  return {axis, one_minus_cos(angle * (1 - blend)), one_minus_cos(angle)};
}

double SpotCone::share(const Vec3d& direction) const {
  const double m = length_squared(direction - axis) / 2;
  if (m >= rim) return 0;
  if (m <= full) return 1;
  const double x = (rim - m) / (rim - full);
  return x * x * (3 - 2 * x);
}

// The smooth step's mean is a half: 2 pi times the mean of both ends.
double SpotCone::solid_angle() const { return pi * (full + rim); }

}  // namespace tyndall::optics
