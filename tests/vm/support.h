// What the VM's tests share: awkward numbers, equality to the bit, one-operation programs, every SIMD class.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "support/simd_classes.h"
#include "vm/builder/builder.h"
#include "vm/run/machine.h"

namespace tyndall::vm {

// Equal to the bit; all NaNs are one.
inline bool same(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// But for lookups, which need something to look up in: plane_test.cpp, voxels_test.cpp.
inline std::vector<Op> all_ops() {
  std::vector<Op> ops;
  for (int i = 0; i < op_count; ++i)
    if (!op_info(static_cast<Op>(i)).looks_up()) ops.push_back(static_cast<Op>(i));
  return ops;
}

inline constexpr std::uint32_t test_seed = 17;
inline std::uint8_t octaves_of(Op op) { return op_info(op).has(OpTrait::octaves) ? 3 : 0; }
inline std::uint32_t seed_of(Op op) { return op_info(op).has(OpTrait::seed) ? test_seed : 0; }

inline const std::vector<float>& awkward_numbers() {
  constexpr float inf = std::numeric_limits<float>::infinity();
  static const std::vector<float> numbers = {
      0.0f,    -0.0f,      1.0f,        -1.0f,       0.5f,          -0.5f,      2.0f,       -2.0f,
      3.0f,    -3.0f,      0.1f,        -0.7f,       1e-3f,         1e-30f,     -1e-30f,    1e-38f,
      1e-45f,  -1e-45f,    1.1755e-38f, 16777216.0f, -3e9f,         4194304.5f, 1e10f,      -1e10f,
      3.4e38f, -3.4e38f,   inf,         -inf,        std::nanf(""), 88.7f,      -87.4f,     -103.9f,
      100.0f,  3.1415927f, -1.5707964f, 6000.5f,     123456.0f,     0.9999999f, 1.0000001f, -0.99999994f};
  return numbers;
}

// A lane's operands for every combination that the operands of `op` take in the list, thinned to at most
// `limit`.
inline std::vector<std::array<float, 4>> awkward_operands(Op op, std::size_t limit) {
  const std::vector<float>& numbers = awkward_numbers();
  std::size_t count = 1;
  for (int k = 0; k < op_info(op).operands; ++k) count *= numbers.size();
  std::vector<std::array<float, 4>> result;
  std::mt19937 random(1);
  for (std::size_t i = 0; i < std::min(count, limit); ++i) {
    std::size_t digits = count <= limit ? i : random() % count;
    std::array<float, 4> operands{};
    for (float& operand : operands) {
      operand = numbers[digits % numbers.size()];
      digits /= numbers.size();
    }
    result.push_back(operands);
  }
  return result;
}

inline constexpr std::array<Input, 4> lane_inputs = {Input::p_x, Input::p_y, Input::p_z, Input::u};

// The program of one operation on the lane inputs.
inline Program program_of(Op op, std::uint8_t octaves, std::uint32_t seed) {
  Builder builder;
  std::array<NodeId, 4> nodes;
  for (std::size_t k = 0; k < 4; ++k) nodes[k] = builder.input(lane_inputs[k]);
  const auto operands = std::span<const NodeId>(nodes).first(static_cast<std::size_t>(op_info(op).operands));
  const NodeId output = builder.emit(op, operands, {}, octaves, seed);
  return *builder.finish(std::span(&output, 1));
}
inline Program program_of(Op op) { return program_of(op, octaves_of(op), seed_of(op)); }

// Lanes as four arrays of inputs.
struct Lanes {
  std::array<std::vector<float>, 4> columns;
  explicit Lanes(const std::vector<std::array<float, 4>>& rows) {
    for (const auto& r : rows)
      for (std::size_t k = 0; k < 4; ++k) columns[k].push_back(r[k]);
  }
  std::size_t size() const { return columns[0].size(); }
  BatchInputs from(std::size_t begin) const {
    BatchInputs inputs;
    for (std::size_t k = 0; k < 4; ++k) inputs[lane_inputs[k]] = columns[k].data() + begin;
    return inputs;
  }
};

inline std::vector<float> run(Machine& machine, const Program& program, const BatchInputs& inputs,
                              std::size_t lanes) {
  std::vector<float> result(lanes);
  float* const output = result.data();
  machine.run(program, inputs, lanes, std::span(&output, 1));
  return result;
}

using support::for_each_simd_class;

}  // namespace tyndall::vm
