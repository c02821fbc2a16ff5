// Materials of a glTF file.
#pragma once

#include <cstdint>

#include "import/gltf/document.h"
#include "import/pbr/material.h"

namespace tyndall::gltf {

// Warns of what of it is not supported. Throws Malformed.
pbr::Material read_material(Document& document, std::uint32_t index);

}  // namespace tyndall::gltf
