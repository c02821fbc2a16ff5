// Lays out the bounds of a program's values and runs its code over batches of boxes.
#include "vm/interval/interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

#include "base/check.h"
#include "vm/interval/interval_simd.h"
#include "vm/run/simd.h"

namespace tyndall::vm {

// Three rows a value: first of what is the same for all boxes, one vector each, then of boxes.
struct IntervalMachine::Memory {
  struct Free {
    void operator()(float* p) const { ::operator delete[](p, std::align_val_t{alignment}); }
  };
  static constexpr std::size_t alignment = 64;

  std::unique_ptr<float[], Free> values;
  std::size_t size = 0;
  std::vector<BoundView> operands;

  void reserve(std::size_t floats, std::size_t operand_count) {
    if (floats > size) {
      values.reset(
          static_cast<float*>(::operator new[](floats * sizeof(float), std::align_val_t{alignment})));
      size = floats;
    }
    if (operand_count > operands.size()) operands.resize(operand_count);
  }
};

IntervalMachine::IntervalMachine() : memory_(std::make_unique<Memory>()) {}
IntervalMachine::~IntervalMachine() = default;

namespace {

constexpr float endless = std::numeric_limits<float>::infinity();

// A bound without end may be NaN: the kernels' invariant. NaN for an end is no end.
void write(const BoundView& view, std::size_t i, float lo, float hi) {
  view.data[i] = lo > -endless ? lo : -endless;
  view.data[view.pitch + i] = hi < endless ? hi : endless;
  view.data[2 * view.pitch + i] = hi - lo < endless ? 0.0f : 1.0f;
}

void write_everywhere(const BoundView& view, float lo, float hi) {
  for (std::size_t i = 0; i < widest_vector; ++i) write(view, i, lo, hi);
}

// A constant that is not a number has no value that is one.
void write_constant(const BoundView& view, float value) {
  write_everywhere(view, std::isnan(value) ? 0 : value, std::isnan(value) ? 0 : value);
  if (std::isnan(value)) std::fill_n(view.data + 2 * view.pitch, widest_vector, 1.0f);
}

// The boxes' ends, and the last box again up to `padded`.
void write_boxes(const BoundView& view, const float* lo, const float* hi, std::size_t boxes,
                 std::size_t padded) {
  float* const low = view.data;
  float* const high = view.data + view.pitch;
  float* const nan = view.data + 2 * view.pitch;
  for (std::size_t i = 0; i < boxes; ++i) low[i] = lo[i] > -endless ? lo[i] : -endless;
  for (std::size_t i = 0; i < boxes; ++i) high[i] = hi[i] < endless ? hi[i] : endless;
  for (std::size_t i = 0; i < boxes; ++i) nan[i] = hi[i] - lo[i] < endless ? 0.0f : 1.0f;
  for (std::size_t i = boxes; i < padded; ++i) write(view, i, lo[boxes - 1], hi[boxes - 1]);
}

ValueBounds read(const BoundView& view, std::size_t i) {
  const float* place = view.data + (i & view.lane_mask);
  return {place[0], place[view.pitch], place[2 * view.pitch] > 0};
}

}  // namespace

void IntervalMachine::run(const Program& program, const BoxInputs& inputs, std::size_t boxes,
                          std::span<ValueBounds> outputs) {
  CHECK_EQ(outputs.size(), program.outputs.size() * boxes);
  if (boxes == 0) return;
  boxes_run_ += boxes;
  const std::size_t vector = simd_lanes();
  const auto pad = [&](std::size_t n) { return (n + vector - 1) / vector * vector; };
  const std::size_t pitch =
      (pad(std::min(boxes, max_boxes)) + widest_vector - 1) / widest_vector * widest_vector;
  const std::size_t first_row = program.first_row();
  memory_->reserve(3 * (first_row * widest_vector + (program.inputs.size() + program.row_count) * pitch),
                   program.operand_count());
  BoundView* const operands = memory_->operands.data();
  float* next = memory_->values.get();
  const auto place = [&](bool uniform) {
    const std::size_t length = uniform ? widest_vector : pitch;
    const BoundView view{next, length, uniform ? 0 : ~std::size_t{0}};
    next += 3 * length;
    return view;
  };
  for (std::size_t k = 0; k < program.operand_count(); ++k)
    operands[k] = place(program.uniform(static_cast<Operand>(k)));
  for (std::size_t k = 0; k < program.constants.size(); ++k)
    write_constant(operands[k], program.constants[k]);
  const auto ends = [&](Input input) {
    const auto k = static_cast<std::size_t>(input);
    CHECK(inputs.lowest[k] != nullptr && inputs.highest[k] != nullptr);
    return std::pair(inputs.lowest[k], inputs.highest[k]);
  };
  for (std::size_t k = 0; k < program.inputs.size(); ++k)
    if (is_uniform(program.inputs[k]))
      write_everywhere(operands[program.first_input() + k], *ends(program.inputs[k]).first,
                       *ends(program.inputs[k]).second);

  if (!program.uniform_code.empty())
    run_interval_code(program.uniform_code, operands, vector, program.tables);
  for (std::size_t begin = 0; begin < boxes; begin += max_boxes) {
    const std::size_t used = std::min(max_boxes, boxes - begin), issued = pad(used);
    for (std::size_t k = 0; k < program.inputs.size(); ++k)
      if (!is_uniform(program.inputs[k]))
        write_boxes(operands[program.first_input() + k], ends(program.inputs[k]).first + begin,
                    ends(program.inputs[k]).second + begin, used, issued);
    run_interval_code(program.lane_code, operands, issued, program.tables);
    for (std::size_t k = 0; k < program.outputs.size(); ++k) {
      const BoundView view = operands[program.outputs[k]];
      ValueBounds* const out = outputs.data() + k * boxes + begin;
      for (std::size_t i = 0; i < used; ++i) out[i] = read(view, i);
    }
  }
}

ValueBounds evaluate_bounds(Op op, std::span<const ValueBounds> operands, std::uint8_t count,
                            std::uint32_t immediate, const Tables& tables) {
  const auto needed = static_cast<std::size_t>(op_info(op).operands);
  CHECK_EQ(operands.size(), needed);
  alignas(64) float values[5][3 * widest_vector];
  BoundView views[5];
  Instruction instruction;
  instruction.op = op;
  instruction.count = count;
  instruction.immediate = immediate;
  instruction.destination = 4;
  for (std::size_t k = 0; k < 5; ++k) views[k] = {values[k], widest_vector, ~std::size_t{0}};
  for (std::size_t k = 0; k < needed; ++k) {
    instruction.operands[k] = static_cast<Operand>(k);
    write_everywhere(views[k], operands[k].lo, operands[k].hi);
    if (operands[k].may_be_nan) std::fill_n(views[k].data + 2 * widest_vector, widest_vector, 1.0f);
  }
  run_interval_code(std::span(&instruction, 1), views, simd_lanes(), tables);
  return read(views[4], 0);
}

}  // namespace tyndall::vm
