// verify() finds every kind of broken program.
#include <functional>

#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

// Two uniforms, three lane instructions, inputs p.x p.y time, two constants.
Program sound() {
  Builder builder;
  const NodeId x = builder.input(Input::p_x), y = builder.input(Input::p_y),
               time = builder.input(Input::time);
  const NodeId u = builder.emit(Op::sin, {builder.emit(Op::mul, {time, builder.constant(2)}, {})}, {});
  const NodeId f = builder.emit(Op::fbm3, {x, y, u}, {}, 4, 7);
  const NodeId r = builder.emit(Op::max, {builder.emit(Op::div, {f, builder.constant(3)}, {}), x}, {});
  return *builder.finish(std::array{r, u});
}

TEST(Verify, AcceptsASoundProgram) { EXPECT_EQ(verify(sound()), ""); }

TEST(Verify, FindsWhatIsBroken) {
  struct Case {
    const char* message;
    std::function<void(Program&)> damage;
  };
  const Case cases[] = {
      {"reads operand 200", [](Program& p) { p.lane_code[1].operands[0] = 200; }},
      {"before it is written", [](Program& p) { p.lane_code[0].operands[0] = p.first_row(); }},
      {"before it is written", [](Program& p) { p.uniform_code[0].operands[0] = p.first_uniform(); }},
      {"reads lane value", [](Program& p) { p.uniform_code[0].operands[0] = p.first_input() + 1; }},
      {"out of [", [](Program& p) { p.lane_code[0].destination = p.first_uniform(); }},
      {"out of [", [](Program& p) { p.lane_code[0].destination = 0; }},
      {"out of [", [](Program& p) { p.lane_code[0].destination = 60000; }},
      {"out of [", [](Program& p) { p.uniform_code[0].destination = p.first_row(); }},
      {"with 0 octaves", [](Program& p) { p.lane_code[0].count = 0; }},
      {"octaves", [](Program& p) { p.lane_code[0].count = max_octaves + 1; }},
      {"div with 1 octaves", [](Program& p) { p.lane_code[1].count = 1; }},
      {"takes no seed", [](Program& p) { p.lane_code[1].immediate = 1; }},
      {"is not zero", [](Program& p) { p.lane_code[1].operands[3] = 1; }},
      {"unknown operation", [](Program& p) { p.lane_code[1].op = static_cast<Op>(op_count); }},
      {"occurs twice", [](Program& p) { p.inputs[1] = p.inputs[0]; }},
      {"unknown input", [](Program& p) { p.inputs[1] = static_cast<Input>(input_count); }},
      {"span", [](Program& p) { p.lane_spans.pop_back(); }},
      {"span", [](Program& p) { p.uniform_spans.emplace_back(); }},
      {"output 1: reads operand", [](Program& p) { p.outputs[1] = 500; }},
      {"before it is written",
       [](Program& p) {
         p.row_count = 5;
         p.outputs[0] = static_cast<Operand>(p.first_row() + 4);
       }},
      {"more than 65535", [](Program& p) { p.row_count = p.uniform_count = 40000; }},
  };
  for (const Case& c : cases) {
    Program program = sound();
    c.damage(program);
    EXPECT_NE(verify(program).find(c.message), std::string::npos)
        << c.message << ": '" << verify(program) << '\'';
  }
}

TEST(Verify, AcceptedMutantsRunWithoutHarm) {
  // Whatever verify lets pass, the machine and the reference compute alike.
  std::mt19937 random(8);
  Machine machine;
  int accepted = 0;
  const Lanes lanes(awkward_operands(Op::add, 100));
  const float time = 0.5f;
  for (int i = 0; i < 20000; ++i) {
    Program p = sound();
    p.fingerprint = 0;  // a changed program is another one
    for (unsigned k = 0; k <= random() % 2; ++k) {
      std::vector<Instruction>& code = random() % 3 == 0 ? p.uniform_code : p.lane_code;
      Instruction& instruction = code[random() % code.size()];
      switch (random() % 5) {
        case 0:
          instruction.op = static_cast<Op>(random() % 80);
          break;
        case 1:
          instruction.destination = static_cast<Operand>(random() % 14);
          break;
        case 2:
          instruction.operands[random() % 4] = static_cast<Operand>(random() % 14);
          break;
        case 3:
          instruction.count = static_cast<std::uint8_t>(random() % 40);
          break;
        default:
          p.outputs[random() % 2] = static_cast<Operand>(random() % 14);
      }
    }
    if (!verify(p).empty()) continue;
    ++accepted;
    BatchInputs inputs = lanes.from(0);
    inputs[Input::time] = &time;
    std::array<std::vector<float>, 2> found{std::vector<float>(40), std::vector<float>(40)}, expected = found;
    machine.run(p, inputs, 40, std::array{found[0].data(), found[1].data()});
    run_reference(p, inputs, 40, std::array{expected[0].data(), expected[1].data()});
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t lane = 0; lane < 40; ++lane)
        ASSERT_TRUE(same(found[k][lane], expected[k][lane])) << print(p);
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_LT(accepted, 15000);
}

}  // namespace
}  // namespace tyndall::vm
