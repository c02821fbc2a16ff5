// Where media emit, roughly: directions towards fire, drawn as lights are (Simon et al., "Line Integration
// for Rendering Heterogeneous Emissive Volumes", EGSR 2017, section 4.2).
//
// A direction is drawn through a point of a medium, in proportion to the emission there; its density is that
// of all points on its line, so no factor 1/r² is left in what comes along it. How rough the grids are costs
// noise and never light: what they do not know of is met by rays that go on by themselves.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::render {

// Emission of one volume, even in each cell.
struct EmissionGrid {
  Vec3d lo, cell;              // render space [m]
  std::array<int, 3> count{};  // cells along each axis
  std::vector<float> density;  // probability of a point of each cell [1/m³]
  std::vector<double> before;  // probability of all cells before each
  Vec3d middle(int i) const;   // of cell i
  double power = 0;            // integral of emission [W/sr]
  Vec3d center;                // of the emission
  double radius_squared = 0;   // its mean squared distance from there [m²]
};

class EmissionGrids {
 public:
  // Looks into all volumes whose media emit, at the middle of the shutter; null when none of them shines.
  static std::unique_ptr<const EmissionGrids> of(const compile::CompiledScene& world);
  explicit EmissionGrids(std::vector<EmissionGrid> grids) : grids_(std::move(grids)) {}

  struct Direction {
    Vec3d direction;
    double pdf = 0;  // [1/sr]
  };
  // For four numbers in [0, 1): a volume and a cell of it, and three for the point.
  std::optional<Direction> sample(const Vec3d& x, float u_cell, float u0, float u1, float u2) const;
  // Density of this direction at x [1/sr].
  double pdf(const Vec3d& x, const Vec3d& direction) const;

 private:
  // Chance of a grid, times what is common to all.
  static double weight(const EmissionGrid& grid, const Vec3d& x);
  double total_weight(const Vec3d& x) const;

  std::vector<EmissionGrid> grids_;
};

}  // namespace tyndall::render
