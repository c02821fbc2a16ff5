#include "render/tracking/free_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {

void set_totals(const FreePath& f, March& m) {
  for (std::size_t c = 0; c < 3; ++c) {
    m.transmittance[c].resize(m.count + 1);
    m.scattered[c].resize(m.count + 1);
    m.transmittance[c][m.count] = f.ended() ? 0.0 : f.weight[c];
    m.scattered[c][m.count] = f.collided ? f.weight[c] : 0.0;
  }
}

void sample_free_path(March& m, const Rgb& throughput, float u_channel, float u, FreePath& f) {
  f.collided = f.stopped = false;
  f.aimed_t = {};
  std::array<double, 3> share{};
  double all = 0;
  for (std::size_t c = 0; c < 3; ++c) all += share[c] = std::abs(throughput[c]);
  if (!(all > 0)) share = {1, 1, 1}, all = 3;
  std::size_t channel = 0;
  for (double rest = u_channel * all; channel < 2 && rest >= share[channel]; ++channel)
    rest -= share[channel];
  const auto mean = [&](const Vec3d& v) { return (share[0] * v.x + share[1] * v.y + share[2] * v.z) / all; };
  const int row = m.extinction_row(static_cast<int>(channel));
  const double left = 1 - double{u};  // the path ends where less is left

  double reached = infinity;  // no surface lets it further than here
  for (MarchCrossing& c : m.crossings) {
    const Vec3d before(c.before);
    c.before = {};
    if (f.stopped || before[channel] * c.pass >= left) continue;
    f.stopped = true;
    reached = c.t;
    c.before = Rgb(before / (mean(before) * (1 - c.pass)));
  }
  const std::vector<double>& transmittance = m.transmittance[row];
  for (std::uint32_t i = 0; i < m.count && m.t0[i] < reached; ++i) {
    const double sigma = m.sigma_t[row][i], end = transmittance[i] * std::exp(-sigma * m.dt[i]);
    if (end >= left) continue;
    f.collided = true;
    f.t = m.t0[i] + std::clamp(std::log(transmittance[i] / left) / sigma, 0.0, m.dt[i]);
    const Vec3d through(m.transmittance_at(i, f.t));
    f.density = mean(m.sigma_t_at(i) * through);
    f.weight = f.density > 0 ? Rgb(through * Vec3d(m.sigma_s_at(i)) / f.density) : Rgb{};
    break;
  }
  if (f.collided) {
    f.stopped = false;
    for (MarchCrossing& c : m.crossings) c.before = {};
  } else {
    const Vec3d through(m.end_transmittance());
    f.weight = mean(through) > 0 ? Rgb(through / mean(through)) : Rgb{};
  }
  set_totals(f, m);
}

}  // namespace tyndall::render
