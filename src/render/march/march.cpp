#include "render/march/march.h"

#include <algorithm>
#include <cmath>

namespace tyndall::render {

std::uint32_t March::segment_at(double t) const {
  const auto after = std::upper_bound(t0.begin(), t0.begin() + count, t);
  return after == t0.begin() ? 0 : static_cast<std::uint32_t>(after - t0.begin() - 1);
}

double March::optical_depth() const {
  double sum = 0;
  for (int c = 0; c < extinction_channels; ++c)
    for (std::uint32_t i = 0; i < count; ++i) sum += sigma_t[c][i] * dt[i];
  return sum / extinction_channels;
}

Rgb March::albedo_at(std::uint32_t i) const {
  Rgb albedo;
  for (int c = 0; c < 3; ++c) {
    const float s = sigma_s[channels == 1 ? 0 : c][i], t = sigma_t[extinction_row(c)][i];
    albedo[c] = t > 0 ? s / t : 0.0f;
  }
  return albedo;
}

Vec3d March::transmittance_at(std::uint32_t i, double t) const {
  Vec3d out;
  const double x = std::clamp(t - t0[i], 0.0, dt[i]);
  for (int c = 0; c < extinction_channels; ++c)
    out[c] = transmittance[c][i] * std::exp(-double{sigma_t[c][i]} * x);
  return extinction_channels == 1 ? Vec3d(out.x) : out;
}

}  // namespace tyndall::render
