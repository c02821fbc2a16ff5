// Where a path sends rays towards lamps (lamp_guiding.h), and what they do.
#pragma once

#include <optional>

#include "render/path/path_distant_guiding.h"
#include "render/path/path_next_event.h"
#include "render/surface/transparent_hits.h"

namespace tyndall::render {

// The light of lamps, shared between a path that goes on and a ray that is sent for it.
struct LampShare {
  float left = 1;                 // for the path
  std::optional<PathState> sent;  // a path of its own, by chance
};

// `s` is the path without its next direction, scattered in a segment of its march.
LampShare share_with_lamp_ray(const PathContext& context, const PathSlot& path, const PathState& s,
                              const GuidedScattering& scattering, std::uint32_t segment);
// The same on a surface, whatever the path draws there: `next`.
LampShare share_with_lamp_ray(const PathContext& context, const PathSlot& path, const PathState& s,
                              const SurfacePoint& surface, const std::optional<optics::SurfaceSample>& next);

// What lamps bring to a ray that was sent for them, along it and to one of the surfaces that it meets; it
// ends with that. `continues`: a path that meets the surfaces goes on there.
void light_lamp_ray(const PathContext& context, PathSlot& path, const PathState& s,
                    const HitSurfaces& surfaces, bool continues);

}  // namespace tyndall::render
