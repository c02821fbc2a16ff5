// The part of the machine that is compiled once for every SIMD class.
#pragma once

#include <cstddef>
#include <span>

#include "vm/program.h"

namespace tyndall::vm {

// Floats of the widest vector that any SIMD class uses.
inline constexpr std::size_t widest_vector = 16;

// Where an operand's values are: one float a lane (lane_mask all ones), or a vector that every group of lanes
// reads again (lane_mask zero).
struct OperandView {
  float* data = nullptr;
  std::size_t lane_mask = 0;
};

// Lanes that one instruction computes at a time on this processor.
std::size_t simd_lanes();
// Writes each value into every lane of its own vector: value i at to + i * widest_vector.
void broadcast(std::span<const float> values, float* to);
// Runs the instructions one after another over `lanes` lanes, a multiple of simd_lanes(). What they write
// must be aligned to 64 bytes.
void run_code(std::span<const Instruction> code, const OperandView* operands, std::size_t lanes);

}  // namespace tyndall::vm
