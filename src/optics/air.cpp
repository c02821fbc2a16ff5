#include "optics/air.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "base/observer.h"
#include "optics/atmosphere.h"

namespace tyndall::optics {

namespace {

// From 360 nm on, each for 10 nm: the sun's spectrum outside of the atmosphere (ASTM G-173) [W/m²/nm], and
// the cross section of ozone at 233 K (Serdyuchenko et al. 2011) [m²]. As in Bruneton's published
// implementation.
constexpr int table_step_nm = 10;
constexpr std::array<double, 48> solar_irradiance = {
    1.11776, 1.14259, 1.01249, 1.14716, 1.72765, 1.73054, 1.6887,  1.61253, 1.91198, 2.03474,
    2.02042, 2.02212, 1.93377, 1.95809, 1.91686, 1.8298,  1.8685,  1.8931,  1.85149, 1.8504,
    1.8341,  1.8345,  1.8147,  1.78158, 1.7533,  1.6965,  1.68194, 1.64654, 1.6048,  1.52143,
    1.55622, 1.5113,  1.474,   1.4482,  1.41018, 1.36775, 1.34188, 1.31429, 1.28303, 1.26758,
    1.2367,  1.2082,  1.18737, 1.14683, 1.12362, 1.1058,  1.07124, 1.04992};
constexpr std::array<double, 48> ozone_cross_section = {
    1.18e-27,  2.182e-28, 2.818e-28, 6.636e-28, 1.527e-27, 2.763e-27, 5.52e-27,  8.451e-27,
    1.582e-26, 2.316e-26, 3.669e-26, 4.924e-26, 7.752e-26, 9.016e-26, 1.48e-25,  1.602e-25,
    2.139e-25, 2.755e-25, 3.091e-25, 3.5e-25,   4.266e-25, 4.672e-25, 4.398e-25, 4.701e-25,
    5.019e-25, 4.305e-25, 3.74e-25,  3.215e-25, 2.662e-25, 2.238e-25, 1.852e-25, 1.473e-25,
    1.209e-25, 9.423e-26, 7.455e-26, 6.566e-26, 5.105e-26, 4.15e-26,  4.228e-26, 3.237e-26,
    2.451e-26, 2.801e-26, 2.534e-26, 1.624e-26, 1.465e-26, 2.078e-26, 1.383e-26, 7.105e-27};

constexpr double air_height_km = 8, haze_height_km = 1.2;
constexpr double haze_albedo = 0.9, haze_exponent = 1.3;
// 300 Dobson units of 2.687e20 molecules/m² in a layer that is as thick as 15 km of its densest [1/m³].
constexpr double most_ozone = 300 * 2.687e20 / 15000;

std::size_t table_entry(int nm) { return static_cast<std::size_t>((nm - shortest_nm) / table_step_nm); }

// The mean over a band of a table's two entries.
double over_band(const std::array<double, 48>& table, int band) {
  const int nm = first_band_nm + band * band_width_nm;
  return 0.5 * (table[table_entry(nm)] + table[table_entry(nm + table_step_nm)]);
}

// What the observer sees of the sun in each band [W/m²], XYZ.
std::array<Vec3d, sky_bands> sun_seen() {
  std::array<Vec3d, sky_bands> bands{};
  for (int nm = first_band_nm; nm < first_band_nm + sky_bands * band_width_nm; ++nm)
    bands[static_cast<std::size_t>((nm - first_band_nm) / band_width_nm)] +=
        observer(nm + 0.5) * solar_irradiance[table_entry(nm)];
  return bands;
}

constexpr int table_radii = 48, table_ways = 128;
const double most_way = std::sqrt(sqr(air_top_km) - sqr(earth_radius_km));

double way_to_horizon(double radius) { return std::sqrt(std::max(0.0, sqr(radius) - sqr(earth_radius_km))); }

}  // namespace

Rgb color_of_sunlight(const Spectrum& part) {
  static const std::array<Vec3d, sky_bands> seen = sun_seen();
  Vec3d xyz;
  for (std::size_t i = 0; i < seen.size(); ++i) xyz += seen[i] * double{part[i]};
  const Vec3d rgb = rec709_of_xyz(xyz);
  return Rgb(Vec3d{std::max(0.0, rgb.x), std::max(0.0, rgb.y), std::max(0.0, rgb.z)});
}

double way_to_space(double radius, double up) {
  return -radius * up + std::sqrt(std::max(0.0, sqr(radius * up) + sqr(air_top_km) - sqr(radius)));
}
double way_to_ground(double radius, double up) {
  const double square = sqr(radius * up) + sqr(earth_radius_km) - sqr(radius);
  return up < 0 && square >= 0 ? std::max(0.0, -radius * up - std::sqrt(square)) : -1;
}
double horizon(double radius) { return -way_to_horizon(radius) / radius; }

Air::Air(double turbidity) {
  const double haze_depth = std::max(0.0, 0.04608 * turbidity - 0.04586);
  for (int band = 0; band < sky_bands; ++band) {
    const double micrometres = (first_band_nm + (band + 0.5) * band_width_nm) * 1e-3;
    const auto i = static_cast<std::size_t>(band);
    rayleigh_[i] = static_cast<float>(1.24062e-3 * std::pow(micrometres, -4));
    haze_extinction_[i] =
        static_cast<float>(haze_depth * std::pow(micrometres, -haze_exponent) / haze_height_km);
    haze_[i] = static_cast<float>(haze_albedo) * haze_extinction_[i];
    ozone_[i] = static_cast<float>(most_ozone * over_band(ozone_cross_section, band) * 1e3);
  }
  table_.reserve(static_cast<std::size_t>(table_radii) * table_ways);
  for (int i = 0; i < table_radii; ++i) {
    const double to_horizon = most_way * i / (table_radii - 1);
    const double radius = std::sqrt(sqr(earth_radius_km) + sqr(to_horizon));
    for (int j = 0; j < table_ways; ++j) {
      const double least = air_top_km - radius, most = to_horizon + most_way;
      const double way = least + (most - least) * j / (table_ways - 1);
      const double up = way > 0 ? (sqr(most_way) - sqr(to_horizon) - sqr(way)) / (2 * radius * way) : 1;
      table_.push_back(integrate(radius, std::clamp(up, -1.0, 1.0)));
    }
  }
}

std::array<double, 3> Air::densities(double height) const {
  return {std::exp(-height / air_height_km), std::exp(-height / haze_height_km),
          std::max(0.0, 1 - std::fabs(height - 25) / 15)};
}

AirAt Air::at(double radius) const {
  const std::array<double, 3> density = densities(std::max(0.0, radius - earth_radius_km));
  const std::array<float, 3> d = {static_cast<float>(density[0]), static_cast<float>(density[1]),
                                  static_cast<float>(density[2])};
  AirAt result;
  for (std::size_t i = 0; i < sky_bands; ++i) {
    result.rayleigh[i] = rayleigh_[i] * d[0];
    result.haze[i] = haze_[i] * d[1];
    result.extinction[i] = result.rayleigh[i] + haze_extinction_[i] * d[1] + ozone_[i] * d[2];
  }
  return result;
}

Spectrum Air::integrate(double radius, double up) const {
  constexpr int steps = 64;
  const double way = way_to_space(radius, up);
  std::array<double, 3> depth{};
  for (int k = 0; k < steps; ++k) {
    // Segments that are short where the way begins, low in the air.
    const double begins = way * sqr(double(k) / steps), ends = way * sqr((k + 1.0) / steps);
    const double t = 0.5 * (begins + ends);
    const double height = std::sqrt(sqr(radius) + t * t + 2 * radius * up * t) - earth_radius_km;
    const std::array<double, 3> density = densities(std::max(0.0, height));
    for (std::size_t c = 0; c < 3; ++c) depth[c] += density[c] * (ends - begins);
  }
  Spectrum result;
  for (std::size_t i = 0; i < sky_bands; ++i)
    result[i] = static_cast<float>(
        std::exp(-(double{rayleigh_[i]} * depth[0] + double{haze_extinction_[i]} * depth[1] +
                   double{ozone_[i]} * depth[2])));
  return result;
}

Spectrum Air::transmittance(double radius, double up) const {
  radius = std::clamp(radius, earth_radius_km, air_top_km);
  const double to_horizon = way_to_horizon(radius), least = air_top_km - radius, most = to_horizon + most_way;
  const double x =
      std::clamp((way_to_space(radius, up) - least) / (most - least), 0.0, 1.0) * (table_ways - 1);
  const double y = to_horizon / most_way * (table_radii - 1);
  const auto j = std::min(static_cast<std::size_t>(x), std::size_t{table_ways - 2});
  const auto i = std::min(static_cast<std::size_t>(y), std::size_t{table_radii - 2});
  const auto fx = static_cast<float>(x - static_cast<double>(j)),
             fy = static_cast<float>(y - static_cast<double>(i));
  const Spectrum *low = &table_[i * table_ways + j], *high = low + table_ways;
  Spectrum result;
  for (std::size_t b = 0; b < sky_bands; ++b) {
    const float below = low[0][b] + (low[1][b] - low[0][b]) * fx;
    const float above = high[0][b] + (high[1][b] - high[0][b]) * fx;
    result[b] = below + (above - below) * fy;
  }
  return result;
}

Spectrum Air::sunlight(double radius, double up) const {
  const double edge = horizon(radius);
  // The disc in units of its radius above the horizon.
  const double height = (up - edge) / (std::sin(sun_angular_radius) * safe_sqrt(1 - edge * edge));
  if (height <= -1) return {};
  Spectrum result = transmittance(radius, std::max(up, edge));
  if (height >= 1) return result;
  const double hidden = (std::acos(height) - height * std::sqrt(1 - height * height)) / pi;
  for (float& part : result) part *= static_cast<float>(1 - hidden);
  return result;
}

}  // namespace tyndall::optics
