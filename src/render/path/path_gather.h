// What one ray of a path brings by itself: the emission of media along it, the surfaces and lights that it
// meets.
#pragma once

#include <optional>

#include "render/path/path_next_event.h"
#include "render/path/path_outputs.h"
#include "render/path/path_state.h"
#include "render/surface/transparent_hits.h"

namespace tyndall::render {

// Of one ray after the other.
class PathGather {
 public:
  // Adds what the path's current ray gathers, and evaluates the surfaces that it meets.
  void gather(const PathContext& context, const PathSlot& path, const PathOutputs& outputs);
  // Evaluates the surfaces alone.
  void meet_surfaces(const PathContext& context, const PathSlot& path);
  // What the outputs beside the picture keep of the ray.
  void record(const PathSlot& path, AovSample& out) const;
  // All surfaces that the ray meets.
  const HitSurfaces& surfaces() const { return surfaces_; }

 private:
  HitSurfaces surfaces_;
  std::optional<SurfacePoint> end_;  // the surface that the ray ends at
};

}  // namespace tyndall::render
