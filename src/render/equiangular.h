// Equi-angular sampling of the distance along a ray about a pivot: density proportional to 1/(D² + (t -
// delta)²), constant in the angle seen from the pivot. Kulla and Fajardo, EGSR 2012, section 4.1; the forms
// that stay exact for every D are those of transport §3.
#pragma once

#include <optional>
#include <vector>

#include "base/interval.h"
#include "base/vec.h"

namespace tyndall::render {

// The distribution over a list of disjoint stretches of one ray.
class Equiangular {
 public:
  // `stretches` must outlive this object. Directions have unit length.
  Equiangular(const Vec3d& origin, const Vec3d& direction, const Vec3d& pivot,
              const std::vector<Intervald>& stretches);

  // False when there is no stretch, or when the pivot lies on one (the density would be infinite there).
  bool available() const { return total_ > 0; }
  // The distance for u in [0, 1).
  double sample(double u) const;
  // Density per metre at a t of a stretch; 0 when not available.
  double pdf(double t) const;

 private:
  // (angle over D) of one stretch: its limit (b - a)/(a b) where D vanishes.
  double weight(const Intervald& stretch) const;

  const std::vector<Intervald>& stretches_;
  double delta_, distance_;  // t of the point nearest the pivot, and the pivot's distance D from the line
  double total_ = 0;         // sum of the weights
};

}  // namespace tyndall::render
