// `tyndall inspect model.glb`: what a glTF file holds.
#pragma once

#include <string>

#include "tools/exit_status.h"

namespace tyndall::tools {

bool is_gltf(const std::string& path);
ExitStatus inspect_gltf(const std::string& path, bool as_json);

}  // namespace tyndall::tools
