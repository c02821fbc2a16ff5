#include "render/distance.h"

#include <algorithm>

#include "optics/light_sampling.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

// What product sampling leaves to the density, so that no rough weight of a cell can make a sample too heavy.
constexpr double product_share = 0.95;

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

void reached_stretches(const optics::Light& light, const optics::Pivot& pivot, const March& march,
                       std::vector<Intervald>& out) {
  const optics::ReachedParts reached =
      optics::reached_parts(light, pivot, march.ray.origin, march.ray.direction, march.ray.t_max);
  for (const Intervald& stretch : march.scattering_stretches)
    for (int k = 0; k < reached.count; ++k) {
      const Intervald part = stretch.clipped_to(reached.parts[k]);
      if (!part.empty()) out.push_back(part);
    }
}

DistanceMixture::DistanceMixture(const optics::Light& light, const March& march,
                                 const DensityDistribution& density, const Rgb& throughput, Distance distance,
                                 const std::optional<optics::Pivot>& pivot, const PhaseMixture& phase,
                                 Worker& worker)
    : march_(march), density_(density), stretches_(worker.stretches) {
  worker.stretches.clear();
  if (!pivot || distance == Distance::density) return;
  reached_stretches(light, *pivot, march, worker.stretches);
  if (distance == Distance::product) {
    worker.product.set(march, throughput, pivot->position, stretches_, phase);
    product_ = &worker.product;
    if (product_->available()) toward_light_ = density_.available() ? product_share : 1;
    return;
  }
  equiangular_.emplace(march.ray.origin, march.ray.direction, pivot->position, stretches_);
  if (equiangular_->available()) toward_light_ = density_.available() && distance == Distance::mis ? 0.5 : 1;
}

MarchPlace DistanceMixture::sample(float u_strategy, float u_channel, float u) const {
  if (u_strategy >= toward_light_) return density_.sample(u_channel, u);
  return march_.place_at(product_ ? product_->sample(u) : equiangular_->sample(u));
}

double DistanceMixture::pdf(const MarchPlace& at) const {
  double pdf = 0;
  if (toward_light_ > 0) pdf += toward_light_ * (product_ ? product_->pdf(at.t) : equiangular_->pdf(at.t));
  if (toward_light_ < 1) pdf += (1 - toward_light_) * density_.pdf(at);
  return pdf;
}

}  // namespace tyndall::render
