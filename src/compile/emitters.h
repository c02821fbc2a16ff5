// Shapes as emitters: the surfaces of mesh lights, and of shapes whose material glows alike everywhere.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "optics/emitter.h"
#include "scene/scene.h"

namespace tyndall::compile {

// The shape where it stands; null for planes, which have no end.
std::shared_ptr<const optics::Emitter> emitter_of(const scene::Scene& scene, const scene::Shape& shape,
                                                  const Transform& render_from_shape);

// A light for each shape of the scene (but those of instances, and those that move) whose material's emission
// is one value other than black, appended to `lights`. The result tells each shape's light, or no_index; it
// is empty when none has one.
std::vector<std::uint32_t> add_glowing_shapes(const scene::Scene& scene, const Transform& render_from_world,
                                              std::vector<optics::Light>& lights);

}  // namespace tyndall::compile
