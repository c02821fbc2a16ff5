// Runs programs over batches of lanes. The SIMD class is chosen at run time (Highway); a lane's result
// depends on neither its place in the batch nor the batch's size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "vm/program/program.h"

namespace tyndall::vm {

// Where the values of inputs are: `lanes[i]` points at one float a lane (or at one float, for uniform
// inputs). Only the inputs that the program names are read. No alignment or padding is asked of the caller.
struct BatchInputs {
  std::array<const float*, input_count> lanes{};

  const float*& operator[](Input input) { return lanes[static_cast<std::size_t>(input)]; }
  const float* operator[](Input input) const { return lanes[static_cast<std::size_t>(input)]; }
};

// Is told of every batch of a machine, for measuring; called from the machine's thread after the batch.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  // `seconds`: what the batch took.
  virtual void ran(const Program& program, const BatchInputs& inputs, std::size_t lanes, double seconds) = 0;
};

// One thread's machine: owns its registers (grown on demand, then reused) and its counters.
class Machine {
 public:
  Machine();
  ~Machine();
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  // Computes every output of the program for `lanes` lanes: outputs[k][i] is output k of lane i. Uniform
  // outputs are written to all lanes too. Any number of lanes, in chunks of at most max_lanes. Outputs may
  // overlap neither inputs nor each other.
  void run(const Program& program, const BatchInputs& inputs, std::size_t lanes,
           std::span<float* const> outputs);
  // Null: none. It must outlive the runs that follow.
  void observe(RunObserver* observer) { observer_ = observer; }

  static constexpr std::size_t max_lanes = 256;

  // Lanes issued to the SIMD units (in whole vectors) and lanes asked for, since the last reset.
  struct Counters {
    std::uint64_t runs = 0, lanes_used = 0, lanes_issued = 0, instructions = 0;
  };
  const Counters& counters() const { return counters_; }
  void reset_counters() { counters_ = {}; }
  // How many lanes each instruction of the program's lane code was run for (in whole vectors) by this
  // machine.
  std::vector<std::uint64_t> lanes_run(const Program& program) const;

 private:
  struct Memory;
  void run_chunks(const Program& program, const BatchInputs& inputs, std::size_t lanes,
                  std::span<float* const> outputs);

  std::unique_ptr<Memory> memory_;
  Counters counters_;
  RunObserver* observer_ = nullptr;
};

// One operation on single numbers, in double (noise and random in float): constant folding in scene code. Not
// for lookups.
double evaluate(Op op, std::span<const double> operands, std::uint8_t count = 0, std::uint32_t immediate = 0);
// One operation on one lane of the very kernel that lane_code uses: folding in bodies.
// `tables` are those that `immediate` counts in.
float evaluate_lane(Op op, std::span<const float> operands, std::uint8_t count = 0,
                    std::uint32_t immediate = 0, const Tables& tables = {});
// The same program by a plain scalar interpreter, without SIMD: the oracle of the tests.
void run_reference(const Program& program, const BatchInputs& inputs, std::size_t lanes,
                   std::span<float* const> outputs);

// The SIMD class in use ("AVX2", "AVX3", "SSE4", …), recorded in image metadata.
std::string simd_name();

}  // namespace tyndall::vm
