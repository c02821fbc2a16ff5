// EXT_meshopt_compression: buffer views packed by meshoptimizer.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "import/gltf/json.h"

namespace tyndall::gltf {

// What `extension` of a buffer view makes of its packed bytes. Throws Malformed.
std::vector<std::byte> unpacked_meshopt(const Element& extension, std::span<const std::byte> packed);

}  // namespace tyndall::gltf
