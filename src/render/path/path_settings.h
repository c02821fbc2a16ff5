// What every path of a render shares.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/lights/emission_grid.h"
#include "render/lights/learned_lights.h"
#include "render/lights/lit_spots.h"
#include "render/method/medium_sampler.h"
#include "render/options.h"
#include "render/transmittance/scattering_octaves.h"
#include "render/transmittance/transmittance.h"

namespace tyndall::render {

struct PathSettings {
  Method method = Method::decoupled;
  Distance distance = Distance::product;
  Transmittance transmittance = Transmittance::march;
  int light_samples = 1;
  int bounces = 0;
  // In media paths are followed through this many scatterings; the rest is approximated by `orders`.
  std::uint32_t real_scatterings = std::numeric_limits<std::uint32_t>::max();
  std::vector<ScatteringOrder> orders;
  scene::Clamp clamp;
  bool distant_guiding = false;  // rays towards distant lights are sent
  bool lamp_guiding = false;     // and towards lamps
  bool jitters = false;          // some march is jittered: rays need seeds
  // No march of a camera ray ends by roulette: its optical depth is asked for.
  bool whole_camera_marches = false;
  int groups = 1;  // of samples with independent random numbers (film.h)
  // Rays after the last bounce are traced only when they could meet light that is not sampled directly, or
  // that competes with it by MIS.
  bool gathers_after_last = false;
  std::shared_ptr<const LitSpots> lit_spots;  // that rays towards lamps are sent to as well; null: none
  std::shared_ptr<const LearnedLights> learned_lights;  // null: lights are chosen by the tree alone
  std::shared_ptr<const EmissionGrids>
      emission;  // of media, to be sampled as light; null: only paths that end in it count it

  // The orders that direct light has along a ray after so many scatterings in media.
  std::span<const ScatteringOrder> orders_after(std::uint32_t media_scatterings) const {
    return media_scatterings == real_scatterings ? std::span(orders) : std::span<const ScatteringOrder>{};
  }
};
// What the options and the scene say to every path.
PathSettings path_settings(const compile::CompiledScene& world, const RenderOptions& options);
// Its groups.
int sample_groups(const RenderOptions& options);

}  // namespace tyndall::render
