#include "render/method/medium_ray.h"

namespace tyndall::render {

ChosenLight choose_light(const LitRay& ray, const SobolPoint& point) {
  float u = point[3];
  ChosenLight out;
  out.light = ray.lights->sample(u);
  out.probability = ray.lights->probability(out.light);
  out.pivot = compile::LightAt(*ray.world, out.light, ray.march->ray.time)->sample_pivot(point[0], point[1]);
  return out;
}

std::optional<optics::Pivot> pivot_to(const compile::CompiledLight& light, const LightHit& hit) {
  auto pivot = light.sample_pivot(0.5f, 0.5f);
  if (pivot && light.pivot_on_surface()) pivot = optics::Pivot{hit.y, hit.normal};
  return pivot;
}

void begin_light(const compile::CompiledScene& world, const Rgb& throughput,
                 std::span<const ScatteringOrder> orders, MediumRay& ray) {
  LitRay& light = ray.light;
  light.world = &world;
  light.march = &ray.march;
  light.throughput = throughput;
  light.orders = orders;
  light.lights.reset();
  light.pieces.clear();
  light.density.reset();
  light.typical_phase.reset();
  light.free_path = nullptr;
  light.shares = {};
  const std::vector<Intervald>& scattering = ray.march.scattering_intervals;
  if (ray.march.scatters())
    light.lights.emplace(world, ray.march.ray, scattering.front().lo, scattering.back().hi);
}

Scattering scatter_by_density(const LitRay& light, float u, double volume_probability) {
  const March& m = *light.march;
  const MarchPlace at = light.density->sample(u);
  Scattering out{at.t, at.segment, light.density->pdf(at) * volume_probability, {}};
  out.weight = m.sigma_s_at(at.segment) * Rgb(at.transmittance) * static_cast<float>(1 / out.pdf);
  return out;
}

}  // namespace tyndall::render
