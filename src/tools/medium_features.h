// What each medium costs, and what is proven about it: lines of `tyndall inspect --stage features`.
#pragma once

#include <string>

#include "compile/compiled_scene.h"

namespace tyndall::tools {

std::string medium_features(const compile::CompiledScene& world);

}  // namespace tyndall::tools
