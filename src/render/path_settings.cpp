// What the options and the scene say to every path.
#include "render/path.h"

namespace tyndall::render {

PathSettings path_settings(const compile::CompiledScene& world, const RenderOptions& options) {
  const compile::Features& f = world.features;
  PathSettings settings;
  settings.method = options.method;
  settings.distance = options.distance;
  settings.transmittance = options.transmittance;
  // Light at every step, and flights, take their one sample a place.
  settings.light_samples = options.method == Method::decoupled ? world.scene.settings.light_samples : 1;
  settings.jitters = f.heterogeneous || options.method == Method::brute_force;
  settings.whole_camera_marches = options.aovs.has(Aov::optical_depth);
  settings.sunward = options.sunward && options.method == Method::decoupled && !world.distant_lights.empty();
  settings.bounces = world.scene.settings.bounces;
  if (const auto& approximation = world.scene.settings.multiple_scattering.approximate) {
    settings.real_scatterings = static_cast<std::uint32_t>(approximation->real);
    settings.orders = higher_orders(*approximation);
  }
  // Rays that sum emission are marched, which is not what unbiased tracking is asked for.
  if (f.medium_emission && options.emission_sampling && options.method != Method::tracking)
    settings.emission = EmissionField::of(world);
  if (options.error || options.aovs.has(Aov::variance)) settings.groups = error_groups;
  settings.gathers_after_last =
      f.area_lights || f.distant_discs || f.environment || f.medium_emission || f.surface_emission;
  return settings;
}

}  // namespace tyndall::render
