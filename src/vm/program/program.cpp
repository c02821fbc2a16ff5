// What a program says about its operands, and its name for machines.
#include "vm/program/program.h"

#include <bit>

namespace tyndall::vm {

namespace {

constexpr std::array<std::string_view, input_count> input_names = {
    "p.x",  "p.y",  "p.z", "P.x", "P.y", "P.z",    "n.x", "n.y",   "n.z",  "N.x",   "N.y",   "N.z",  "uv.x",
    "uv.y", "time", "t.x", "t.y", "t.z", "t.sign", "red", "green", "blue", "alpha", "uv2.x", "uv2.y"};

}  // namespace

std::string_view input_name(Input input) { return input_names[static_cast<std::size_t>(input)]; }

bool Program::uniform(Operand operand) const {
  if (operand < first_input()) return true;
  if (operand < first_uniform()) return is_uniform(inputs[operand - first_input()]);
  return operand < first_row();
}

std::uint64_t fingerprint_of(const Program& program) {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  const auto mix = [&](std::uint64_t value) {
    hash = (hash ^ value) * 0xd6e8feb86659fd93u;
    hash ^= hash >> 32;
  };
  const auto mix_code = [&](const std::vector<Instruction>& code) {
    mix(code.size());
    for (const Instruction& i : code) {
      mix(static_cast<std::uint64_t>(i.op) | std::uint64_t{i.count} << 8 |
          std::uint64_t{i.destination} << 16 | std::uint64_t{i.immediate} << 32);
      for (const Operand operand : i.operands) mix(operand);
    }
  };
  mix(program.constants.size());
  for (const float constant : program.constants) mix(std::bit_cast<std::uint32_t>(constant));
  mix(program.inputs.size());
  for (const Input input : program.inputs) mix(static_cast<std::uint64_t>(input));
  mix(program.uniform_count);
  mix(program.row_count);
  mix_code(program.uniform_code);
  mix_code(program.lane_code);
  mix(program.guards.size());
  for (const Guard& guard : program.guards) {
    mix(std::uint64_t{guard.first} << 32 | guard.last);
    mix(std::uint64_t{guard.condition} << 1 | guard.when);
  }
  mix(program.tables.planes.size());
  for (const PlanePointer& plane : program.tables.planes) mix(plane->hash);
  mix(program.tables.voxels.size());
  for (const VoxelsPointer& voxels : program.tables.voxels) mix(voxels->hash);
  mix(program.outputs.size());
  for (const Operand output : program.outputs) mix(output);
  return hash != 0 ? hash : 1;
}

}  // namespace tyndall::vm
