// Bytecode: what `shader` writes and the machine runs. The contract between the two; they share nothing else.
//
// Operands are indices into one space of values:
//   [0, constants)                      constants, the same for every lane and every run
//   [.., + inputs)                      what the caller supplies: per lane or uniform, see Input
//   [.., + uniforms)                    values computed once per run (they depend on uniform inputs alone)
//   [.., + rows)                        values per lane
// Code is in two parts: `uniform_code` writes uniforms and runs once per batch; `lane_code` writes rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "vm/program/op.h"
#include "vm/program/tables.h"

namespace tyndall::vm {

// What a body can read. p: position just inside the volume's transform (or on a surface: object space);
// P: world position [m]; n, N: normals in object and world space; time [s]. Those from t_x on are a mesh's
// own (scene::TriangleMesh), which no body of the language reads: t is in object space, t_sign that of n × t.
enum class Input : std::uint8_t {
  p_x,
  p_y,
  p_z,
  P_x,
  P_y,
  P_z,
  n_x,
  n_y,
  n_z,
  N_x,
  N_y,
  N_z,
  u,
  v,
  time,
  t_x,
  t_y,
  t_z,
  t_sign,
  red,
  green,
  blue,
  alpha,
  second_u,
  second_v
};
inline constexpr int input_count = 25;
constexpr bool is_of_mesh(Input input) { return input >= Input::t_x; }
std::string_view input_name(Input input);
// The same for all lanes of a run.
constexpr bool is_uniform(Input input) { return input == Input::time; }

using Operand = std::uint16_t;

struct Instruction {
  Op op = Op::copy;
  std::uint8_t count = 0;  // octaves
  Operand destination = 0;
  std::array<Operand, 4> operands{};  // as many as op_info(op).operands
  std::uint32_t immediate = 0;        // seed, or index in one of the program's tables

  bool operator==(const Instruction&) const = default;
};
static_assert(sizeof(Instruction) == 16);

// Instructions [first, last) of the lane code, which lanes may do without where the condition is 0 (`when`)
// or is not 0 (not `when`): what they write is read only in there, and by selects on that condition, which
// take nothing of it in those lanes. So whoever looks at all lanes at once (the reference, bounds over boxes)
// may ignore guards and run everything; a guard is leave to skip, never a command. Guards nest.
struct Guard {
  std::uint32_t first = 0, last = 0;
  Operand condition = 0;
  bool when = true;

  bool operator==(const Guard&) const = default;
};

struct Program {
  std::vector<float> constants;
  std::vector<Input> inputs;  // in operand order, each once
  std::uint16_t uniform_count = 0;
  std::uint16_t row_count = 0;
  std::vector<Instruction> uniform_code, lane_code;
  std::vector<Guard> guards;                    // by first; outer ones before inner ones
  Tables tables;                                // each of their entries is read by some instruction
  std::vector<Operand> outputs;                 // any operand: a constant output needs no code
  std::vector<Span> uniform_spans, lane_spans;  // the source of each instruction, for listings and reports
  // Names what the program computes: programs with the same one are the same to a machine, which lays out
  // each once. 0: not known, laid out for every run.
  std::uint64_t fingerprint = 0;

  Operand first_input() const { return static_cast<Operand>(constants.size()); }
  bool reads(Input input) const { return std::find(inputs.begin(), inputs.end(), input) != inputs.end(); }
  Operand first_uniform() const { return static_cast<Operand>(first_input() + inputs.size()); }
  Operand first_row() const { return static_cast<Operand>(first_uniform() + uniform_count); }
  std::size_t operand_count() const { return std::size_t{first_row()} + row_count; }
  // True when the operand has the same value for every lane.
  bool uniform(Operand operand) const;
  // True when the operand is a constant of the program.
  bool constant(Operand operand) const { return operand < constants.size(); }
};

// A hash of all that a run depends on; never 0. A program that is changed needs a new one.
std::uint64_t fingerprint_of(const Program& program);

// The laws every program obeys: operands in range, rows and uniforms written before they are read, uniform
// code reads no lane values, counts in their limits, guards nested and what they guard read where Guard says.
// Returns the first violation, or an empty string.
std::string verify(const Program& program);

// The listing of `inspect --stage bytecode`: one instruction a line; with sources, the source line above each
// run of instructions that came from it.
std::string print(const Program& program, const Sources* sources = nullptr);

}  // namespace tyndall::vm
