#include "render/path_light.h"

#include "render/decisions.h"
#include "render/emission_light.h"
#include "render/propagation.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

std::uint64_t id(Decision d, const PathState& s) { return decision(d, s.depth, s.branch); }

// Point k of those of one decision.
SobolPoint many(const PathSlot& path, Decision d, const PathState& s, int k, int count) {
  return path.sampler->point(id(d, s), static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(count));
}

int light_samples(const PathSettings& settings, const PathState& s) {
  return s.depth == 0 ? settings.light_samples : 1;
}

// Of one of a path's shadow rays, for its jitter.
std::uint32_t shadow_seed(const PathContext& context, const PathSlot& path, const PathState& s,
                          std::uint64_t counter) {
  return context.settings.jitters ? path.sampler->bits(id(Decision::shadow, s), counter) : 0;
}

// A counter of shadow seeds for each kind of ray.
constexpr std::uint64_t surface_seeds = 0x10000, aimed_seeds = 0x20000, emission_seeds = 0x30000,
                        surface_emission_seeds = 0x40000;

void light_volume_by_emission(const PathContext& context, PathSlot& path, const PathState& s, bool continues,
                              double volume_probability) {
  context.worker.emission_rays.set_sample(path.sample, s.direct_part());
  const int samples = light_samples(context.settings, s);
  for (int k = 0; k < samples; ++k) {
    const SobolPoint u = many(path, Decision::emission_distance, s, k, samples);
    const Scattering at = draw_scattering(context.settings, path, u[0], u[1], 1);
    sample_volume_emission(context.world, *context.settings.emission, path.march(), at,
                           many(path, Decision::emission, s, k, samples),
                           shadow_seed(context, path, s, emission_seeds + k), s.throughput,
                           continues ? volume_probability : 0, samples, context.worker);
  }
}

}  // namespace

void light_volume(const PathContext& context, PathSlot& path, const PathState& s, LightStrategies& strategies,
                  bool continues, double volume_probability) {
  if (context.settings.emission && !s.is_sunward())
    light_volume_by_emission(context, path, s, continues, volume_probability);
  if (strategies.empty()) return;
  context.worker.shadows.set_sample(path.sample, s.direct_part(), s.higher_part());
  const int samples = light_samples(context.settings, s);
  for (int k = 0; k < samples; ++k) {
    const std::uint32_t seed = shadow_seed(context, path, s, k);
    strategies.sample(many(path, Decision::light, s, k, samples), seed, s.throughput, continues,
                      volume_probability, samples, context.worker);
  }
}

void light_aimed(const PathContext& context, PathSlot& path, const PathState& s, bool continues) {
  context.worker.shadows.set_sample(path.sample, s.direct_part(), s.higher_part());
  path.light().sample_aimed(path.sampler->point(id(Decision::aimed, s)),
                            shadow_seed(context, path, s, aimed_seeds), s.throughput, continues,
                            context.worker);
}

void light_surface(const PathContext& context, const PathSlot& path, const PathState& s,
                   const SurfacePoint& surface, bool continues) {
  if (surface.only_deltas) return;
  const int samples = light_samples(context.settings, s);
  if (context.settings.emission) {
    context.worker.emission_rays.set_sample(path.sample, s.part(s.depth + 1));
    for (int k = 0; k < samples; ++k)
      sample_surface_emission(*context.settings.emission, surface,
                              many(path, Decision::emission_surface, s, k, samples),
                              shadow_seed(context, path, s, surface_emission_seeds + k), s.throughput,
                              continues, samples, context.worker);
  }
  LightChoice& lights = context.worker.surface_lights;
  lights.set(context.world, surface.position, surface.normal, 0, 0, s.ray.time);
  if (lights.empty()) return;
  context.worker.shadows.set_sample(path.sample, s.part(s.depth + 1));
  for (int k = 0; k < samples; ++k) {
    const std::uint32_t seed = shadow_seed(context, path, s, surface_seeds + k);
    sample_surface_light(context.world, surface, lights, many(path, Decision::light_surface, s, k, samples),
                         seed, s.throughput, continues, samples, context.worker);
  }
}

}  // namespace tyndall::render
