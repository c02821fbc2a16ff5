// The extensions of glTF that are read.
#pragma once

#include <string_view>

namespace tyndall::gltf {

bool is_supported(std::string_view extension);

}  // namespace tyndall::gltf
