#include "render/march/march_integrals.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "render/march/segment_kernels.h"
#include "render/march/transmittance_roulette.h"

namespace tyndall::render {

namespace {

// The crossings up to t [m] in the order of the ray. Gives the transmittance behind them.
double cross_until(double t, std::size_t channel, double transmittance, March& m) {
  for (std::size_t& k = m.progress.crossings[channel]; k < m.crossings.size() && m.crossings[k].t <= t; ++k) {
    m.crossings[k].before[channel] = static_cast<float>(transmittance);
    transmittance *= m.crossings[k].pass;
  }
  return transmittance;
}

// Transmittance at every segment's start, and ∫ T over every segment (into `reach`), each exact for constant
// coefficients.
void add_transmittance(std::size_t channel, std::uint32_t end, IntegralScratch& scratch, March& m) {
  std::vector<double>& transmittance = m.transmittance[channel];
  if (transmittance.size() <= end) transmittance.resize(end + 1);
  double* const through = scratch.through.data();
  double* const reach = scratch.reach.data();
  transmit_segments(m.sigma_t[channel].data(), m.dt.data(), m.count, end, through, reach);
  double t = transmittance[m.count];
  const bool crosses = m.progress.crossings[channel] < m.crossings.size();
  for (std::uint32_t i = m.count; i < end; ++i) {
    if (crosses) t = cross_until(m.t0[i], channel, t, m);
    transmittance[i] = t;
    reach[i] *= t;
    t *= through[i];
  }
  transmittance[end] = t;
}

}  // namespace

void begin_sums(March& m) {
  m.progress.emitted = {};
  m.progress.crossings = {};
  const auto begin = [](std::vector<double>& row, double first) {
    if (row.empty()) row.resize(1);
    row[0] = first;
  };
  for (int c = 0; c < m.extinction_channels; ++c) begin(m.transmittance[c], 1);
  for (int c = 0; c < m.channels; ++c) begin(m.scattered[c], 0);
}

void add_segments(const compile::CompiledScene& world, std::uint32_t end, IntegralScratch& scratch,
                  March& m) {
  if (scratch.reach.size() < end + widest_lanes) {
    scratch.reach.resize(end + widest_lanes);
    scratch.through.resize(end + widest_lanes);
  }
  const double* const reach = scratch.reach.data();
  for (int c = 0; c < m.channels; ++c) {
    if (c < m.extinction_channels) add_transmittance(static_cast<std::size_t>(c), end, scratch, m);
    double s = m.scattered[c][m.count];
    if (m.scattered[c].size() <= end) m.scattered[c].resize(end + 1);
    for (std::uint32_t i = m.count; i < end; ++i) {
      m.scattered[c][i] = s;
      s += m.sigma_s[c][i] * reach[i];
    }
    m.scattered[c][end] = s;
    if (world.features.medium_emission)
      for (std::uint32_t i = m.count; i < end; ++i) m.progress.emitted[c] += m.emission[c][i] * reach[i];
  }
  m.count = end;
}

bool survives_roulette(std::uint32_t seed, std::uint32_t round, March& m) {
  double most = 0;
  for (int c = 0; c < m.extinction_channels; ++c) most = std::max(most, m.transmittance[c][m.count]);
  const double survival = transmittance_survival(most);
  if (survival == 1) return true;
  const bool survives = survives_transmittance_roulette(seed, round, survival);
  for (int c = 0; c < m.extinction_channels; ++c)
    m.transmittance[c][m.count] = survives ? m.transmittance[c][m.count] / survival : 0.0;
  return survives;
}

void finish_sums(March& m) {
  for (int c = 0; c < m.extinction_channels; ++c)
    m.transmittance[c][m.count] =
        cross_until(infinity, static_cast<std::size_t>(c), m.transmittance[c][m.count], m);
  if (m.extinction_channels == 1)
    for (MarchCrossing& crossing : m.crossings) crossing.before = Rgb(crossing.before.x);
  m.emitted = m.channels == 1 ? Rgb(static_cast<float>(m.progress.emitted.x)) : Rgb(m.progress.emitted);
}

}  // namespace tyndall::render
