#include "render/lights/distant_light_guiding.h"

#include <algorithm>

#include "base/numerics.h"
#include "optics/phase.h"

namespace tyndall::render {

namespace {

// Rays are sent from this share of the places, where the phase function's peak is this many times the mean or
// more; from fewer where it is lower, and from none below `least_peak`
// (docs/decisions/0015-distant-light-guiding.md).
constexpr float most_rays = 0.15f, peak_of_most_rays = 10, least_peak = 6;

}  // namespace

DistantLightGuide::DistantLightGuide(const compile::CompiledScene& world, const LightSelection& lights,
                                     const PhaseMixture& phase, double time)
    : phase_(phase) {
  if (lights.empty()) return;
  const float peak = static_cast<float>(4 * pi) * phase.pdf(0);
  if (peak <= least_peak) return;
  float sum = 0;
  for (const std::uint32_t i : world.distant_lights) {
    const auto share = static_cast<float>(lights.probability(i));
    if (!(share > 0)) continue;
    lights_.push_back({Vec3f(*compile::LightAt(world, i, time)->toward()), share});
    sum += share;
  }
  if (lights_.empty()) return;
  for (Light& light : lights_) light.share /= sum;
  chance_ = most_rays * sum * std::min((peak - least_peak) / (peak_of_most_rays - least_peak), 1.0f);
}

float DistantLightGuide::pdf(const Vec3f& w) const {
  float pdf = 0;
  for (const Light& light : lights_) pdf += light.share * phase_.pdf(optics::one_minus_cos(light.toward, w));
  return pdf;
}

Vec3f DistantLightGuide::sample(float u_light, float u_lobe, float u0, float u1, float u_turn) const {
  std::size_t i = 0;
  while (i + 1 < lights_.size() && u_light >= lights_[i].share) u_light -= lights_[i++].share;
  return optics::rotate_from(lights_[i].toward, phase_.sample(u_lobe, u0, u1),
                             static_cast<float>(2 * pi) * u_turn);
}

}  // namespace tyndall::render
