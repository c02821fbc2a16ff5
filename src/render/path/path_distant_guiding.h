// Where a path sends rays towards distant lights (distant_light_guiding.h), and what they do.
#pragma once

#include <optional>

#include "render/path/path_next_event.h"

namespace tyndall::render {

// The light of distant lights, shared between a path that goes on and a ray that is sent for it.
struct GuidedShare {
  float left = 1;                 // for the path
  std::optional<PathState> sent;  // a path of its own, by chance
};

// A medium scatters the path at x into direction w with this density [1/sr]. `phase` is the phase function
// there.
struct GuidedScattering {
  const Vec3d& x;
  const Vec3f& w;
  float pdf;
  const PhaseMixture& phase;
};
// `s` is the path at x without its next direction, u in [0, 1) the chance.
GuidedShare share_with_guided(const PathContext& context, const PathSlot& path, const PathState& s,
                              const GuidedScattering& scattering, float u);

// What distant lights bring to a ray that was sent for them; it ends with that.
void light_guided(const PathContext& context, PathSlot& path, const PathState& s);

}  // namespace tyndall::render
