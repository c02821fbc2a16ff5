#include "optics/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

#include "base/check.h"
#include "base/numerics.h"
#include "base/parallel.h"
#include "optics/air.h"

namespace tyndall::optics {

namespace {

constexpr double eye_radius_km = earth_radius_km + 0.002;
constexpr double haze_g = 0.8;
constexpr auto isotropic_phase = static_cast<float>(inv_4pi);
constexpr auto ground_reflection = static_cast<float>(sky_ground_albedo / pi);

// Sunlight scattered more than once: what comes to a place on average from all directions, by its height and
// by the cosine of the sun with the vertical. Light that was scattered twice is integrated as if no direction
// were preferred, and each further scattering has the same share of the one before.
class ManyScatterings {
 public:
  explicit ManyScatterings(const Air& air) : air_(air) {
    table_.resize(static_cast<std::size_t>(radii) * suns);
    parallel_for(table_.size(), 0, [&](std::size_t i, int) {
      const double share = double(i / suns) / (radii - 1), x = 2.0 * double(i % suns) / (suns - 1) - 1;
      const double radius = earth_radius_km + 0.001 + share * share * (air_top_km - earth_radius_km - 0.002);
      table_[i] = series(radius, x * std::fabs(x));  // finer at sunset
    });
  }
  Spectrum at(double radius, double sun) const {
    const double height = std::clamp(radius - earth_radius_km, 0.0, air_top_km - earth_radius_km);
    const double y = std::sqrt(height / (air_top_km - earth_radius_km)) * (radii - 1);
    const double x =
        (std::copysign(std::sqrt(std::fabs(std::clamp(sun, -1.0, 1.0))), sun) + 1) / 2 * (suns - 1);
    const auto i = std::min(static_cast<std::size_t>(y), std::size_t{radii - 2});
    const auto j = std::min(static_cast<std::size_t>(x), std::size_t{suns - 2});
    const auto fx = static_cast<float>(x - double(j)), fy = static_cast<float>(y - double(i));
    const Spectrum *low = &table_[i * suns + j], *high = low + suns;
    Spectrum result;
    for (std::size_t b = 0; b < sky_bands; ++b) {
      const float below = low[0][b] + (low[1][b] - low[0][b]) * fx;
      const float above = high[0][b] + (high[1][b] - high[0][b]) * fx;
      result[b] = below + (above - below) * fy;
    }
    return result;
  }

 private:
  static constexpr int radii = 14, suns = 25, rows = 8, columns = 8;

  Spectrum series(double radius, double sun) const {
    Spectrum twice{}, share{};
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double up = -1 + (2 * row + 1.0) / rows, phi = 2 * pi * (column + 0.5) / columns;
        const double toward = up * sun + safe_sqrt(1 - up * up) * safe_sqrt(1 - sun * sun) * std::cos(phi);
        along(radius, up, sun, toward, twice, share);
      }
    Spectrum result;
    for (std::size_t b = 0; b < sky_bands; ++b)
      result[b] = twice[b] / (rows * columns) / (1 - share[b] / (rows * columns));
    return result;
  }

  // Adds what comes along one direction: light scattered once, and light as it would come if every place
  // scattered a radiance of 1.
  void along(double radius, double up, double sun, double toward, Spectrum& once, Spectrum& share) const {
    constexpr int steps = 14;
    const double ground = way_to_ground(radius, up);
    const double way = ground >= 0 ? ground : way_to_space(radius, up);
    Spectrum through;
    through.fill(1);
    for (int k = 0; k < steps; ++k) {
      const double t = way * (k + 0.5) / steps;
      const double r = std::sqrt(sqr(radius) + t * t + 2 * radius * up * t);
      const AirAt air = air_.at(r);
      const Spectrum light = air_.sunlight(r, (radius * sun + t * toward) / r);
      const auto length = static_cast<float>(way / steps);
      for (std::size_t b = 0; b < sky_bands; ++b) {
        const float passes = std::exp(-air.extinction[b] * length);
        const float scattered =
            (air.rayleigh[b] + air.haze[b]) * through[b] * (1 - passes) / air.extinction[b];
        once[b] += scattered * light[b] * isotropic_phase;
        share[b] += scattered;
        through[b] *= passes;
      }
    }
    if (ground < 0) return;
    const double height = (radius * sun + ground * toward) / earth_radius_km;
    const Spectrum light = air_.sunlight(earth_radius_km, height);
    for (std::size_t b = 0; b < sky_bands; ++b)
      once[b] += through[b] * light[b] * ground_reflection * static_cast<float>(std::max(0.0, height));
  }

  const Air& air_;
  std::vector<Spectrum> table_;
};

// Part of the sun's irradiance per solid angle that comes from a direction above the horizon: at the cosine
// `up` with the vertical and `toward` with the sun.
Spectrum sky_along(const Air& air, const ManyScatterings& many, double up, double sun, double toward) {
  constexpr int steps = 28;
  const double way = way_to_space(eye_radius_km, up);
  const auto rayleigh = static_cast<float>(3 / (16 * pi) * (1 + toward * toward));
  const auto haze = static_cast<float>(inv_4pi * (1 - haze_g * haze_g) /
                                       std::pow(1 + haze_g * haze_g - 2 * haze_g * toward, 1.5));
  Spectrum through, result{};
  through.fill(1);
  for (int k = 0; k < steps; ++k) {
    const double begins = way * sqr(double(k) / steps), ends = way * sqr((k + 1.0) / steps);
    const double t = 0.5 * (begins + ends);
    const double r = std::sqrt(sqr(eye_radius_km) + t * t + 2 * eye_radius_km * up * t);
    const double height_of_sun = (eye_radius_km * sun + t * toward) / r;
    const AirAt at = air.at(r);
    const Spectrum light = air.sunlight(r, height_of_sun), rest = many.at(r, height_of_sun);
    const auto length = static_cast<float>(ends - begins);
    for (std::size_t b = 0; b < sky_bands; ++b) {
      const float passes = std::exp(-at.extinction[b] * length);
      const float source = (at.rayleigh[b] * rayleigh + at.haze[b] * haze) * light[b] +
                           (at.rayleigh[b] + at.haze[b]) * rest[b];
      result[b] += source * through[b] * (1 - passes) / at.extinction[b];
      through[b] *= passes;
    }
  }
  return result;
}

constexpr int picture_columns = 180, picture_rows = 360;  // two degrees by half a degree

std::shared_ptr<const Daylight> make_daylight(double sine, double turbidity) {
  const Air air(turbidity);
  const ManyScatterings many(air);
  std::array<std::vector<float>, 3> texels;
  for (auto& channel : texels) channel.resize(static_cast<std::size_t>(picture_columns) * picture_rows);
  const auto place = [](int x, int y) {
    return static_cast<std::size_t>(y) * picture_columns + static_cast<std::size_t>(x);
  };
  const double level = safe_sqrt(1 - sine * sine);
  parallel_for(picture_rows / 2, 0, [&](std::size_t i, int) {
    const int y = picture_rows / 2 + static_cast<int>(i);
    const double latitude = pi * ((y + 0.5) / picture_rows - 0.5);
    for (int x = 0; x < picture_columns / 2; ++x) {  // the sky is the same on both sides of the sun
      const double longitude = 2 * pi * ((x + 0.5) / picture_columns - 0.5);
      const double toward = sine * std::sin(latitude) + level * std::cos(latitude) * std::cos(longitude);
      const Rgb color = color_of_sunlight(sky_along(air, many, std::sin(latitude), sine, toward));
      for (std::size_t c = 0; c < 3; ++c)
        texels[c][place(x, y)] = texels[c][place(picture_columns - 1 - x, y)] = color[c];
    }
  });
  auto result = std::make_shared<Daylight>();
  result->sun = color_of_sunlight(air.sunlight(eye_radius_km, sine));
  constexpr std::array<std::string_view, 3> names = {"sky R", "sky G", "sky B"};
  for (std::size_t c = 0; c < 3; ++c) {
    double level_irradiance = double{result->sun[c]} * std::max(0.0, sine);
    for (int y = picture_rows / 2; y < picture_rows; ++y) {
      const double low = std::sin(pi * (double(y) / picture_rows - 0.5)),
                   high = std::sin(pi * ((y + 1.0) / picture_rows - 0.5));
      for (int x = 0; x < picture_columns; ++x)
        level_irradiance +=
            double{texels[c][place(x, y)]} * (pi / picture_columns) * (high * high - low * low);
    }
    std::fill_n(texels[c].begin(), static_cast<std::size_t>(picture_columns) * (picture_rows / 2),
                static_cast<float>(sky_ground_albedo / pi * level_irradiance));
    result->picture[c] =
        make_plane(std::string(names[c]), picture_columns, picture_rows, std::move(texels[c]));
  }
  return result;
}

}  // namespace

std::shared_ptr<const Daylight> daylight(double sine, double turbidity) {
  CHECK(sine >= -1 && sine <= 1 && turbidity >= least_turbidity && turbidity <= most_turbidity);
  struct Kept {
    double sine, turbidity;
    std::shared_ptr<const Daylight> daylight;
  };
  constexpr std::size_t most_kept = 4;
  static std::mutex mutex;
  static std::deque<Kept> last;
  const std::lock_guard lock(mutex);
  for (const Kept& kept : last)
    if (kept.sine == sine && kept.turbidity == turbidity) return kept.daylight;
  last.push_back({sine, turbidity, make_daylight(sine, turbidity)});
  if (last.size() > most_kept) last.pop_front();
  return last.back().daylight;
}

double azimuth_of_sun(const Vec3d& sun) { return sun.x == 0 && sun.z == 0 ? 0 : std::atan2(-sun.x, -sun.z); }

}  // namespace tyndall::optics
