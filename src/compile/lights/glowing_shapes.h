// Shapes whose material glows alike everywhere, as lights.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/lights/compiled_light.h"
#include "scene/scene.h"

namespace tyndall::compile {

// A light for each shape of the scene (but those of instances, and those that move) whose material's emission
// is one value other than black, appended to `lights`. The result tells each shape's light, or no_index; it
// is empty when none has one.
std::vector<std::uint32_t> add_glowing_shapes(const scene::Scene& scene, const Vec3d& origin,
                                              std::vector<CompiledLight>& lights);

}  // namespace tyndall::compile
