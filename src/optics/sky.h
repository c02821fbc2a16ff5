// The picture of an environment: what it shows in a direction, and directions drawn in proportion to it.
#pragma once

#include <vector>

#include "base/plane.h"
#include "base/transform.h"
#include "base/vec.h"

namespace tyndall::optics {

// One radiance for all directions, or that times a picture of them.
struct SkyRadiance {
  Rgb color;
  ColorPlanes picture{};  // none: the colour alone
  bool operator==(const SkyRadiance&) const = default;
};

// The radiance in a unit direction (from the scene outwards). In the picture longitude runs across and
// latitude up; its middle is -z of its own space, its top +y. Negative values count as 0.
Rgb sky_radiance(const SkyRadiance& radiance, const Transform& world_from_picture, const Vec3d& direction);

// Densities over directions, piecewise constant per solid angle over cells of the picture: a cell is drawn in
// proportion to the integral of the radiance (mean of the channels) over it.
class Sky {
 public:
  // There must be a picture.
  Sky(const SkyRadiance& radiance, const Transform& world_from_picture);

  // Whether one that is made of these would be the same.
  bool is_of(const SkyRadiance& radiance, const Transform& world_from_picture) const {
    return radiance_ == radiance && world_from_picture_ == world_from_picture;
  }
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

  SkyRadiance radiance_;
  Transform world_from_picture_;
  int width_, height_, block_, columns_, rows_;
  std::vector<float> sums_of_rows_;  // running integrals within each row: columns + 1 a row, from 0
  std::vector<double> sums_;         // running integrals over rows: rows + 1, from 0
  double total_ = 0;
};

}  // namespace tyndall::optics
