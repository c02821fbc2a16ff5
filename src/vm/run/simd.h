// The part of the machine that is compiled once for every SIMD class.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "vm/program/op.h"
#include "vm/program/tables.h"

namespace tyndall::vm {

// Floats of the widest vector that any SIMD class uses.
inline constexpr std::size_t widest_vector = 16;

struct Step;
// Computes the step's lanes [first, first + lanes); `lanes` is a multiple of simd_lanes().
using StepFunction = void (*)(const Step& step, std::size_t first, std::size_t lanes);

// An instruction with the places of its values. An operand has one float a lane (mask all ones), or one
// vector that every group of lanes reads again (mask zero).
struct Step {
  StepFunction run = nullptr;
  float* destination = nullptr;
  std::array<const float*, 4> operands{};
  std::array<std::uint16_t, 4> lane_mask{};
  std::uint32_t seed = 0;
  std::uint8_t octaves = 0;
  const Tables* tables = nullptr;  // of the program
};
static_assert(sizeof(Step) == 72);

// Lanes that one instruction computes at a time on this processor.
std::size_t simd_lanes();
// The functions of all operations, in their order, for the SIMD class in use.
std::span<const StepFunction> step_functions();

}  // namespace tyndall::vm
