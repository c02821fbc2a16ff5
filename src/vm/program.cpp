// What a program says about its operands, and the laws it obeys.
#include "vm/program.h"

#include <fmt/format.h>

#include <bitset>

namespace tyndall::vm {

namespace {

constexpr std::array<std::string_view, input_count> input_names = {"p.x", "p.y", "p.z",  "P.x",  "P.y",
                                                                   "P.z", "n.x", "n.y",  "n.z",  "N.x",
                                                                   "N.y", "N.z", "uv.x", "uv.y", "time"};

// Checks the code in order, remembering what has been written so far.
class Verifier {
 public:
  explicit Verifier(const Program& program) : program_(program), written_(program.operand_count(), false) {
    for (std::size_t i = 0; i < program.first_uniform(); ++i) written_[i] = true;
  }

  std::string run() {
    check_shape();
    if (error_.empty()) check_code("uniform code", program_.uniform_code, true);
    if (error_.empty()) check_code("lane code", program_.lane_code, false);
    for (std::size_t i = 0; i < program_.outputs.size() && error_.empty(); ++i)
      check_read(fmt::format("output {}", i), program_.outputs[i], false);
    return error_;
  }

 private:
  void check_shape() {
    std::bitset<input_count> seen;
    for (const Input input : program_.inputs) {
      const auto index = static_cast<std::size_t>(input);
      if (index >= input_count) return fail("unknown input {}", index);
      if (seen[index]) return fail("input {} occurs twice", input_name(input));
      seen.set(index);
    }
    if (program_.uniform_spans.size() != program_.uniform_code.size() ||
        program_.lane_spans.size() != program_.lane_code.size())
      fail("not one span an instruction");
  }

  void check_code(std::string_view part, const std::vector<Instruction>& code, bool uniform) {
    const std::size_t begin = uniform ? program_.first_uniform() : program_.first_row();
    const std::size_t end = uniform ? program_.first_row() : program_.operand_count();
    for (std::size_t i = 0; i < code.size() && error_.empty(); ++i) {
      const Instruction& instruction = code[i];
      const std::string place = fmt::format("{}, instruction {}", part, i);
      if (static_cast<int>(instruction.op) >= op_count()) return fail("{}: unknown operation", place);
      const OpInfo& info = op_info(instruction.op);
      const int octaves = instruction.count;
      if (info.octaves ? octaves < 1 || octaves > max_octaves : octaves != 0)
        return fail("{}: {} with {} octaves", place, info.name, octaves);
      if (!info.seed && instruction.immediate != 0) return fail("{}: {} takes no seed", place, info.name);
      for (std::size_t k = 0; k < instruction.operands.size() && error_.empty(); ++k) {
        if (k < static_cast<std::size_t>(info.operands))
          check_read(place, instruction.operands[k], uniform);
        else if (instruction.operands[k] != 0)
          return fail("{}: operand {} of {} is not zero", place, k, info.name);
      }
      if (!error_.empty()) return;
      if (instruction.destination < begin || instruction.destination >= end)
        return fail("{}: writes operand {}, out of [{}, {})", place, instruction.destination, begin, end);
      written_[instruction.destination] = true;
    }
  }

  void check_read(const std::string& place, Operand operand, bool uniform) {
    if (operand >= program_.operand_count())
      return fail("{}: reads operand {} of {}", place, operand, program_.operand_count());
    if (uniform && !program_.uniform(operand)) return fail("{}: reads lane value {}", place, operand);
    if (!written_[operand]) return fail("{}: reads operand {} before it is written", place, operand);
  }

  template <class... Args>
  void fail(fmt::format_string<Args...> format, Args&&... args) {
    if (error_.empty()) error_ = fmt::format(format, std::forward<Args>(args)...);
  }

  const Program& program_;
  std::vector<bool> written_;
  std::string error_;
};

}  // namespace

std::string_view input_name(Input input) { return input_names[static_cast<std::size_t>(input)]; }

bool Program::uniform(Operand operand) const {
  if (operand < first_input()) return true;
  if (operand < first_uniform()) return is_uniform(inputs[operand - first_input()]);
  return operand < first_row();
}

std::string verify(const Program& program) {
  const std::size_t operands =
      program.constants.size() + program.inputs.size() + program.uniform_count + program.row_count;
  if (operands > 65535) return fmt::format("{} operands, more than 65535", operands);
  return Verifier(program).run();
}

}  // namespace tyndall::vm
