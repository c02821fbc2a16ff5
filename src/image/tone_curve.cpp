#include "image/tone_curve.h"

#include <algorithm>
#include <cmath>

#include "image/matrix.h"

namespace tyndall::image {

namespace {

constexpr Vec3d of_sum_one(const Vec3d& row) { return row / (row.x + row.y + row.z); }

// What AgX's channels see of the three, so that no colour is of one channel alone. The published rows sum to
// one within a 5000th; here they do exactly, and grey stays grey.
constexpr Matrix agx_inset{of_sum_one({0.842479062253094, 0.0784335999999992, 0.0792237451477643}),
                           of_sum_one({0.0423282422610123, 0.878468636469772, 0.0791661274605434}),
                           of_sum_one({0.0423756549057051, 0.0784336, 0.879142973793104})};
constexpr Matrix agx_outset = inverse(agx_inset);
constexpr double agx_first_stop = -12.47393, agx_last_stop = 4.026069;

constexpr double agx_polynomial(double x) {
  return (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x;
}

// The displayed light's 2.2th root, of a channel's light; 0 to 1 exactly over the range.
double agx_sigmoid(double light) {
  if (!(light > 0)) return 0;
  const double x = (std::log2(light) - agx_first_stop) / (agx_last_stop - agx_first_stop);
  return agx_polynomial(std::clamp(x, 0.0, 1.0)) / agx_polynomial(1);
}

Vec3d agx(const Vec3d& light) {
  const Vec3d seen = agx_inset * light;
  const Vec3d shown = agx_outset * Vec3d{agx_sigmoid(seen.x), agx_sigmoid(seen.y), agx_sigmoid(seen.z)};
  const auto linear = [](double v) { return std::pow(std::max(v, 0.0), 2.2); };
  return {linear(shown.x), linear(shown.y), linear(shown.z)};
}

Vec3d neutral(Vec3d color) {
  constexpr double start = 0.8 - 0.04, room = 1 - start, desaturation = 0.15;
  const double least = min_component(color);
  color -= Vec3d(least < 0.08 ? least - 6.25 * least * least : 0.04);
  const double peak = max_component(color);
  if (peak < start) return color;
  const double shown = 1 - room * room / (peak + room - start);
  const double white = 1 - 1 / (desaturation * (peak - shown) + 1);
  return color * (shown / peak) * (1 - white) + Vec3d(shown * white);
}

Vec3d film(const Vec3d& color) {
  constexpr double crosstalk = 0.05, start = 0.6, room = 1 - start;
  const auto shown = [](double v) { return v < start ? v : 1 - room * room / (v + room - start); };
  const Vec3d mixed = color * (1 - crosstalk) + Vec3d(crosstalk * (color.x + color.y + color.z) / 3);
  return {shown(mixed.x), shown(mixed.y), shown(mixed.z)};
}

// As much light as curves can count with.
double counted(float light) { return std::isnan(light) ? 0 : std::clamp(double{light}, 0.0, 1e30); }

}  // namespace

Rgb tone_curve(Tonemap tonemap, const Rgb& light) {
  Vec3d shown{counted(light.x), counted(light.y), counted(light.z)};
  switch (tonemap) {
    case Tonemap::film:
      shown = film(shown);
      break;
    case Tonemap::agx:
      shown = agx(shown);
      break;
    case Tonemap::neutral:
      shown = neutral(shown);
      break;
    case Tonemap::none:
      break;
  }
  const auto displayed = [](double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); };
  return {displayed(shown.x), displayed(shown.y), displayed(shown.z)};
}

}  // namespace tyndall::image
