// One thread of a render.
#pragma once

#include <vector>

#include "render/context/thread_context.h"
#include "render/film/aov.h"
#include "render/film/camera.h"
#include "render/path/path_tracer.h"

namespace tyndall::render {

struct Worker {
  Worker(const compile::CompiledScene& world, const CameraRays& camera, const PathSettings& settings)
      : tracer(world, camera, settings) {}

  ThreadContext thread;
  PathTracer tracer;
  // Of the tile at work.
  std::vector<CameraSample> samples;
  std::vector<Rgb> radiance;
  std::vector<AovSample> aovs;
};

}  // namespace tyndall::render
