#include "render/distance/density_sampling.h"

#include <algorithm>
#include <cmath>

#include "render/distance/monotone_inverse.h"

namespace tyndall::render {

namespace {

// ∫ e^(-sigma_t x) from 0 to x.
double reach(double sigma_t, double x) {
  const double depth = sigma_t * x;
  return depth > 1e-6 ? -std::expm1(-depth) / sigma_t : x * (1 - depth / 2);
}

}  // namespace

DensityDistribution::DensityDistribution(const March& march, const Rgb& throughput) : march_(march) {
  double total = 0;
  for (int c = 0; c < march.channels; ++c) {
    weight_[c] = march.channels == 1 ? 1 : std::max(0.0f, throughput[c]);
    total += weight_[c] * (march.count > 0 ? march.scattered[c][march.count] : 0);
  }
  available_ = total > 0 && total < infinity;
  if (available_)
    for (double& weight : weight_) weight /= total;
}

double DensityDistribution::before(std::uint32_t i) const {
  double sum = 0;
  for (int c = 0; c < march_.channels; ++c) sum += weight_[c] * march_.scattered[c][i];
  return sum;
}

// The last segment before which there is no more than the target.
std::uint32_t DensityDistribution::segment_of(double target) const {
  std::uint32_t first = 0, last = march_.count - 1;
  while (first < last) {
    const std::uint32_t middle = first + (last - first + 1) / 2;
    if (before(middle) <= target)
      first = middle;
    else
      last = middle - 1;
  }
  while (first > 0 && !(before(first) < before(first + 1))) --first;  // by rounding, beyond all that scatters
  return first;
}

MarchPlace DensityDistribution::sample(float u) const {
  const std::uint32_t i = segment_of(u);
  const double mass = std::max(u - before(i), 0.0), dt = march_.dt[i];
  // Of the channels: what is scattered per metre at the segment's start. Their mean extinction.
  std::array<double, 3> rate{};
  double all = 0, sigma_t = 0;
  for (int c = 0; c < march_.channels; ++c) {
    const int row = march_.extinction_row(c);
    rate[c] = weight_[c] * march_.sigma_s[c][i] * march_.transmittance[row][i];
    all += rate[c];
    sigma_t += rate[c] * march_.sigma_t[row][i];
  }
  if (!(all > 0)) return {march_.t0[i], i, march_.transmittance_at(i, march_.t0[i])};
  sigma_t /= all;
  // Invert mass = rate (1 - e^(-sigma_t x)) / sigma_t; it is rate x in the limit of no extinction.
  const double gone = std::min(mass * sigma_t / all, 1.0);
  double x = std::min(gone > 1e-6 ? -std::log1p(-gone) / sigma_t : mass / all * (1 + gone / 2), dt);
  if (march_.extinction_channels > 1) {
    const auto sum = [&](auto&& of) {
      double total = 0;
      for (int c = 0; c < march_.channels; ++c) total += rate[c] * of(double{march_.sigma_t[c][i]});
      return total;
    };
    x = monotone_inverse(
        0, dt, mass, x, [&](double y) { return sum([y](double sigma) { return reach(sigma, y); }); },
        [&](double y) { return sum([y](double sigma) { return std::exp(-sigma * y); }); });
  }
  return {march_.t0[i] + x, i, march_.transmittance_at(i, march_.t0[i] + x)};
}

double DensityDistribution::pdf(const MarchPlace& at) const {
  if (!available()) return 0;
  double pdf = 0;
  for (int c = 0; c < march_.channels; ++c)
    pdf += weight_[c] * march_.sigma_s[c][at.segment] * at.transmittance[c];
  return pdf;
}

double DensityDistribution::cdf(const MarchPlace& at) const {
  if (!available()) return 0;
  const double x = std::clamp(at.t - march_.t0[at.segment], 0.0, march_.dt[at.segment]);
  double sum = before(at.segment);
  for (int c = 0; c < march_.channels; ++c) {
    const int row = march_.extinction_row(c);
    sum += weight_[c] * march_.sigma_s[c][at.segment] * march_.transmittance[row][at.segment] *
           reach(march_.sigma_t[row][at.segment], x);
  }
  return std::min(sum, 1.0);
}

bool DensityStrategy::prepare(const DistanceQuery& query) {
  density_ = &query.density;
  within_ = query.within;
  if (!density_->available()) return false;
  if (!within_) return true;
  const Intervald& all = query.march.scattering_intervals.back();
  before_ = density_->cdf(query.march.place_at(within_->lo));
  mass_ = (within_->hi < all.hi ? density_->cdf(query.march.place_at(within_->hi)) : 1) - before_;
  return mass_ > 0;
}

MarchPlace DensityStrategy::sample(const March& march, float u) const {
  if (!within_) return density_->sample(u);
  const MarchPlace at = density_->sample(static_cast<float>(before_ + u * mass_));
  if (within_->lo <= at.t && at.t <= within_->hi) return at;
  return march.place_at(std::clamp(at.t, within_->lo, within_->hi));  // by rounding
}

double DensityStrategy::pdf(const MarchPlace& at) const {
  if (!within_) return density_->pdf(at);
  return within_->lo <= at.t && at.t <= within_->hi ? density_->pdf(at) / mass_ : 0;
}

double DensityStrategy::cdf(const MarchPlace& at) const {
  if (!within_) return density_->cdf(at);
  return std::clamp((density_->cdf(at) - before_) / mass_, 0.0, 1.0);
}

}  // namespace tyndall::render
