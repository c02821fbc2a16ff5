// Bounds of programs: what every value can be, over boxes of their inputs (position × time).
//
// The same bytecode as the machine's, run on intervals. Sound: whatever the machine computes for inputs in
// the box lies in the bound, rounding, discontinuities and NaN included. An input outside of its box is not
// covered: callers make boxes a little larger than the points they stand for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "vm/program/program.h"
#include "vm/run/machine.h"

namespace tyndall::vm {

// Every value that is not NaN lies in [lo, hi]; NaN occurs only where `may_be_nan`. Without end: infinite.
struct ValueBounds {
  float lo = 0, hi = 0;
  bool may_be_nan = false;

  bool operator==(const ValueBounds&) const = default;
  bool covers(float value) const { return value != value ? may_be_nan : lo <= value && value <= hi; }
};

// The boxes' ends: one float a box for `lowest` and `highest` (one in all for uniform inputs). Only the
// inputs that the program names are read.
struct BoxInputs {
  std::array<const float*, input_count> lowest{}, highest{};

  void set(Input input, const float* lo, const float* hi) {
    lowest[static_cast<std::size_t>(input)] = lo;
    highest[static_cast<std::size_t>(input)] = hi;
  }
};

// One thread's machine for bounds: boxes are its lanes. A box's result depends on neither its place in the
// batch nor the batch's size.
class IntervalMachine {
 public:
  IntervalMachine();
  ~IntervalMachine();
  IntervalMachine(const IntervalMachine&) = delete;
  IntervalMachine& operator=(const IntervalMachine&) = delete;

  // Bounds of every output over every box: output k of box i goes to outputs[k * boxes + i].
  void run(const Program& program, const BoxInputs& inputs, std::size_t boxes,
           std::span<ValueBounds> outputs);

  static constexpr std::size_t max_boxes =
      64;  // at a time: three rows a value must stay in the nearest cache

  std::uint64_t boxes_run() const { return boxes_run_; }

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
  std::uint64_t boxes_run_ = 0;
};

// One operation on one bound, by the very kernels of the machine: for tests.
ValueBounds evaluate_bounds(Op op, std::span<const ValueBounds> operands, std::uint8_t count = 0,
                            std::uint32_t immediate = 0, const Tables& tables = {});

}  // namespace tyndall::vm
