// Cuts a batch into chunks, lays out their values, and runs the code over them.
#include "vm/machine.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

#include "base/check.h"
#include "vm/simd.h"

namespace tyndall::vm {

// Values are one block: first what is the same for all lanes, one vector each, then rows of lanes.
struct Machine::Memory {
  struct Free {
    void operator()(float* p) const { ::operator delete[](p, std::align_val_t{alignment}); }
  };
  static constexpr std::size_t alignment = 64;

  std::unique_ptr<float[], Free> values;
  std::size_t size = 0;
  std::vector<OperandView> operands;

  void reserve(std::size_t floats, std::size_t operand_count) {
    if (floats > size) {
      values.reset(
          static_cast<float*>(::operator new[](floats * sizeof(float), std::align_val_t{alignment})));
      size = floats;
    }
    if (operand_count > operands.size()) operands.resize(operand_count);
  }
};

Machine::Machine() : memory_(std::make_unique<Memory>()) {}
Machine::~Machine() = default;

namespace {

// The first `lanes` values, and the last of them again up to `padded`: what fills up a vector is ordinary,
// too.
void copy_padded(const float* from, std::size_t lanes, std::size_t padded, float* to) {
  std::copy_n(from, lanes, to);
  std::fill(to + lanes, to + padded, from[lanes - 1]);
}

}  // namespace

void Machine::run(const Program& program, const BatchInputs& inputs, std::size_t lanes,
                  std::span<float* const> outputs) {
  CHECK_EQ(outputs.size(), program.outputs.size());
  ++counters_.runs;
  if (lanes == 0) return;
  const std::size_t vector = simd_lanes();
  const auto pad = [&](std::size_t n) { return (n + vector - 1) / vector * vector; };
  const std::size_t pitch =
      (pad(std::min(lanes, max_lanes)) + widest_vector - 1) / widest_vector * widest_vector;
  const std::size_t first_row = program.first_row();
  memory_->reserve(first_row * widest_vector + (program.inputs.size() + program.row_count) * pitch,
                   program.operand_count());
  OperandView* const operands = memory_->operands.data();
  float* const values = memory_->values.get();

  for (std::size_t k = 0; k < first_row; ++k) operands[k] = {values + k * widest_vector, 0};
  broadcast(program.constants, values);
  float* next = values + first_row * widest_vector;
  for (std::size_t k = 0; k < program.inputs.size(); ++k) {
    OperandView& view = operands[program.first_input() + k];
    const Input input = program.inputs[k];
    CHECK(inputs[input] != nullptr);
    if (is_uniform(input)) {
      broadcast(std::span(inputs[input], 1), view.data);
    } else {
      view = {next, ~std::size_t{0}};
      next += pitch;
    }
  }
  for (std::size_t k = 0; k < program.row_count; ++k, next += pitch)
    operands[first_row + k] = {next, ~std::size_t{0}};

  if (!program.uniform_code.empty()) run_code(program.uniform_code, operands, vector);
  for (std::size_t begin = 0; begin < lanes; begin += max_lanes) {
    const std::size_t used = std::min(max_lanes, lanes - begin), issued = pad(used);
    for (std::size_t k = 0; k < program.inputs.size(); ++k)
      if (!is_uniform(program.inputs[k]))
        copy_padded(inputs[program.inputs[k]] + begin, used, issued,
                    operands[program.first_input() + k].data);
    run_code(program.lane_code, operands, issued);
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const OperandView& view = operands[program.outputs[k]];
      if (view.lane_mask == 0)
        std::fill_n(outputs[k] + begin, used, *view.data);
      else
        std::copy_n(view.data, used, outputs[k] + begin);
    }
    counters_.lanes_used += used;
    counters_.lanes_issued += issued;
    counters_.instructions += program.lane_code.size();
  }
}

}  // namespace tyndall::vm
