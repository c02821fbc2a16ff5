// The outputs that a material's body may set: one table for reading them and for the manual.
#pragma once

#include <span>

#include "shader/outputs.h"

namespace tyndall::shader {

std::span<const OutputRule> material_outputs();

}  // namespace tyndall::shader
