// The scalar meaning of operations and programs: constant folding, and the oracle of the machine's tests.
#include <array>
#include <cstring>
#include <vector>

#include "base/check.h"
#include "vm/kernels/dispatch-inl.h"
#include "vm/run/machine.h"

namespace tyndall::vm {

namespace {

template <Op op, class T, std::size_t... k>
T apply(const T* operands, const HWY_NAMESPACE::Options& options, std::index_sequence<k...>) {
  return HWY_NAMESPACE::Kernel<op>::run(options, operands[k]...);
}

template <Op op>
float lane_of(const float* operands, const HWY_NAMESPACE::Options& options) {
  return apply<op>(operands, options, std::make_index_sequence<HWY_NAMESPACE::Kernel<op>::operands>());
}

float lane(Op op, const float* operands, std::uint8_t count, std::uint32_t immediate, const Tables& tables) {
  if (op_info(op).has(OpTrait::plane)) CHECK_LT(immediate, tables.planes.size());
  if (op_info(op).has(OpTrait::voxels)) CHECK_LT(immediate, tables.voxels.size());
  const HWY_NAMESPACE::Options options{count, immediate, &tables};
  switch (op) {
#define TYNDALL_OP(name, operand_count, cost, traits) \
  case Op::name:                                      \
    return lane_of<Op::name>(operands, options);
#include "vm/program/operations.inc"
  }
  check_failed(__FILE__, __LINE__, "unknown operation");
}

template <Op op>
double double_of(const double* operands, const HWY_NAMESPACE::Options& options) {
  if constexpr (!op_info(op).has(OpTrait::float_only)) {
    return apply<op>(operands, options, std::make_index_sequence<HWY_NAMESPACE::Kernel<op>::operands>());
  } else {
    std::array<float, 4> floats{};
    for (std::size_t k = 0; k < HWY_NAMESPACE::Kernel<op>::operands; ++k)
      floats[k] = static_cast<float>(operands[k]);
    return static_cast<double>(lane_of<op>(floats.data(), options));
  }
}

}  // namespace

double evaluate(Op op, std::span<const double> operands, std::uint8_t count, std::uint32_t immediate) {
  CHECK_EQ(operands.size(), static_cast<std::size_t>(op_info(op).operands));
  CHECK(!op_info(op).looks_up());
  const HWY_NAMESPACE::Options options{count, immediate, nullptr};
  switch (op) {
#define TYNDALL_OP(name, operand_count, cost, traits) \
  case Op::name:                                      \
    return double_of<Op::name>(operands.data(), options);
#include "vm/program/operations.inc"
  }
  check_failed(__FILE__, __LINE__, "unknown operation");
}

float evaluate_lane(Op op, std::span<const float> operands, std::uint8_t count, std::uint32_t immediate,
                    const Tables& tables) {
  CHECK_EQ(operands.size(), static_cast<std::size_t>(op_info(op).operands));
  return lane(op, operands.data(), count, immediate, tables);
}

void run_reference(const Program& program, const BatchInputs& inputs, std::size_t lanes,
                   std::span<float* const> outputs) {
  CHECK_EQ(outputs.size(), program.outputs.size());
  std::vector<float> values(program.operand_count());
  std::copy(program.constants.begin(), program.constants.end(), values.begin());
  const auto run = [&](const std::vector<Instruction>& code) {
    for (const Instruction& instruction : code) {
      std::array<float, 4> operands{};
      for (int k = 0; k < op_info(instruction.op).operands; ++k)
        operands[static_cast<std::size_t>(k)] = values[instruction.operands[static_cast<std::size_t>(k)]];
      values[instruction.destination] =
          lane(instruction.op, operands.data(), instruction.count, instruction.immediate, program.tables);
    }
  };
  for (std::size_t i = 0; i < lanes; ++i) {
    for (std::size_t k = 0; k < program.inputs.size(); ++k) {
      const Input input = program.inputs[k];
      values[program.first_input() + k] = inputs[input][is_uniform(input) ? 0 : i];
    }
    run(program.uniform_code);
    run(program.lane_code);
    for (std::size_t k = 0; k < outputs.size(); ++k) outputs[k][i] = values[program.outputs[k]];
  }
}

}  // namespace tyndall::vm
