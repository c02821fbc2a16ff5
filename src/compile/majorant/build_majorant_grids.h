// Which majorant grid each volume has, and how fine it is (internal to this layer).
#pragma once

#include "compile/compiled_scene.h"

namespace tyndall::compile {

// Gives every volume of a medium that varies in space a grid; volumes that are the same in their medium's
// space share one. All grids full take no more than max_grid_bytes. Those that a frame before left are taken
// over where they are the same.
void add_grids(CompiledScene& world, Kept& kept);

inline constexpr std::size_t max_grid_bytes = std::size_t{256} << 20;
inline constexpr std::uint32_t max_grid_cells = 64 * 64 * 64;

}  // namespace tyndall::compile
