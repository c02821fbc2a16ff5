#include "render/distance/distance_mixture.h"

#include <cstddef>
#include <utility>

#include "render/distance/monotone_inverse.h"

namespace tyndall::render {

namespace {

// Calls visit(strategy, its number) for each in turn, until one answers true.
template <class Strategies, class Visit>
bool any_of(Strategies& strategies, Visit&& visit) {
  return [&]<std::size_t... k>(std::index_sequence<k...>) {
    return (visit(std::get<k>(strategies), k) || ...);
  }
  (std::make_index_sequence<distance_strategy_count>());
}

}  // namespace

std::uint32_t brightest_segment(const March& m) {
  std::uint32_t brightest = 0;
  double most = -1;
  for (std::uint32_t i = 0; i < m.count; ++i) {
    const double scattered = m.scattered[0][i + 1] - m.scattered[0][i];
    if (scattered > most) brightest = i, most = scattered;
  }
  return brightest;
}

void lit_intervals(const compile::CompiledLight& light, const optics::Pivot& pivot, const March& march,
                   const Intervald* within, std::vector<Intervald>& out) {
  const optics::ReachedParts reached =
      light.reached_parts(pivot, march.ray.origin, march.ray.direction, march.ray.t_max);
  for (const Intervald& interval : march.scattering_intervals)
    for (int k = 0; k < reached.count; ++k) {
      Intervald part = interval.clipped_to(reached.parts[k]);
      if (within) part = part.clipped_to(*within);
      if (!part.empty()) out.push_back(part);
    }
}

bool DistanceMixture::prepare(Distance distance, const MixtureQuery& query) {
  march_ = &query.march;
  lit_.clear();
  weights_ = {};
  const std::array<double, distance_strategy_count>& wanted = info(distance).weights;
  const bool aims = query.pivot && info(distance).has(&StrategyTraits::aims_at_light);
  if (aims) lit_intervals(query.light, *query.pivot, query.march, query.within, lit_);
  const DistanceQuery about{
      query.march, query.throughput,    query.density, query.pivot ? &*query.pivot : nullptr,
      lit_,        query.typical_phase, query.within};
  double sum = 0;
  any_of(strategies_, [&](auto& strategy, std::size_t k) {
    const bool last_resort = k + 1 == distance_strategy_count && sum == 0;
    const double weight = last_resort ? 1 : wanted[k];
    if (weight > 0 && (aims || !strategy_traits[k].aims_at_light) && strategy.prepare(about))
      weights_[k] = weight;
    sum += weights_[k];
    return false;
  });
  if (!(sum > 0)) return false;
  for (double& weight : weights_) weight /= sum;
  return true;
}

MarchPlace DistanceMixture::sample(float u) const {
  MarchPlace place;
  const bool alone = any_of(strategies_, [&](const auto& strategy, std::size_t k) {
    if (weights_[k] < 1) return false;
    place = strategy.sample(*march_, u);
    return true;
  });
  return alone ? place : inverse(u);
}

// Of the sum of the strategies' distributions.
MarchPlace DistanceMixture::inverse(double u) const {
  const March& m = *march_;
  const auto at_start = [&m](std::uint32_t i) {
    return MarchPlace{m.t0[i], i, m.transmittance_at(i, m.t0[i])};
  };
  std::uint32_t first = 0, last = m.count - 1;
  while (first < last) {
    const std::uint32_t middle = first + (last - first + 1) / 2;
    if (cdf(at_start(middle)) <= u)
      first = middle;
    else
      last = middle - 1;
  }
  const auto place = [&](double x) {
    return MarchPlace{m.t0[first] + x, first, m.transmittance_at(first, m.t0[first] + x)};
  };
  const double dt = m.dt[first];
  return place(monotone_inverse(
      0, dt, u, dt / 2, [&](double x) { return cdf(place(x)); }, [&](double x) { return pdf(place(x)); }));
}

double DistanceMixture::pdf(const MarchPlace& at) const {
  double pdf = 0;
  any_of(strategies_, [&](const auto& strategy, std::size_t k) {
    if (weights_[k] > 0) pdf += weights_[k] * strategy.pdf(at);
    return false;
  });
  return pdf;
}

double DistanceMixture::cdf(const MarchPlace& at) const {
  double cdf = 0;
  any_of(strategies_, [&](const auto& strategy, std::size_t k) {
    if (weights_[k] > 0) cdf += weights_[k] * strategy.cdf(at);
    return false;
  });
  return cdf;
}

}  // namespace tyndall::render
