// Where a path sends rays towards the sun (sunward.h), and what they do.
#pragma once

#include <optional>

#include "render/path_light.h"

namespace tyndall::render {

// The light of distant lights, shared between a path that goes on and a ray that is sent for it.
struct SunwardShare {
  float left = 1;                 // for the path
  std::optional<PathState> sent;  // a path of its own, by chance
};

// At x, where a medium scatters the path into direction w with this density [1/sr]; `s` is the path at x
// without its next direction, u in [0, 1) the chance. The phase function there is the worker's.
SunwardShare share_with_sunward(const PathContext& context, const PathSlot& path, const PathState& s,
                                const LightStrategies& strategies, const Vec3d& x, const Vec3f& w, float pdf,
                                float u);

// What distant lights bring to a ray that was sent for them; it ends with that.
void light_sunward(const PathContext& context, PathSlot& path, const PathState& s);

}  // namespace tyndall::render
