// What one operation of the VM costs: the numbers behind the table of vm/cost.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>
#include <vector>

#include "bench.h"
#include "vm/builder.h"
#include "vm/machine.h"

namespace tyndall::vm {

namespace {

constexpr std::array<Input, 4> lane_inputs = {Input::p_x, Input::p_y, Input::p_z, Input::u};

// A chain of `length` operations, each on inputs and the value before it, so that none is dropped.
Program chain_of(Op op, int length) {
  Builder builder(false);
  std::array<NodeId, 4> operands;
  for (std::size_t k = 0; k < 4; ++k) operands[k] = builder.input(lane_inputs[k]);
  const OpInfo& info = op_info(op);
  for (int i = 0; i < length; ++i)
    operands[0] = builder.emit(op, std::span(operands).first(static_cast<std::size_t>(info.operands)), {},
                               info.has(OpTrait::octaves) ? 1 : 0);
  return *builder.finish(std::span(operands).first(1));
}

}  // namespace

void bench_ops(double seconds_a_row) {
  constexpr std::size_t lanes = Machine::max_lanes;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> range(0.1f, 0.9f);
  std::array<std::vector<float>, 4> columns;
  BatchInputs inputs;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < lanes; ++i) columns[k].push_back(range(random));
    inputs[lane_inputs[k]] = columns[k].data();
  }
  std::vector<float> out(lanes);
  float* const output = out.data();
  Machine machine;
  const auto nanoseconds = [&](const Program& program) {
    machine.run(program, inputs, lanes, std::span(&output, 1));
    std::vector<double> times;
    for (double spent = 0; spent < seconds_a_row || times.size() < 5; spent += times.back()) {
      const auto begin = std::chrono::steady_clock::now();
      for (int i = 0; i < 20; ++i) machine.run(program, inputs, lanes, std::span(&output, 1));
      times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return *std::min_element(times.begin(), times.end()) / 20 / lanes * 1e9;
  };
  fmt::print("SIMD class {}; nanoseconds a lane in batches of {}, an octave of those that have some\n",
             simd_name(), lanes);
  for (int i = 0; i < op_count; ++i) {
    const Op op = static_cast<Op>(i);
    fmt::print("{:12} {:7.3f}\n", op_info(op).name,
               (nanoseconds(chain_of(op, 9)) - nanoseconds(chain_of(op, 1))) / 8);
  }
}

}  // namespace tyndall::vm
