// The length of segments where a scene leaves it open: the coarsest whose bias a pilot of marches estimates
// to be below a tolerance; and the bias of lengths that are given.
//
// A pilot has some dozen lines through each medium as it stands in the scene. Their profiles give the mean of
// what a march of any step would make of them, without chance (line_profile.h), so one look at the medium
// serves for all steps. Lengths follow from lines, so they scale with the scene.
#pragma once

#include "compile/compiled_scene.h"

namespace tyndall::compile {

// Gives every volume the metres of its step, unless the step is proven, and the scene its step_bias.
void choose_steps(CompiledScene& world);

}  // namespace tyndall::compile
