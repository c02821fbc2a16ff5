// What a glTF file holds, for people and programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "import/gltf/file.h"

namespace tyndall::gltf {

// Its nodes, meshes, materials, animations, cameras, pictures and extensions. Throws Malformed.
nlohmann::ordered_json summary(File& file);

}  // namespace tyndall::gltf
