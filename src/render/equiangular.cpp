#include "render/equiangular.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {

Equiangular::Equiangular(const Vec3d& origin, const Vec3d& direction, const Vec3d& pivot,
                         const std::vector<Intervald>& stretches)
    : stretches_(stretches), delta_(dot(pivot - origin, direction)) {
  distance_ = length(pivot - origin - direction * delta_);
  if (sqr(distance_) == 0) distance_ = 0;  // below 1e-154 m the limit form is exact
  for (const Intervald& stretch : stretches_) {
    const double w = weight(stretch);
    if (!(w < infinity)) {
      total_ = 0;
      return;
    }
    total_ += w;
  }
}

double Equiangular::weight(const Intervald& stretch) const {
  const double a = stretch.lo - delta_, b = stretch.hi - delta_;
  if (distance_ > 0) return std::atan2(distance_ * (b - a), sqr(distance_) + a * b) / distance_;
  return a * b > 0 ? (b - a) / (a * b) : infinity;
}

double Equiangular::sample(double u) const {
  double rest = u * total_;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const Intervald& stretch = stretches_[i];
    const double w = weight(stretch);
    if (rest >= w && i + 1 < stretches_.size()) {
      rest -= w;
      continue;
    }
    const double a = stretch.lo - delta_, b = stretch.hi - delta_, part = std::min(rest / w, 1.0);
    double t = 0;  // relative to delta
    if (distance_ > 0) {
      const double s = std::tan(part * w * distance_);
      t = distance_ * (a + distance_ * s) / (distance_ - a * s);
    } else {
      t = a * b / (b - part * (b - a));
    }
    return delta_ + std::clamp(t, a, b);
  }
  return 0;  // no stretches: not available
}

double Equiangular::pdf(double t) const {
  if (!available()) return 0;
  return 1 / (total_ * (sqr(distance_) + sqr(t - delta_)));
}

}  // namespace tyndall::render
