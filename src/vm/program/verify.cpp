// The laws that every program obeys.
#include <fmt/format.h>

#include <bitset>
#include <map>
#include <tuple>

#include "vm/program/program.h"

namespace tyndall::vm {

namespace {

// Checks the code in order, remembering what has been written so far.
class Verifier {
 public:
  explicit Verifier(const Program& program) : program_(program), written_(program.operand_count()) {
    for (std::size_t i = 0; i < program.first_uniform(); ++i) written_[i] = {1, whole};
  }

  std::string run() {
    check_shape();
    if (error_.empty()) check_guards();
    if (error_.empty()) check_code("uniform code", program_.uniform_code, true);
    if (error_.empty()) check_code("lane code", program_.lane_code, false);
    for (std::size_t i = 0; i < program_.outputs.size() && error_.empty(); ++i)
      check_read(fmt::format("output {}", i), program_.outputs[i], false, whole);
    return error_;
  }

 private:
  void check_shape() {
    for (const PlanePointer& plane : program_.tables.planes)
      if (!plane) return fail("a plane is missing");
    for (const VoxelsPointer& voxels : program_.tables.voxels)
      if (!voxels) return fail("voxels are missing");
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
      if (!uniform) open_and_close_guards(place, i);
      if (!error_.empty()) return;
      if (static_cast<int>(instruction.op) >= op_count) return fail("{}: unknown operation", place);
      const OpInfo& info = op_info(instruction.op);
      const int octaves = instruction.count;
      if (info.has(OpTrait::octaves) ? octaves < 1 || octaves > max_octaves : octaves != 0)
        return fail("{}: {} with {} octaves", place, info.name, octaves);
      const Tables& tables = program_.tables;
      if (info.has(OpTrait::plane) && instruction.immediate >= tables.planes.size())
        return fail("{}: plane {} of {}", place, instruction.immediate, tables.planes.size());
      if (info.has(OpTrait::voxels) && instruction.immediate >= tables.voxels.size())
        return fail("{}: voxels {} of {}", place, instruction.immediate, tables.voxels.size());
      if (!info.has(OpTrait::seed) && !info.looks_up() && instruction.immediate != 0)
        return fail("{}: {} takes no seed", place, info.name);
      for (std::size_t k = 0; k < instruction.operands.size() && error_.empty(); ++k) {
        if (k < static_cast<std::size_t>(info.operands))
          check_read(place, instruction.operands[k], uniform, branch(instruction, k));
        else if (instruction.operands[k] != 0)
          return fail("{}: operand {} of {} is not zero", place, k, info.name);
      }
      if (!error_.empty()) return;
      if (instruction.destination < begin || instruction.destination >= end)
        return fail("{}: writes operand {}, out of [{}, {})", place, instruction.destination, begin, end);
      written_[instruction.destination] = {next_version_++, block_};
    }
  }

  void check_guards() {
    std::vector<std::uint32_t> ends;
    std::uint32_t first = 0;
    for (const Guard& guard : program_.guards) {
      while (!ends.empty() && ends.back() <= guard.first) ends.pop_back();
      if (guard.first < first || guard.last <= guard.first || guard.last > program_.lane_code.size() ||
          (!ends.empty() && guard.last > ends.back()))
        return fail("guards are not in order: [{}, {})", guard.first, guard.last);
      first = guard.first;
      ends.push_back(guard.last);
    }
  }

  // Guards that end or begin before instruction i.
  void open_and_close_guards(const std::string& place, std::size_t i) {
    while (!open_.empty() && open_.back().last == i) {
      block_ = open_.back().around;
      open_.pop_back();
    }
    for (; next_guard_ < program_.guards.size() && program_.guards[next_guard_].first == i; ++next_guard_) {
      const Guard& guard = program_.guards[next_guard_];
      check_read(place, guard.condition, false, block_);
      if (!error_.empty()) return;
      open_.push_back({guard.last, block_});
      block_ = block_inside(block_, guard.condition, guard.when);
    }
  }

  // Where a value is there: in all lanes, or in those that some conditions leave.
  using Block = std::size_t;
  static constexpr Block whole = 0;
  Block block_inside(Block around, Operand condition, bool when) {
    const auto key = std::tuple(around, condition, written_[condition].version, when);
    const auto [found, added] = blocks_.try_emplace(key, parents_.size());
    if (added) parents_.push_back(around);
    return found->second;
  }
  // Where operand k of the instruction is looked at.
  Block branch(const Instruction& instruction, std::size_t k) {
    if (instruction.op != Op::select || k == 0 || instruction.operands[0] >= written_.size()) return block_;
    return block_inside(block_, instruction.operands[0], k == 1);
  }

  void check_read(const std::string& place, Operand operand, bool uniform, Block block) {
    if (operand >= program_.operand_count())
      return fail("{}: reads operand {} of {}", place, operand, program_.operand_count());
    if (uniform && !program_.uniform(operand)) return fail("{}: reads lane value {}", place, operand);
    if (written_[operand].version == 0)
      return fail("{}: reads operand {} before it is written", place, operand);
    while (block != whole && block != written_[operand].block) block = parents_[block];
    if (block != written_[operand].block)
      fail("{}: reads operand {} in lanes that may have skipped it", place, operand);
  }

  template <class... Args>
  void fail(fmt::format_string<Args...> format, Args&&... args) {
    if (error_.empty()) error_ = fmt::format(format, std::forward<Args>(args)...);
  }

  struct Written {
    std::uint32_t version = 0;  // 0: not yet
    Block block = whole;
  };
  struct Open {
    std::size_t last;
    Block around;
  };

  const Program& program_;
  std::vector<Written> written_;
  std::uint32_t next_version_ = 2;
  Block block_ = whole;
  std::vector<Block> parents_ = {whole};
  std::map<std::tuple<Block, Operand, std::uint32_t, bool>, Block> blocks_;
  std::vector<Open> open_;
  std::size_t next_guard_ = 0;
  std::string error_;
};

}  // namespace

std::string verify(const Program& program) {
  const std::size_t operands =
      program.constants.size() + program.inputs.size() + program.uniform_count + program.row_count;
  if (operands > 65535) return fmt::format("{} operands, more than 65535", operands);
  return Verifier(program).run();
}

}  // namespace tyndall::vm
