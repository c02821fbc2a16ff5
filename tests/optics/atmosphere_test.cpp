// The clear sky: its tables against integrals without them, published measurements, and how it depends on the
// sun and on the haze.
#include "optics/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/numerics.h"
#include "optics/air.h"
#include "optics/sky.h"

namespace tyndall::optics {
namespace UNNAMED {

constexpr double lumens_per_watt = 683;

double sine_of(double degrees) { return std::sin(degrees * pi / 180); }
double brightness(const Rgb& c) {
  return 0.2126 * double{c[0]} + 0.7152 * double{c[1]} + 0.0722 * double{c[2]};
}

Rgb radiance_at(const Daylight& daylight, double azimuth, double elevation) {
  const double a = azimuth * pi / 180, e = elevation * pi / 180;
  const SkyRadiance radiance{Rgb(Vec3d{1, 1, 1}), daylight.picture};
  return sky_radiance(radiance, Transform{},
                      {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)});
}

// On level ground, without the sun [lx].
double ilbrightness(const Daylight& daylight) {
  double sum = 0;
  for (double e = 0.5; e < 90; ++e)
    for (double a = 5; a < 360; a += 10)
      sum += brightness(radiance_at(daylight, a, e)) * sine_of(e) * std::cos(e * pi / 180);
  return lumens_per_watt * sum * (pi / 180) * (10 * pi / 180);
}

// The densities of the head of atmosphere.h, along straight ways in small even steps.
TEST(Atmosphere, TransmittanceIsThatOfItsLayers) {
  const double turbidity = 3, haze_depth = 0.04608 * turbidity - 0.04586;
  const Air air(turbidity);
  const auto band = std::size_t{8};  // 540 to 560 nm
  const double micrometres = 0.55, rayleigh = 1.24062e-3 * std::pow(micrometres, -4);
  const double haze = haze_depth * std::pow(micrometres, -1.3) / 1.2;
  const double ozone = 300 * 2.687e20 / 15000 * 0.5 * (3.091e-25 + 3.5e-25) * 1e3;
  for (const double height : {0.0, 0.3, 2.0, 11.0, 30.0})
    for (const double elevation : {0.2, 1.0, 4.0, 20.0, 50.0, 90.0}) {
      const double radius = earth_radius_km + height, up = sine_of(elevation);
      const double way = way_to_space(radius, up);
      constexpr int steps = 20000;
      double depth = 0;
      for (int k = 0; k < steps; ++k) {
        const double t = way * (k + 0.5) / steps;
        const double h = std::sqrt(radius * radius + t * t + 2 * radius * up * t) - earth_radius_km;
        depth += way / steps *
                 (rayleigh * std::exp(-h / 8) + haze * std::exp(-h / 1.2) +
                  ozone * std::max(0.0, 1 - std::fabs(h - 25) / 15));
      }
      EXPECT_NEAR(double{air.transmittance(radius, up)[band]}, std::exp(-depth), 0.006)
          << height << " km, " << elevation << " degrees";
    }
}

// What is measured on clear days: 100 to 110 klx from a high sun on a surface that faces it and 10 to 25 klx
// from the sky; about 400 to 1000 lx in all when the sun sets, 3.4 lx at the end of civil twilight (6 degrees
// below).
TEST(Atmosphere, GivesTheIlluminanceOfClearDays) {
  const auto high = daylight(sine_of(60), 2);
  EXPECT_NEAR(lumens_per_watt * brightness(high->sun), 105e3, 10e3);
  EXPECT_NEAR(ilbrightness(*high), 17e3, 6e3);
  const auto sunset = daylight(sine_of(-0.3), 2);
  EXPECT_GT(ilbrightness(*sunset), 400);
  EXPECT_LT(ilbrightness(*sunset), 1000);
  const auto civil = daylight(sine_of(-6), 2);
  EXPECT_GT(ilbrightness(*civil), 3.4 / 2);
  EXPECT_LT(ilbrightness(*civil), 3.4 * 2);
  EXPECT_LT(ilbrightness(*daylight(sine_of(-18), 2)), 1e-3);
}

TEST(Atmosphere, SunIsWeakerAndRedderTheLowerItStandsAndTheHazierItIs) {
  double last = 1e9, last_red = 0;
  for (const double elevation : {90.0, 40.0, 15.0, 5.0, 2.0}) {
    const Rgb sun = daylight(sine_of(elevation), 3)->sun;
    EXPECT_LT(brightness(sun), last);
    EXPECT_GT(sun[0] / brightness(sun), last_red);
    last = brightness(sun), last_red = sun[0] / brightness(sun);
  }
  EXPECT_GT(brightness(daylight(sine_of(30), 2)->sun), brightness(daylight(sine_of(30), 6)->sun));
  EXPECT_EQ(brightness(daylight(sine_of(-1), 3)->sun), 0);
}

TEST(Atmosphere, SkyIsBlueBrightestAroundTheSunAndTheSameOnBothSides) {
  const auto day = daylight(sine_of(35), 2.5);
  const Rgb zenith = radiance_at(*day, 0, 90), glow = radiance_at(*day, 3, 35);
  EXPECT_GT(zenith[2], 1.5 * zenith[0]);
  EXPECT_GT(brightness(glow), 5 * brightness(zenith));
  for (const double azimuth : {10.0, 60.0, 150.0}) {
    const Rgb right = radiance_at(*day, azimuth, 20), left = radiance_at(*day, -azimuth, 20);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(right[c], left[c], 1e-4f * right[c]);
  }
  for (const auto& plane : day->picture) EXPECT_GE(plane->lowest, 0);
}

}  // namespace UNNAMED
}  // namespace tyndall::optics
