// The part of the interval machine that is compiled once for every SIMD class.
#pragma once

#include <cstddef>
#include <span>

#include "vm/program/program.h"

namespace tyndall::vm {

// Where an operand's bounds are: three rows (lowest, highest, 1 where it may be NaN) `pitch` floats apart,
// one float a box (mask all ones), or one vector each that every group of boxes reads again (mask zero).
struct BoundView {
  float* data = nullptr;
  std::size_t pitch = 0, lane_mask = 0;
};

// Runs the instructions one after another over `boxes` boxes, a multiple of simd_lanes(). Rows must be
// aligned to 64 bytes. `tables` are the program's.
void run_interval_code(std::span<const Instruction> code, const BoundView* operands, std::size_t boxes,
                       const Tables& tables);

}  // namespace tyndall::vm
