// Equi-angular sampling of the distance along a ray about a pivot: density proportional to 1/(D² + (t -
// delta)²), constant in the angle seen from the pivot. Kulla and Fajardo, EGSR 2012, section 4.1; the forms
// that stay exact for every D are those of transport §3.
#pragma once

#include <optional>
#include <vector>

#include "base/interval.h"
#include "base/vec.h"
#include "render/distance/distance_query.h"

namespace tyndall::render {

// A ray and a pivot.
class EquiangularLine {
 public:
  EquiangularLine() = default;
  // The direction has unit length.
  EquiangularLine(const Vec3d& origin, const Vec3d& direction, const Vec3d& pivot);

  // (angle over D) of an interval: its limit (b - a)/(a b) where D vanishes, infinite with the pivot on it.
  double weight(const Intervald& interval) const;
  // The distance at this part, in [0, 1], of the interval's angle.
  double sample(const Intervald& interval, double part) const;
  // 1/(D² + (t - delta)²): density times the sum of the weights.
  double falloff(double t) const { return 1 / squared_distance(t); }
  // From the ray's point at t to the pivot.
  double squared_distance(double t) const { return distance_ * distance_ + (t - delta_) * (t - delta_); }
  double delta() const { return delta_; }
  double distance() const { return distance_; }

 private:
  double delta_ = 0, distance_ = 0;  // t of the point nearest the pivot; the pivot's distance D from the line
};

// The distribution over a list of disjoint intervals of one ray.
class Equiangular {
 public:
  // `intervals` must outlive this object. Directions have unit length.
  Equiangular(const Vec3d& origin, const Vec3d& direction, const Vec3d& pivot,
              const std::vector<Intervald>& intervals);

  // False when there is no interval, or when the pivot lies on one (the density would be infinite there).
  bool available() const { return total_ > 0; }
  // The distance for u in [0, 1).
  double sample(double u) const;
  // Density per metre; 0 outside of the intervals and when not available.
  double pdf(double t) const;
  // The probability of distances up to t; 0 when not available.
  double cdf(double t) const;

 private:
  const std::vector<Intervald>& intervals_;
  EquiangularLine line_;
  double total_ = 0;  // sum of the weights
};

// As a strategy for direct light.
class EquiangularStrategy {
 public:
  static constexpr StrategyTraits traits{.aims_at_light = true};
  bool prepare(const DistanceQuery& query) {
    equiangular_.emplace(query.march.ray.origin, query.march.ray.direction, query.pivot->position, query.lit);
    return equiangular_->available();
  }
  MarchPlace sample(const March& march, float u) const { return march.place_at(equiangular_->sample(u)); }
  double pdf(const MarchPlace& at) const { return equiangular_->pdf(at.t); }
  double cdf(const MarchPlace& at) const { return equiangular_->cdf(at.t); }

 private:
  std::optional<Equiangular> equiangular_;
};

}  // namespace tyndall::render
