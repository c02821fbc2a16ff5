// The path loop: camera samples from film to lights.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/camera.h"
#include "render/deadline.h"
#include "render/emission_field.h"
#include "render/higher_orders.h"
#include "render/render.h"
#include "render/worker.h"

namespace tyndall::render {

// What every sample of a render shares.
struct PathSettings {
  Method method = Method::decoupled;
  Distance distance = Distance::product;
  Transmittance transmittance = Transmittance::march;
  int light_samples = 1;
  int bounces = 0;
  // In media paths are followed through this many scatterings; the rest is approximated by `orders`.
  std::uint32_t real_scatterings = std::numeric_limits<std::uint32_t>::max();
  std::vector<ScatteringOrder> orders;
  bool sunward = false;  // rays towards distant lights are sent
  bool jitters = false;  // some march is jittered: rays need seeds
  // No march of a camera ray ends in the dark: its optical depth is asked for.
  bool whole_camera_marches = false;
  int groups = 1;  // of samples with independent random numbers (film.h)
  // Rays after the last bounce are traced only when they could meet light that is not sampled directly, or
  // that competes with it by MIS.
  bool gathers_after_last = false;
  std::shared_ptr<const EmissionField>
      emission;  // of media, to be sampled as light; null: met by chance alone

  // The orders that direct light has along a ray after so many scatterings in media.
  std::span<const ScatteringOrder> orders_after(std::uint32_t media_scatterings) const {
    return media_scatterings == real_scatterings ? std::span(orders) : std::span<const ScatteringOrder>{};
  }
};
PathSettings path_settings(const compile::CompiledScene& world, const RenderOptions& options);

// Where the results of camera samples go, one a sample.
struct PathOutputs {
  std::span<Rgb> radiance;
  std::span<AovSample> aovs = {};  // as many, or none when nothing beside the picture is wanted
  std::string* trace = nullptr;    // gets a line of text for each event
  const Deadline* deadline = nullptr;
};

// Radiance along each camera sample. Paths advance together, ray by ray, so that their marches fill whole
// batches; what comes out for a sample depends on none of the others. False when the deadline passed before
// all of them ended: the results are then of no use.
[[nodiscard]] bool trace_paths(const compile::CompiledScene& world, const CameraRays& camera,
                               const PathSettings& settings, std::span<const CameraSample> samples,
                               Worker& worker, const PathOutputs& outputs);

}  // namespace tyndall::render
