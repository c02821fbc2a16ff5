// The clear sky, and the sun through it.
//
// A spherical atmosphere of air, haze and ozone in sixteen bands of wavelengths, with the numbers of
// Bruneton, "A Qualitative and Quantitative Evaluation of 8 Clear Sky Models" (TVCG 2017) and its published
// implementation: Rayleigh 1.24062e-6 l^-4 /m, scale heights 8 km and 1.2 km, ozone 300 DU, haze with an
// albedo of 0.9 and g = 0.8, the solar spectrum ASTM G-173 as averages over 10 nm. The optical depth of the
// haze follows from the turbidity: (0.04608 T - 0.04586) l^-1.3 (Preetham, Shirley, Smits, SIGGRAPH 1999).
// Light scattered once is integrated; what is scattered more often is added by the isotropic series of
// Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" (EGSR 2020).
#pragma once

#include <memory>

#include "base/plane.h"
#include "base/vec.h"

namespace tyndall::optics {

inline constexpr double least_turbidity = 1, most_turbidity = 10, usual_turbidity = 3;
// Of the sun's disc, in radians: 0.2665 degrees.
inline constexpr double sun_angular_radius = 0.2665 * 3.14159265358979323846 / 180;
// Of the ground below the horizon, which lights the sky in its turn.
inline constexpr double sky_ground_albedo = 0.2;

// Seen from the ground. Colours are linear Rec. 709; their luminance times 683 lm/W is photometric.
struct Daylight {
  ColorPlanes picture;  // radiance [W/m²/sr] as of sky_radiance: the sun stands above the middle, -z
  Rgb sun;  // irradiance of its disc on a surface that faces it [W/m²]; the picture is without it
};

// `sine`: of the sun's elevation; turbidity from least_turbidity to most_turbidity. The last few are kept.
std::shared_ptr<const Daylight> daylight(double sine, double turbidity);

// The angle about y that turns the picture's sun to that of the unit vector `sun`.
double azimuth_of_sun(const Vec3d& sun);

}  // namespace tyndall::optics
