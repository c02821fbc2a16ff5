// Light that a path meets by its own continuation, where it was sampled directly too.
#pragma once

#include "render/path_state.h"

namespace tyndall::render {

// MIS weight of meeting a light, at y of its surface with this normal, against sampling it directly with
// `light_samples` samples a camera ray and one a later one.
float weight_of_met_light(const compile::CompiledScene& world, int light_samples, const PathState& s,
                          std::uint32_t light, const Vec3d& y, const Vec3d& normal, Worker& worker);

}  // namespace tyndall::render
