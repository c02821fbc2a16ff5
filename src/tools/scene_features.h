// What a scene uses of what the renderer can do.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::tools {

// By names for people.
std::vector<std::pair<std::string_view, bool>> scene_features(const compile::CompiledScene& world);

}  // namespace tyndall::tools
