// The machine computes what the scalar reference says, to the bit, wherever a lane stands and whatever the
// processor.
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

TEST(Machine, EveryOperationAgreesWithTheReferenceOnAwkwardNumbersInEverySimdClass) {
  for_each_simd_class([&](const std::string&) {
    Machine machine;
    for (const Op op : all_ops()) {
      const auto rows = awkward_operands(op, 4000);
      const Lanes lanes(rows);
      const std::vector<float> found = run(machine, program_of(op), lanes.from(0), lanes.size());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const float expected =
            evaluate_lane(op, std::span(rows[i]).first(static_cast<std::size_t>(op_info(op).operands)),
                          octaves_of(op), seed_of(op));
        ASSERT_TRUE(same(found[i], expected))
            << op_info(op).name << '(' << rows[i][0] << ", " << rows[i][1] << ", " << rows[i][2] << ", "
            << rows[i][3] << ") = " << found[i] << ", reference " << expected;
      }
    }
  });
}

// Not where one is built only (src/CMakeLists.txt).
TEST(Machine, HasSeveralSimdClasses) {
  std::size_t classes = 0;
  for_each_simd_class([&](const std::string&) { ++classes; });
  EXPECT_GE(classes, 2u);  // the scalar fallback is always there
}

TEST(Machine, ALaneDependsNeitherOnItsPlaceNorOnTheBatch) {
  Machine machine;
  for (const Op op : {Op::pow, Op::sin, Op::fbm3, Op::cells3, Op::smoothstep}) {
    const Program program = program_of(op);
    auto rows = awkward_operands(op, 600);
    for (std::size_t i = 0; rows.size() < 600; ++i) rows.push_back(rows[i]);
    const Lanes lanes(rows);
    const std::vector<float> whole = run(machine, program, lanes.from(0), lanes.size());
    for (std::size_t count = 1; count <= 600; count += count < 70 ? 1 : 53) {
      const std::size_t begin = 600 - count;
      const std::vector<float> part = run(machine, program, lanes.from(begin), count);
      for (std::size_t i = 0; i < count; ++i)
        ASSERT_TRUE(same(part[i], whole[begin + i])) << op_info(op).name << ", lane " << i << " of " << count;
    }
  }
}

TEST(Machine, WritesUniformOutputsToAllLanesAndNothingBeyondThem) {
  Builder builder;
  const NodeId time = builder.input(Input::time);
  const NodeId twice = builder.emit(Op::mul, {time, builder.constant(2)}, {});
  const std::array outputs = {builder.constant(7), time, twice, builder.input(Input::p_x)};
  const Program program = *builder.finish(outputs);
  EXPECT_TRUE(program.lane_code.empty());
  const std::size_t count = 301;
  std::vector<float> x(count, 3.0f);
  const float now = 1.5f;
  BatchInputs inputs;
  inputs[Input::time] = &now;
  inputs[Input::p_x] = x.data();
  std::array<std::vector<float>, 4> results;
  std::array<float*, 4> pointers{};
  for (std::size_t k = 0; k < 4; ++k) {
    results[k].assign(count + 1, -1.0f);
    pointers[k] = results[k].data();
  }
  Machine().run(program, inputs, count, pointers);
  const std::array expected = {7.0f, 1.5f, 3.0f, 3.0f};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(results[k][i], expected[k]);
    EXPECT_EQ(results[k][count], -1.0f);
  }
}

TEST(Machine, CountsLanesUsedAndIssued) {
  Machine machine;
  const Lanes lanes(std::vector<std::array<float, 4>>(300, {1, 2, 3, 4}));
  run(machine, program_of(Op::add), lanes.from(0), 300);
  EXPECT_EQ(machine.counters().runs, 1u);
  EXPECT_EQ(machine.counters().lanes_used, 300u);
  EXPECT_GE(machine.counters().lanes_issued, 300u);
  EXPECT_LT(machine.counters().lanes_issued, 316u);
  EXPECT_EQ(machine.counters().instructions, 2u);  // one instruction in two chunks
  run(machine, program_of(Op::add), lanes.from(0), 0);
  EXPECT_EQ(machine.counters().lanes_used, 300u);
  machine.reset_counters();
  EXPECT_EQ(machine.counters().runs, 0u);
}

TEST(Evaluate, DoubleAndFloatMeanTheSame) {
  for (const Op op : all_ops()) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> range(0.05f, 0.95f);
    const auto operands = static_cast<std::size_t>(op_info(op).operands);
    for (int i = 0; i < 200; ++i) {
      std::array<float, 4> a{};
      for (float& v : a) v = range(random);
      const std::array<double, 4> b = {a[0], a[1], a[2], a[3]};
      const double exact = evaluate(op, std::span(b).first(operands), octaves_of(op), seed_of(op));
      const float lane = evaluate_lane(op, std::span(a).first(operands), octaves_of(op), seed_of(op));
      const double tolerance = op_info(op).has(OpTrait::float_only) ? 0 : 4e-6 * (1 + std::fabs(exact));
      ASSERT_NEAR(exact, lane, tolerance) << op_info(op).name << ' ' << a[0] << ' ' << a[1] << ' ' << a[2];
    }
  }
}

}  // namespace
}  // namespace tyndall::vm
