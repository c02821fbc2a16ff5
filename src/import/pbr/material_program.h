// glTF's metallic-roughness model as a material of the scene: factors times textures, compiled to bytecode.
#pragma once

#include "import/pbr/material.h"
#include "import/pbr/textures.h"
#include "scene/scene.h"

namespace tyndall::pbr {

// `colors`: the mesh has colours, which the base colour is multiplied with. `span` stands in reports. Throws
// Malformed, for pictures that cannot be read.
scene::Material compiled(const Material& material, Textures& textures, bool colors, Span span);

// What is inside a material of glass: extinction in the world's metres. Nothing where it is clear.
std::optional<scene::ConstantMedium> inside_of(const Material& material);

}  // namespace tyndall::pbr
