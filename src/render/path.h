// The path loop: one camera sample from film to lights.
#pragma once

#include <string>

#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "render/camera.h"
#include "render/render.h"
#include "render/worker.h"

namespace tyndall::render {

// What every sample of a render shares.
struct PathSettings {
  Distance distance = Distance::mis;
  int light_samples = 1;
  int bounces = 0;
  // Rays after the last bounce are traced only when they could meet light that is not sampled directly, or
  // that competes with it by MIS.
  bool gathers_after_last = false;
};
PathSettings path_settings(const compile::CompiledScene& world, const RenderOptions& options);

// Radiance along one camera sample. With `trace`, appends a line of text for each event.
Rgb trace_path(const compile::CompiledScene& world, const CameraRays& camera, const PathSettings& settings,
               int x, int y, const Sampler& sampler, Worker& worker, std::string* trace = nullptr);

}  // namespace tyndall::render
