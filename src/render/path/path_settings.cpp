#include "render/path/path_settings.h"

#include "render/film/film.h"
#include "render/lights/lamp_guiding.h"

namespace tyndall::render {

PathSettings path_settings(const compile::CompiledScene& world, const RenderOptions& options) {
  const compile::Features& f = world.features;
  PathSettings settings;
  settings.method = options.method;
  settings.distance = options.distance;
  settings.transmittance = options.transmittance;
  const MethodTraits& method = traits(options.method);
  settings.light_samples = method.many_light_samples ? world.scene.settings.light_samples : 1;
  settings.jitters = f.heterogeneous || method.always_jitters;
  settings.whole_camera_marches = options.aovs.has(Aov::optical_depth);
  settings.distant_guiding = options.distant_guiding && method.guides && !world.distant_lights.empty();
  settings.lamp_guiding = options.lamp_guiding && method.guides && guides_to_lamps(world);
  if (settings.lamp_guiding && f.surfaces) settings.lit_spots = LitSpots::of(world);
  if (options.learned_lights)
    settings.learned_lights = LearnedLights::of(world, options.transmittance, options.threads);
  settings.bounces = world.scene.settings.bounces;
  settings.clamp = world.scene.settings.clamp;
  if (const auto& approximation = world.scene.settings.multiple_scattering.approximate) {
    settings.real_scatterings = static_cast<std::uint32_t>(approximation->real);
    settings.orders = higher_orders(*approximation);
  }
  if (f.medium_emission && options.emission_sampling && method.samples_emission)
    settings.emission = EmissionGrids::of(world);
  settings.groups = sample_groups(options);
  settings.gathers_after_last =
      f.area_lights || f.distant_discs || f.environment || f.medium_emission || f.surface_emission;
  return settings;
}

int sample_groups(const RenderOptions& options) {
  return options.error || options.aovs.grouped() ? error_groups : 1;
}

}  // namespace tyndall::render
