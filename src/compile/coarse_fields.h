// Fields of a lattice (noise and its like) at places so far from 0 that floats tell few apart there.
#pragma once

#include "compile/compiled_scene.h"

namespace tyndall::compile {

// From here on places are a quarter of a cell apart or more, and from 2^23 on noise is 0.
inline constexpr float coarse_place = 0x1p21f;

// Those that looks into the volumes and at the shapes' bounds find, each once.
std::vector<CoarseField> find_coarse_fields(const CompiledScene& world);

}  // namespace tyndall::compile
