#include "render/distance/equiangular.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {

EquiangularLine::EquiangularLine(const Vec3d& origin, const Vec3d& direction, const Vec3d& pivot)
    : delta_(dot(pivot - origin, direction)), distance_(length(pivot - origin - direction * delta_)) {
  if (sqr(distance_) == 0) distance_ = 0;  // below 1e-154 m the limit form is exact
}

double EquiangularLine::weight(const Intervald& interval) const {
  const double a = interval.lo - delta_, b = interval.hi - delta_;
  if (distance_ > 0) return std::atan2(distance_ * (b - a), sqr(distance_) + a * b) / distance_;
  return a * b > 0 ? (b - a) / (a * b) : infinity;
}

double EquiangularLine::sample(const Intervald& interval, double part) const {
  const double a = interval.lo - delta_, b = interval.hi - delta_;
  double t = 0;  // relative to delta
  if (distance_ > 0) {
    const double s = std::tan(part * weight(interval) * distance_);
    t = distance_ * (a + distance_ * s) / (distance_ - a * s);
  } else {
    t = a * b / (b - part * (b - a));
  }
  return std::clamp(delta_ + std::clamp(t, a, b), interval.lo, interval.hi);
}

Equiangular::Equiangular(const Vec3d& origin, const Vec3d& direction, const Vec3d& pivot,
                         const std::vector<Intervald>& intervals)
    : intervals_(intervals), line_(origin, direction, pivot) {
  for (const Intervald& interval : intervals_) {
    const double w = line_.weight(interval);
    if (!(w < infinity)) {
      total_ = 0;
      return;
    }
    total_ += w;
  }
}

double Equiangular::sample(double u) const {
  double rest = u * total_;
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    const double w = line_.weight(intervals_[i]);
    if (rest >= w && i + 1 < intervals_.size()) {
      rest -= w;
      continue;
    }
    return line_.sample(intervals_[i], std::min(rest / w, 1.0));
  }
  return 0;  // no intervals: not available
}

double Equiangular::pdf(double t) const {
  if (!available()) return 0;
  const bool inside = std::any_of(intervals_.begin(), intervals_.end(),
                                  [t](const Intervald& s) { return s.lo <= t && t <= s.hi; });
  return inside ? line_.falloff(t) / total_ : 0.0;
}

double Equiangular::cdf(double t) const {
  if (!available()) return 0;
  double sum = 0;
  for (const Intervald& interval : intervals_) {
    const Intervald part = interval.clipped_to({-infinity, t});
    if (!part.empty()) sum += line_.weight(part);
  }
  return std::min(sum / total_, 1.0);
}

}  // namespace tyndall::render
