// Random programs: the machine, the reference, and folding on and off all agree to the bit.
#include "random_graph.h"
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

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
