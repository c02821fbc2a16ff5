// The layers of the atmosphere in bands of wavelengths, and how much light passes through them (internal to
// the sky).
#pragma once

#include <array>
#include <vector>

#include "base/vec.h"

namespace tyndall::optics {

// Lengths are in kilometres.
inline constexpr double earth_radius_km = 6360, air_top_km = 6420;

inline constexpr int sky_bands = 16, band_width_nm = 20, first_band_nm = 380;
// Values of the bands.
using Spectrum = std::array<float, sky_bands>;

// Seen by the observer under the sun's spectrum: linear Rec. 709 of a light that has the given part of it.
Rgb color_of_sunlight(const Spectrum& part);

// What air does to light at one height [1/km].
struct AirAt {
  Spectrum rayleigh, haze, extinction;  // haze, rayleigh: what they scatter
};

class Air {
 public:
  explicit Air(double turbidity);

  AirAt at(double radius) const;
  // Of a way to space from a place at `radius`, at the cosine `up` with the vertical: not through the earth.
  Spectrum transmittance(double radius, double up) const;
  // The same for the sun's light, in the part of its disc that is above the horizon.
  Spectrum sunlight(double radius, double up) const;

 private:
  std::array<double, 3> densities(double height) const;  // of air, haze and ozone, relative
  Spectrum integrate(double radius, double up) const;

  Spectrum rayleigh_, haze_, haze_extinction_, ozone_;
  std::vector<Spectrum> table_;  // by radius and by the length of the way to space
};

// From a place at `radius` [km], at the cosine `up`: to the top of the air, and whether the earth is met, how
// far.
double way_to_space(double radius, double up);
double way_to_ground(double radius, double up);  // below zero: it is not met
// The cosine with the vertical of the horizon.
double horizon(double radius);

}  // namespace tyndall::optics
