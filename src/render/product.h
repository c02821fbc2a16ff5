// Product sampling of the distance to a light (transport §3, "Product"): cells of a marched ray, weighted by
// all that a march knows of the light scattered there, equi-angular inside.
#pragma once

#include <cstdint>
#include <vector>

#include "base/interval.h"
#include "render/equiangular.h"
#include "render/march.h"

namespace tyndall::render {

// One ray and one pivot; reused, with its memory, for the next.
class Product {
 public:
  // `stretches`: the parts of the march that scatter and that the light reaches, in order, each within one
  // region. `phase` is that of a typical segment. The weight of a cell is rough where it may be (fast angles,
  // a mean extinction towards the light); the density stated is exact.
  void set(const March& march, const Rgb& throughput, const Vec3d& pivot,
           const std::vector<Intervald>& stretches, const PhaseMixture& phase);

  // False when nothing is to be drawn from, or when the pivot lies on the ray.
  bool available() const { return total_ > 0; }
  // The distance for u in [0, 1).
  double sample(double u) const;
  // Density per metre at t.
  double pdf(double t) const;

 private:
  struct Cell {
    Intervald t;
    double brightness;  // sigma_s T, in luminance of what the path carries
    double before = 0;  // sum of the weights of the cells before
  };
  void add_segment(const March& march, const Rgb& throughput, std::uint32_t segment, const Intervald& part);
  void weigh(double sigma_t, const PhaseMixture& phase);
  double weight(std::size_t i) const {
    return (i + 1 < cells_.size() ? cells_[i + 1].before : total_) - cells_[i].before;
  }

  EquiangularLine line_;
  std::vector<Cell> cells_;
  std::vector<double> cuts_;
  double total_ = 0;
};

}  // namespace tyndall::render
