#include "render/method/brute_force.h"

#include <algorithm>
#include <cmath>

#include "optics/phase.h"
#include "render/march/segment_limit.h"

namespace tyndall::render {

namespace {

// The part of a segment that gets one light sample: the volumes' step, also in media without variation.
double step_at(const LitRay& ray, std::uint32_t segment) {
  double step = infinity;
  for (const Block& b : ray.march->blocks)
    if (b.holds(segment)) {
      const compile::CompiledVolume& volume = ray.world->volumes[b.volume];
      step = std::min(step, volume.step.proven ? volume.widest_step : volume.step.metres);
    }
  const double dt = ray.march->dt[segment];
  return dt / std::clamp(std::ceil(dt / step), 1.0, double{max_segments});
}

// Each step has points of its own: a rotation of the sample's (Cranley and Patterson 1976).
SobolPoint rotated(const SobolPoint& point, std::uint32_t seed, std::uint32_t counter) {
  SobolPoint moved = point;
  for (std::size_t d = 0; d < moved.size(); ++d) {
    moved[d] += unit_float(static_cast<std::uint32_t>(hash_bits(seed + d, counter) >> 32));
    moved[d] = std::min(moved[d] - std::floor(moved[d]), one_minus_ulp_f);
  }
  return moved;
}

// Light at t of segment i, one sample a step of length dt [m].
void sample_step(const LitRay& ray, const LightRequest& request, const MarchPlace& at, double dt,
                 std::uint32_t counter, ShadowBatch& shadows) {
  const March& march = *ray.march;
  const SobolPoint point = rotated(request.point, request.shadow_seed, counter);
  const ChosenLight chosen = choose_light(ray, point);
  const Vec3d x = march.ray.origin + march.ray.direction * at.t;
  const auto drawn = compile::LightAt(*ray.world, chosen.light, march.ray.time)
                         ->sample(x, chosen.pivot.value_or(optics::Pivot{}), point[0], point[1]);
  if (!drawn) return;
  const PhaseMixture phase(*ray.world, march, at.segment);
  double share = 1;
  if (request.continues && drawn->pdf_solid_angle > 0) {
    const float m = optics::one_minus_cos(Vec3f(march.ray.direction), Vec3f(drawn->direction));
    share = balance(1, chosen.probability * drawn->pdf_solid_angle / dt,
                    request.volume_probability * ray.density->pdf(at) * phase.pdf(m));
  }
  const Rgb carried = request.weight * march.sigma_s_at(at.segment) * Rgb(at.transmittance) *
                      static_cast<float>(dt / chosen.probability);
  add_arrival(ray, {*drawn, chosen.light, x, at.segment, carried, share}, phase, request,
              request.shadow_seed + counter, shadows);
}

}  // namespace

void BruteForceMarching::sample_light(const LitRay& ray, const LightRequest& request,
                                      ShadowBatch& shadows) const {
  const March& march = *ray.march;
  std::uint32_t counter = 0;
  for (std::uint32_t i = 0; i < march.count; ++i) {
    const double dt = step_at(ray, i);
    const int steps = static_cast<int>(std::lround(march.dt[i] / dt));
    if (is_black(march.sigma_s_at(i))) continue;
    for (int k = 0; k < steps; ++k, ++counter) {
      const double t = march.t0[i] + (k + jitter(request.shadow_seed, counter)) * dt;
      sample_step(ray, request, {t, i, march.transmittance_at(i, t)}, dt, counter, shadows);
    }
  }
}

double BruteForceMarching::pdf_light(const LitRay& ray, const LightHit& hit) const {
  if (ray.empty()) return 0;
  const Vec3d x = ray.march->ray.origin + ray.march->ray.direction * hit.t;
  const compile::LightAt light_now(*ray.world, hit.light, ray.march->ray.time);
  const double solid_angle = light_now->pdf(x, hit.direction, hit.y, hit.normal);
  if (solid_angle == 0) return 0;
  return ray.lights->probability(hit.light) * solid_angle / step_at(ray, hit.segment);
}

}  // namespace tyndall::render
