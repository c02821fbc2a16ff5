#include "render/path/path_next_event.h"

#include "render/path/emission_sampling.h"

namespace tyndall::render {

namespace {

int light_samples(const PathSettings& settings, const PathState& s) {
  return s.depth == 0 ? settings.light_samples : 1;
}

// Of one of a path's shadow rays, for its jitter.
std::uint32_t shadow_seed(const PathContext& context, const PathNumbers& numbers, std::uint64_t counter) {
  return context.settings.jitters ? numbers.bits(Decision::shadow, counter) : 0;
}

LightTarget target_of(const PathSlot& path, const PathState& s, LightPart part) {
  return {path.sample, part, s.higher_part(), false, static_cast<std::uint8_t>(s.branch), s.depth};
}

// Rays that were scattered more often are not divided by what was learned: they bring little of the noise.
constexpr std::uint32_t most_divided = 1;

// A counter of shadow seeds for each kind of ray.
constexpr std::uint64_t surface_seeds = 0x10000, aimed_seeds = 0x20000, emission_seeds = 0x30000,
                        surface_emission_seeds = 0x40000;

void light_volume_by_emission(const PathContext& context, const PathSlot& path, const PathState& s,
                              bool continues, double volume_probability) {
  const PathNumbers numbers = path.numbers(s);
  const int samples = light_samples(context.settings, s);
  for (int k = 0; k < samples; ++k) {
    const SobolPoint u = numbers.point(Decision::emission_distance, k, samples);
    const SobolPoint point = numbers.point(Decision::emission, k, samples);
    sample_volume_emission(context.world, *context.settings.emission, path.march(),
                           context.media.scatter(path.ray(), u[0], 1),
                           {point, shadow_seed(context, numbers, emission_seeds + k), s.throughput,
                            target_of(path, s, s.direct_part()), continues, volume_probability, samples},
                           context.emission_rays);
  }
}

}  // namespace

void prepare_light(const PathContext& context, PathSlot& path, const PathState& s,
                   std::span<const ScatteringOrder> orders, const LightShares& shares) {
  MediumRay& ray = path.ray();
  context.media.prepare_light(context.world, s.throughput, orders, ray);
  ray.light.shares = shares;
  const LearnedLights* const learned = context.settings.learned_lights.get();
  if (learned && s.depth <= most_divided && learned->knows_media() && ray.light.density && !ray.light.empty())
    ray.light.pieces.divide(context.world, *learned, ray.march, *ray.light.density);
}

const LightRegion* light_region(const PathContext& context, const SurfacePoint& surface) {
  const LearnedLights* const learned = context.settings.learned_lights.get();
  return learned ? learned->on_surface(surface.position, surface.normal) : nullptr;
}

void light_volume(const PathContext& context, const PathSlot& path, const PathState& s, bool continues,
                  double volume_probability) {
  if (context.settings.emission && !s.is_guided())
    light_volume_by_emission(context, path, s, continues, volume_probability);
  const LitRay& ray = path.ray().light;
  if (ray.empty()) return;
  const PathNumbers numbers = path.numbers(s);
  const int samples = light_samples(context.settings, s);
  for (int k = 0; k < samples; ++k)
    context.media.sample_light(
        ray,
        {numbers.point(Decision::light, k, samples), shadow_seed(context, numbers, k), s.throughput,
         target_of(path, s, s.direct_part()), continues, volume_probability, samples},
        context.shadows);
}

void light_aimed(const PathContext& context, const PathSlot& path, const PathState& s, bool continues) {
  const PathNumbers numbers = path.numbers(s);
  context.media.sample_aimed_light(
      path.ray().light,
      {numbers.point(Decision::aimed), shadow_seed(context, numbers, aimed_seeds), s.throughput,
       target_of(path, s, s.direct_part()), continues},
      context.shadows);
}

void light_surface(const PathContext& context, const PathSlot& path, const PathState& s,
                   const SurfacePoint& surface, bool continues) {
  if (surface.only_deltas) return;
  const PathNumbers numbers = path.numbers(s);
  const int samples = light_samples(context.settings, s);
  LightTarget target = target_of(path, s, s.part(s.depth + 1));
  target.on_surface = true;
  if (context.settings.emission && !s.is_guided())
    for (int k = 0; k < samples; ++k)
      sample_surface_emission(*context.settings.emission, surface,
                              {numbers.point(Decision::emission_surface, k, samples),
                               shadow_seed(context, numbers, surface_emission_seeds + k), s.throughput,
                               target, continues, 0, samples},
                              context.emission_rays);
  const LightSelection lights(context.world, {surface.position, surface.normal, 0, s.ray.time}, 0, 0,
                              light_region(context, surface));
  if (lights.empty()) return;
  for (int k = 0; k < samples; ++k)
    sample_surface_light(
        context.world, surface, lights,
        {numbers.point(Decision::light_surface, k, samples), shadow_seed(context, numbers, surface_seeds + k),
         s.throughput, target, continues, 0, samples, s.surface_shares()},
        context.shadows);
}

}  // namespace tyndall::render
