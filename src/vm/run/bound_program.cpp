#include "vm/run/bound_program.h"

#include <algorithm>
#include <bit>

#include "base/check.h"

namespace tyndall::vm {

AlignedFloats aligned_floats(std::size_t count) {
  return AlignedFloats(static_cast<float*>(::operator new[](count * sizeof(float), AlignedFree::alignment)));
}

float* Rows::operator[](std::size_t row) {
  while (row >= blocks_.size() * rows_a_block) blocks_.push_back(aligned_floats(rows_a_block * pitch));
  return blocks_[row / rows_a_block].get() + row % rows_a_block * pitch;
}

Prepared::Prepared(const Program& program, Rows& rows)
    : functions_(step_functions()), vector_lanes_(simd_lanes()) {
  const std::size_t fixed = program.first_row();
  fixed_ = aligned_floats(fixed * widest_vector);
  for (std::size_t k = 0; k < fixed; ++k) operands_.push_back({fixed_.get() + k * widest_vector, false});
  for (std::size_t k = 0; k < program.constants.size(); ++k)
    std::fill_n(operands_[k].data, widest_vector, program.constants[k]);
  tables_ = std::make_unique<const Tables>(program.tables);
  std::size_t next_row = 0;
  for (std::size_t k = 0; k < program.inputs.size(); ++k) {
    LaneInput& input = inputs_.emplace_back();
    if (is_uniform(program.inputs[k])) {
      has_uniform_inputs_ = true;
      continue;
    }
    input.row = rows[next_row++];
    operands_[program.first_input() + k] = {input.row, true};
  }
  for (std::size_t k = 0; k < program.row_count; ++k) operands_.push_back({rows[next_row++], true});
  add_steps(program.uniform_code, uniform_steps_);
  add_steps(program.lane_code, lane_steps_);
  add_guards(program);
  find_places(program);
}

void Prepared::add_steps(const std::vector<Instruction>& code, std::vector<Step>& steps) const {
  for (const Instruction& instruction : code) {
    Step& step = steps.emplace_back();
    step.run = functions_[static_cast<std::size_t>(instruction.op)];
    step.destination = operands_[instruction.destination].data;
    for (std::size_t k = 0; k < static_cast<std::size_t>(op_info(instruction.op).operands); ++k) {
      const Place& place = operands_[instruction.operands[k]];
      step.operands[k] = place.data;
      step.lane_mask[k] = place.lane ? 0xffff : 0;
    }
    step.seed = instruction.immediate;
    step.octaves = instruction.count;
    step.tables = tables_.get();
  }
}

void Prepared::add_guards(const Program& program) {
  const std::vector<vm::Guard>& guards = program.guards;
  for (std::size_t i = 0; i < guards.size(); ++i) {
    const Place& place = operands_[guards[i].condition];
    std::size_t next = i + 1;
    while (next < guards.size() && guards[next].first < guards[i].last) ++next;
    guards_.push_back({guards[i].first, guards[i].last, place.data, place.lane ? ~std::size_t{0} : 0,
                       guards[i].when, static_cast<std::uint32_t>(next)});
  }
}

// Finds every place of the lane inputs, and of the outputs' rows from their last writer on.
void Prepared::find_places(const Program& program) {
  std::vector<RowPlaces> places(operands_.size());
  std::uint32_t guard = 0;
  for (std::uint32_t i = 0; i < program.lane_code.size(); ++i) {
    const Instruction& instruction = program.lane_code[i];
    for (; guard < program.guards.size() && program.guards[guard].first == i; ++guard)
      places[program.guards[guard].condition].read.push_back(&guards_[guard].condition);
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(op_info(instruction.op).operands); ++k)
      places[instruction.operands[k]].read.push_back(&lane_steps_[i].operands[k]);
    places[instruction.destination] = {{}, {&lane_steps_[i].destination}};
  }
  for (std::size_t k = 0; k < program.inputs.size(); ++k)
    if (inputs_[k].row) inputs_[k].places = places[program.first_input() + k];
  for (std::size_t k = 0; k < program.outputs.size(); ++k) {
    const Operand operand = program.outputs[k];
    Output& output = outputs_.emplace_back();
    const auto same =
        std::find(program.outputs.begin(), program.outputs.begin() + static_cast<long>(k), operand);
    if (program.uniform(operand))
      output.uniform = operands_[operand].data;
    else if (operand < program.first_uniform())
      output.input = operand - program.first_input();
    else if (same != program.outputs.begin() + static_cast<long>(k))
      output.same_as = static_cast<std::int32_t>(same - program.outputs.begin());
    else
      output.places = places[operand], output.row = operands_[operand].data;
    outputs_are_rows_ &= output.row != nullptr;
  }
}

void Prepared::set_uniform_inputs(const Program& program, const BatchInputs& inputs) {
  if (uniforms_valid_ && !has_uniform_inputs_) return;
  for (std::size_t k = 0; k < program.inputs.size(); ++k) {
    if (!is_uniform(program.inputs[k])) continue;
    CHECK(inputs[program.inputs[k]] != nullptr);
    const float value = *inputs[program.inputs[k]];
    float* const data = operands_[program.first_input() + k].data;
    if (uniforms_valid_ && std::bit_cast<std::uint32_t>(*data) == std::bit_cast<std::uint32_t>(value))
      continue;
    std::fill_n(data, widest_vector, value);
    uniforms_valid_ = false;
  }
  if (uniforms_valid_) return;
  for (const Step& step : uniform_steps_) step.run(step, 0, vector_lanes_);
  uniforms_valid_ = true;
}

}  // namespace tyndall::vm
