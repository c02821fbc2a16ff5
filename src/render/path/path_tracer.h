// The path loop: from camera samples to radiance.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/film/camera.h"
#include "render/path/cut_light_meter.h"
#include "render/path/path_gather.h"
#include "render/path/path_next_event.h"
#include "render/path/path_outputs.h"
#include "render/path/path_settings.h"
#include "render/path/path_state.h"

namespace tyndall::render {

// Of one thread; keeps its memory.
class PathTracer {
 public:
  // Keeps references.
  PathTracer(const compile::CompiledScene& world, const CameraRays& camera, const PathSettings& settings);

  // Radiance along each camera sample. Paths advance together, ray by ray, so that their marches fill whole
  // batches; what comes out for a sample depends on none of the others. False when the deadline passed before
  // all of them ended: the results are then of no use.
  [[nodiscard]] bool trace(std::span<const CameraSample> samples, const PathOutputs& outputs,
                           ThreadContext& thread);

 private:
  // One call's paths.
  struct Run {
    std::span<const CameraSample> samples;
    const PathOutputs& outputs;
    PathContext context;
    CutLightMeter& cut_light;
    std::size_t started = 0;  // samples begun: the first ones
  };
  PathSlot& new_slot();
  void start_paths(Run& run);
  void remove_ended();
  void trace_ray(const Run& run, PathSlot& path);
  bool advance(const Run& run, std::size_t i);
  bool scatter(const Run& run, PathSlot& path, bool continues);
  bool goes_on(const PathState& s) const;
  bool continues_in_volumes(const PathState& s) const;
  bool continue_in_volume(const Run& run, PathSlot& path, double volume_probability);
  bool continue_from_surface(const Run& run, PathSlot& path, PathState& s, const SurfacePoint& surface);
  void follow(const PathSlot& from, const PathState& state);
  void trace_shadows(const Run& run);
  void trace_emission_rays(const Run& run);

  const compile::CompiledScene& world_;
  const CameraRays& camera_;
  const PathSettings& settings_;
  MediumSampler media_;
  ShadowBatch shadows_;
  EmissionBatch emission_rays_;
  PathGather gather_;
  std::vector<std::unique_ptr<PathSlot>> slots_;
  std::vector<ScatteredLight> scattered_;  // of the samples, where it is limited
  std::size_t active_ = 0;                 // slots in use: the first
  std::vector<bool> ended_;                // of the slots that advanced in this round
};

}  // namespace tyndall::render
