// Random programs: the machine, the reference, and folding on and off all agree to the bit.
#include "support.h"

namespace tyndall::vm {
namespace {

// The same random graph in each builder; the choices depend on the seed alone.
std::vector<NodeId> random_graph(Builder& builder, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<NodeId> values;
  for (const Input input : lane_inputs) values.push_back(builder.input(input));
  values.push_back(builder.input(Input::time));
  for (int i = 0; i < 4; ++i)
    values.push_back(builder.constant(i == 0   ? 1.0f
                                      : i == 1 ? 0.0f
                                               : static_cast<float>(random() % 1000) * 0.01f - 5));
  const std::size_t operations = 5 + random() % 60;
  for (std::size_t i = 0; i < operations; ++i) {
    const Op op = static_cast<Op>(random() % static_cast<unsigned>(op_count()));
    std::array<NodeId, 4> operands;
    // The last values more often than the first: deep graphs, with constants and inputs among them.
    for (NodeId& operand : operands)
      operand = random() % 2 == 0
                    ? values[random() % values.size()]
                    : values[values.size() - 1 - random() % std::min<std::size_t>(values.size(), 6)];
    const auto octaves = static_cast<std::uint8_t>(op_info(op).octaves ? 1 + random() % 3 : 0);
    values.push_back(
        builder.emit(op, std::span(operands).first(static_cast<std::size_t>(op_info(op).operands)), {},
                     octaves, op_info(op).seed ? static_cast<std::uint32_t>(random() % 100) : 0));
  }
  std::vector<NodeId> outputs;
  for (std::size_t i = 0; i < 3; ++i) outputs.push_back(values[values.size() - 1 - random() % 8]);
  return outputs;
}

TEST(RandomPrograms, MachineReferenceAndFoldingAgree) {
  Machine machine;
  const std::size_t count = 37;
  std::mt19937 random(9);
  std::uniform_real_distribution<float> range(-4, 4);
  std::vector<std::array<float, 4>> rows(count);
  for (auto& row : rows)
    for (float& v : row)
      v = random() % 12 == 0 ? awkward_numbers()[random() % awkward_numbers().size()] : range(random);
  const Lanes lanes(rows);
  const float time = 1.25f;
  BatchInputs inputs = lanes.from(0);
  inputs[Input::time] = &time;
  std::size_t shorter = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    Builder folding, plain(false);
    const std::vector<NodeId> folded_outputs = random_graph(folding, seed),
                              plain_outputs = random_graph(plain, seed);
    const Program folded = *folding.finish(folded_outputs), whole = *plain.finish(plain_outputs);
    ASSERT_EQ(verify(folded), "");
    ASSERT_EQ(verify(whole), "");
    EXPECT_LE(folded.lane_code.size(), whole.lane_code.size());
    shorter += folded.lane_code.size() < whole.lane_code.size();
    std::array<std::array<std::vector<float>, 3>, 3> results;
    std::array<std::array<float*, 3>, 3> pointers{};
    for (std::size_t way = 0; way < 3; ++way)
      for (std::size_t k = 0; k < 3; ++k) {
        results[way][k].resize(count);
        pointers[way][k] = results[way][k].data();
      }
    machine.run(folded, inputs, count, pointers[0]);
    machine.run(whole, inputs, count, pointers[1]);
    run_reference(folded, inputs, count, pointers[2]);
    for (std::size_t way = 1; way < 3; ++way)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < count; ++i)
          ASSERT_TRUE(same(results[0][k][i], results[way][k][i]))
              << "seed " << seed << ", output " << k << ", lane " << i << ": " << results[0][k][i] << " and "
              << results[way][k][i] << '\n'
              << print(folded) << print(whole);
  }
  EXPECT_GT(shorter, 300u);
}

}  // namespace
}  // namespace tyndall::vm
