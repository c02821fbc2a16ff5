// Russian roulette on what a path still carries.
#pragma once

#include "base/sampler.h"
#include "render/path/path_state.h"

namespace tyndall::render {

// Counts a scattering. False when the path ends there by chance; one that goes on carries the more.
bool next_depth(PathState& state, const Sampler& sampler);

}  // namespace tyndall::render
