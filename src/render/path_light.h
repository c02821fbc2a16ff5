// Direct light at the places of a path: how many samples of it, with which random numbers, for which part of
// the picture.
#pragma once

#include "render/path.h"
#include "render/path_state.h"

namespace tyndall::render {

struct PathContext {
  const compile::CompiledScene& world;
  const PathSettings& settings;
  Worker& worker;
};

// Along the ray of state `s` of a path, in media. `continues`: rays that go on there compete, with the
// probability of going on in media.
void light_volume(const PathContext& context, PathSlot& path, const PathState& s, LightStrategies& strategies,
                  bool continues, double volume_probability);
// From the point that a flight was aimed at.
void light_aimed(const PathContext& context, PathSlot& path, const PathState& s, bool continues);
// On a surface that the ray meets.
void light_surface(const PathContext& context, const PathSlot& path, const PathState& s,
                   const SurfacePoint& surface, bool continues);

}  // namespace tyndall::render
