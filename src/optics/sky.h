// The picture of an environment: what it shows in a direction, and directions drawn in proportion to it.
#pragma once

#include <vector>

#include "base/vec.h"
#include "optics/lights.h"

namespace tyndall::optics {

// The environment's radiance in a unit direction (from the scene outwards). In the picture longitude runs
// across and latitude up; its middle is -z of the sky's own space, its top +y. Negative values count as 0.
Rgb sky_radiance(const EnvironmentLight& light, const Vec3d& direction);

// Densities over directions, piecewise constant per solid angle over cells of the picture: a cell is drawn in
// proportion to the integral of the radiance (mean of the channels) over it.
class Sky {
 public:
  // The light must have a picture.
  explicit Sky(const EnvironmentLight& light);

  // Integral of the mean radiance over all directions [W/m²]; 0 when the picture is black.
  double total() const { return total_; }
  struct Drawn {
    Vec3d direction;
    double pdf_solid_angle = 0;
  };
  // Only when total() > 0.
  Drawn sample(float u0, float u1) const;
  double pdf(const Vec3d& direction) const;

 private:
  // Cells are blocks of so many texels, so that the tables stay small beside the picture.
  double longitude(int column) const;   // of a column's left end
  double sine_latitude(int row) const;  // of a row's lower end
  double cell_solid_angle(int column, int row) const;
  double cell_mass(int column, int row) const;

  Transform world_from_sky_, sky_from_world_;
  int width_, height_, block_, columns_, rows_;
  std::vector<float> sums_of_rows_;  // running integrals within each row: columns + 1 a row, from 0
  std::vector<double> sums_;         // running integrals over rows: rows + 1, from 0
  double total_ = 0;
};

}  // namespace tyndall::optics
