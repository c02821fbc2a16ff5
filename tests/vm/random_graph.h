// Random programs for tests: the choices depend on the seed alone.
#pragma once

#include "support.h"

namespace tyndall::vm {

// The same random graph in each builder, of `most` operations or fewer.
inline std::vector<NodeId> random_graph(Builder& builder, unsigned seed, std::size_t most = 64) {
  std::mt19937 random(seed);
  std::vector<NodeId> values;
  for (const Input input : lane_inputs) values.push_back(builder.input(input));
  values.push_back(builder.input(Input::time));
  for (int i = 0; i < 4; ++i)
    values.push_back(builder.constant(i == 0   ? 1.0f
                                      : i == 1 ? 0.0f
                                               : static_cast<float>(random() % 1000) * 0.01f - 5));
  const std::size_t operations = 5 + random() % (most - 4);
  for (std::size_t i = 0; i < operations; ++i) {
    const Op op = static_cast<Op>(random() % static_cast<unsigned>(op_count));
    if (op_info(op).looks_up()) continue;
    std::array<NodeId, 4> operands;
    // The last values more often than the first: deep graphs, with constants and inputs among them.
    for (NodeId& operand : operands)
      operand = random() % 2 == 0
                    ? values[random() % values.size()]
                    : values[values.size() - 1 - random() % std::min<std::size_t>(values.size(), 6)];
    const auto octaves = static_cast<std::uint8_t>(op_info(op).has(OpTrait::octaves) ? 1 + random() % 3 : 0);
    values.push_back(builder.emit(
        op, std::span(operands).first(static_cast<std::size_t>(op_info(op).operands)), {}, octaves,
        op_info(op).has(OpTrait::seed) ? static_cast<std::uint32_t>(random() % 100) : 0));
  }
  std::vector<NodeId> outputs;
  for (std::size_t i = 0; i < 3; ++i) outputs.push_back(values[values.size() - 1 - random() % 8]);
  return outputs;
}

}  // namespace tyndall::vm
