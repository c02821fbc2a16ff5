// What is drawn from a march: distances by density, and directions by its phase functions.
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "render/march.h"
#include "render/worker.h"

namespace tyndall::render {

DensityDistribution::DensityDistribution(const March& march, const Rgb& throughput) : march_(march) {
  if (march.channels == 1) {
    total_ = march.count > 0 ? march.scattered[0][march.count] : 0;
    share_[0] = 1;
    return;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    share_[c] = march.count > 0 ? std::max(0.0f, throughput[c]) * march.scattered[c][march.count] : 0;
    total_ += share_[c];
  }
  if (total_ > 0)
    for (double& share : share_) share /= total_;
}

MarchPlace DensityDistribution::sample(float u_channel, float u) const {
  int c = 0;
  double rest = u_channel;
  while (c + 1 < march_.channels && rest >= share_[c]) rest -= share_[c++];
  while (share_[c] == 0 && c > 0) --c;  // rounding may leave the last channel with nothing to give
  const std::vector<double>& scattered = march_.scattered[c];
  const double target = u * scattered[march_.count];
  const auto after = std::upper_bound(scattered.begin(), scattered.begin() + march_.count + 1, target);
  const auto i = static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(after - scattered.begin() - 1, 0));
  const std::uint32_t segment = std::min(i, march_.count - 1);
  const double mass =
      std::clamp(target - scattered[segment], 0.0, scattered[segment + 1] - scattered[segment]);
  // Invert mass = sigma_s T (1 - e^(-sigma_t x)) / sigma_t; it is sigma_s T x in the limit of no extinction.
  const double sigma_t = march_.sigma_t[march_.extinction_row(c)][segment], dt = march_.dt[segment];
  const double begin = march_.transmittance[march_.extinction_row(c)][segment];
  const double rate = march_.sigma_s[c][segment] * begin;  // 0 when there is nothing to give
  const double gone = rate > 0 ? std::min(mass * sigma_t / rate, 1.0) : 0.0;
  const double x = gone > 1e-6 ? -std::log1p(-gone) / sigma_t : rate > 0 ? mass / rate * (1 + gone / 2) : 0.0;
  MarchPlace at{march_.t0[segment] + std::min(x, dt), segment, {}};
  at.transmittance =
      march_.extinction_channels == 1 ? Vec3d(begin * (1 - gone)) : march_.transmittance_at(segment, at.t);
  return at;
}

double DensityDistribution::pdf(const MarchPlace& at) const {
  if (!available()) return 0;
  double pdf = 0;
  for (int c = 0; c < march_.channels; ++c)
    if (share_[c] > 0)
      pdf +=
          share_[c] * march_.sigma_s[c][at.segment] * at.transmittance[c] / march_.scattered[c][march_.count];
  return pdf;
}

namespace {

// A medium whose lobes are the same wherever it is alone: with one value of everything, or with one lobe, of
// which the share is all.
bool keeps_lobes(const compile::CompiledScene& world, std::uint32_t medium) {
  if (world.media[medium].constant) return true;
  const std::vector<scene::PhaseLobe>& phase = world.scene.media[medium].phase;
  return phase.size() == 1 && !phase[0].parameters[0].output && !phase[0].parameters[1].output &&
         !phase[0].weight.output && phase[0].weight.value > 0;
}

}  // namespace

void PhaseMixture::set(const compile::CompiledScene& world, const March& m, std::uint32_t segment) {
  const scene::Medium* kept = nullptr;
  int holding = 0;
  for (const Block& b : m.blocks) {
    if (!b.holds(segment)) continue;
    const std::uint32_t medium = world.volumes[b.volume].medium;
    kept = holding++ == 0 && keeps_lobes(world, medium) ? &world.scene.media[medium] : nullptr;
  }
  if (kept && kept == kept_medium_) return;
  kept_medium_ = kept;
  lobes_.clear();
  Rgb total;
  for (const Block& b : m.blocks) {
    if (!b.holds(segment)) continue;
    const scene::Medium& medium = world.scene.media[world.volumes[b.volume].medium];
    const auto output = [&](std::uint8_t k) { return m.output(b, k, segment); };
    const auto number = [&](const scene::PhaseLobe::Number& n) {
      return n.output ? output(*n.output) : n.value;
    };
    const Rgb sigma_s{output(medium.sigma_s[0]), output(medium.sigma_s[1]), output(medium.sigma_s[2])};
    for (const scene::PhaseLobe& lobe : medium.phase) {
      Lobe out;
      out.phase.kind = lobe.kind;
      for (std::size_t k = 0; k < lobe.parameters.size(); ++k)
        out.phase.parameters[k] = number(lobe.parameters[k]);
      out.share = sigma_s * std::max(0.0f, number(lobe.weight));
      total += out.share;
      lobes_.push_back(out);
    }
  }
  if (kept && lobes_.size() == 1) {  // of whatever is scattered there, and be it nothing
    lobes_[0].share = Rgb(1);
    lobes_[0].probability = 1;
    return;
  }
  float sum = 0;
  for (Lobe& lobe : lobes_) {
    for (std::size_t c = 0; c < 3; ++c) lobe.share[c] = total[c] > 0 ? lobe.share[c] / total[c] : 0.0f;
    lobe.probability = (lobe.share.x + lobe.share.y + lobe.share.z) / 3;
    sum += lobe.probability;
  }
  if (sum > 0)
    for (Lobe& lobe : lobes_) lobe.probability /= sum;
}

Rgb PhaseMixture::eval(float one_minus_cos) const {
  Rgb sum;
  for (const Lobe& lobe : lobes_) sum += lobe.share * lobe.phase.eval(one_minus_cos);
  return sum;
}

Rgb PhaseMixture::eval_softened(float one_minus_cos, float anisotropy) const {
  Rgb sum;
  for (const Lobe& lobe : lobes_) sum += lobe.share * lobe.phase.eval_softened(one_minus_cos, anisotropy);
  return sum;
}

float PhaseMixture::pdf(float one_minus_cos) const {
  float sum = 0;
  for (const Lobe& lobe : lobes_) sum += lobe.probability * lobe.phase.eval(one_minus_cos);
  return sum;
}

float PhaseMixture::sample(float u_lobe, float u0, float u1) const {
  CHECK(!lobes_.empty());
  std::size_t i = 0;
  while (i + 1 < lobes_.size() && u_lobe >= lobes_[i].probability) u_lobe -= lobes_[i++].probability;
  return lobes_[i].phase.sample(u0, u1);
}

}  // namespace tyndall::render
