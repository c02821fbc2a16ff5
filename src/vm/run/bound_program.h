// A program laid out in a machine's memory: steps that point at their operands, constants already spread.
#pragma once

#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "vm/run/machine.h"
#include "vm/run/simd.h"

namespace tyndall::vm {

// Floats at an address that is a multiple of 64.
struct AlignedFree {
  static constexpr std::align_val_t alignment{64};
  void operator()(float* p) const { ::operator delete[](p, alignment); }
};
using AlignedFloats = std::unique_ptr<float[], AlignedFree>;
AlignedFloats aligned_floats(std::size_t count);

// Rows of max_lanes floats that all programs of a machine share. A row never moves.
class Rows {
 public:
  float* operator[](std::size_t row);

 private:
  // One vector more than the lanes: rows at multiples of 1 KB would fall into few sets of the cache, and
  // stores would seem to be at the address of later loads (they are compared by their low 12 bits).
  static constexpr std::size_t pitch = Machine::max_lanes + widest_vector;
  static constexpr std::size_t rows_a_block = 16;
  std::vector<AlignedFloats> blocks_;
};

// The pointers of steps and guards that follow a row of the caller's.
struct RowPlaces {
  std::vector<const float**> read;
  std::vector<float**> written;
  const float* current = nullptr;  // where they point now

  void point_at(float* row) {
    if (row == current) return;
    current = row;
    for (const float** place : read) *place = row;
    for (float** place : written) *place = row;
  }
};

class Prepared {
 public:
  Prepared(const Program& program, Rows& rows);

  // Sets what is the same for all lanes; computes uniforms again only if an input of theirs changed.
  void set_uniform_inputs(const Program& program, const BatchInputs& inputs);

  // The lane input (by its index in program.inputs) is read at `from`; null: at its row, see input_row().
  void read_input(std::size_t input, const float* from) {
    LaneInput& i = inputs_[input];
    i.places.point_at(from ? const_cast<float*>(from) : i.row);  // inputs have no places that are written
  }
  float* input_row(std::size_t input) const { return inputs_[input].row; }

  // An output (by its index in program.outputs).
  struct Output {
    const float* uniform = nullptr;  // one value for all lanes
    float* row = nullptr;            // where the code leaves it
    std::int32_t input = -1;         // or: the input that it is
    std::int32_t same_as = -1;       // or: the earlier output that it is
    RowPlaces places;                // of the row, from its last writer on
  };
  const std::vector<Output>& outputs() const { return outputs_; }
  // Whether the code leaves every output in a row of its own.
  bool outputs_are_rows() const { return outputs_are_rows_; }
  // The output, which must have places, is written to `to` from now on; null: to its row.
  void write_output(std::size_t output, float* to) {
    Output& o = outputs_[output];
    o.places.point_at(to ? to : o.row);
  }

  const std::vector<Step>& steps() const { return lane_steps_; }

  // Steps [first, last), for lanes where the condition says so.
  struct Guard {
    std::uint32_t first, last;
    const float* condition;
    std::size_t lane_mask;  // 0: all lanes have the first one's
    bool when;
    std::uint32_t next;           // the first guard that is not in this one
    std::uint64_t lanes_run = 0;  // that passed it
  };
  std::vector<Guard>& guards() { return guards_; }
  const std::vector<Guard>& guards() const { return guards_; }
  std::uint64_t lanes_run = 0;  // in all
  std::span<const StepFunction> functions() const { return functions_; }
  // Of the SIMD class that it was prepared for.
  std::size_t vector_lanes() const { return vector_lanes_; }

 private:
  struct LaneInput {
    float* row = nullptr;  // null for a uniform one
    RowPlaces places;
  };
  void add_steps(const std::vector<Instruction>& code, std::vector<Step>& steps) const;
  void add_guards(const Program& program);
  void find_places(const Program& program);

  std::span<const StepFunction> functions_;
  std::size_t vector_lanes_;
  AlignedFloats fixed_;  // one vector for each operand that is the same for all lanes
  struct Place {
    float* data;
    bool lane;
  };
  std::unique_ptr<const Tables> tables_;  // steps point at it
  std::vector<Place> operands_;
  std::vector<Step> uniform_steps_, lane_steps_;
  std::vector<Guard> guards_;
  std::vector<LaneInput> inputs_;
  std::vector<Output> outputs_;
  bool outputs_are_rows_ = true;
  bool has_uniform_inputs_ = false;
  bool uniforms_valid_ = false;
};

}  // namespace tyndall::vm
