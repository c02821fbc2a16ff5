// The operations of the shader VM. Every value is a float; vectors are three operands, booleans are 0 or 1.
#pragma once

#include <cstdint>
#include <iterator>
#include <string_view>

namespace tyndall::vm {

enum class Op : std::uint8_t {
#define TYNDALL_OP(name, operands, cost, traits) name,
#include "vm/program/operations.inc"
};

// What the compiler and the machine know of an operation besides its kernel.
struct OpTrait {
  enum Bit : unsigned {
    none = 0,
    brief = 1,        // a few machine instructions a vector: four vectors a round
    chain = 2,        // one long chain, each step waiting for the one before: two vectors alternate
    octaves = 4,      // Instruction::count is the number of octaves
    seed = 8,         // Instruction::immediate is the seed
    plane = 16,       // Instruction::immediate is the index of one of the program's planes
    float_only = 32,  // hashes the bits of floats, or reads a table: has no form in double
    fraction = 64,    // its results are in [0, 1]
    lattice = 128,    // made of a lattice of whole coordinates, which floats lose far from the origin
    voxels = 256,     // Instruction::immediate is the index of one of the program's voxels
  };
};

// Octaves of fbm, turbulence and ridged: 1 to this.
inline constexpr int max_octaves = 32;

struct OpInfo {
  std::string_view name;
  int operands;
  double cost;  // [ns] a lane, of an octave where it has octaves
  unsigned traits;

  constexpr bool has(OpTrait::Bit trait) const { return (traits & trait) != 0; }
  // In one of the program's tables.
  constexpr bool looks_up() const { return has(OpTrait::plane) || has(OpTrait::voxels); }
};
struct OpTable : OpTrait {
  static constexpr OpInfo rows[] = {
  // in the order of Op
#define TYNDALL_OP(name, operands, cost, traits) {#name, operands, cost, traits},
#include "vm/program/operations.inc"
  };
};
constexpr const OpInfo& op_info(Op op) { return OpTable::rows[static_cast<unsigned>(op)]; }
inline constexpr int op_count = static_cast<int>(std::size(OpTable::rows));

// Nanoseconds a lane in full batches on one processor with AVX-512; elsewhere the ratios are about the same.
constexpr double op_cost(Op op, std::uint8_t octaves) {
  const OpInfo& info = op_info(op);
  return info.has(OpTrait::octaves) ? info.cost * octaves : info.cost;
}

}  // namespace tyndall::vm
