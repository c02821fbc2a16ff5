// Light that a path meets by its own continuation, where it was sampled directly too.
#pragma once

#include "render/method/medium_sampler.h"
#include "render/path/path_state.h"

namespace tyndall::render {

// A place on a light's surface; without meaning for lights at infinity.
struct EmitterPoint {
  std::uint32_t light = 0;
  Vec3d position, normal;
};

// MIS weight of meeting a light there, against sampling it directly with `light_samples` samples a camera ray
// and one a later one, and against rays that were sent for it.
float mis_weight_of_light(const compile::CompiledScene& world, int light_samples, const PathState& s,
                          const EmitterPoint& hit, MediumSampler& media);

}  // namespace tyndall::render
