// Instructions over vectors of lanes, for every SIMD class.
#include "vm/simd.h"

#include <utility>

#include "vm/machine.h"
#include "vm/op.h"

#if defined(__SANITIZE_ADDRESS__)
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)  // instrumented code takes minutes each
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vm/simd.cpp"
#include "hwy/foreach_target.h"
//
#include "vm/kernels/dispatch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Operations of a few instructions a vector.
constexpr bool is_short(Op op) { return op < Op::pow || (op > Op::atan2 && op < Op::noise3); }

// Where one operand is read: the next vector is `step` floats on, or the same one again.
struct Reader {
  const float* place;
  std::size_t step;
};

// Two vectors at a time: the short kernels are bound by what surrounds them.
template <Op op, std::size_t... k>
TYNDALL_VM_INLINE void run_over_lanes(const Instruction& instruction, const OperandView* operands,
                                      std::size_t lanes, std::index_sequence<k...>) {
  const FloatTag d;
  const std::size_t width = hn::Lanes(d);
  const Options options{instruction.count, instruction.immediate};
  Reader readers[] = {
      {operands[instruction.operands[k]].data, operands[instruction.operands[k]].lane_mask & width}...};
  float* out = operands[instruction.destination].data;
  float* const end = out + lanes;
  if constexpr (is_short(op)) {
    for (; end - out >= static_cast<std::ptrdiff_t>(2 * width); out += 2 * width) {
      const Floats first = Kernel<op>::run(options, Floats(hn::LoadU(d, readers[k].place))...);
      const Floats second =
          Kernel<op>::run(options, Floats(hn::LoadU(d, readers[k].place + readers[k].step))...);
      hn::Store(first.raw, d, out);
      hn::Store(second.raw, d, out + width);
      ((readers[k].place += 2 * readers[k].step), ...);
    }
  }
  for (; out < end; out += width) {
    const Floats result = Kernel<op>::run(options, Floats(hn::LoadU(d, readers[k].place))...);
    hn::Store(result.raw, d, out);
    ((readers[k].place += readers[k].step), ...);
  }
}

template <Op op>
void run_instruction(const Instruction& instruction, const OperandView* operands, std::size_t lanes) {
  run_over_lanes<op>(instruction, operands, lanes, std::make_index_sequence<Kernel<op>::operands>());
}

using InstructionFunction = void (*)(const Instruction&, const OperandView*, std::size_t);

constexpr InstructionFunction instruction_functions[] = {
#define X(name, operand_count) &run_instruction<Op::name>,
    TYNDALL_VM_OPS(X)
#undef X
};

void run_code_simd(std::span<const Instruction> code, const OperandView* operands, std::size_t lanes) {
  for (const Instruction& instruction : code)
    instruction_functions[static_cast<std::size_t>(instruction.op)](instruction, operands, lanes);
}

void broadcast_simd(std::span<const float> values, float* to) {
  const FloatTag d;
  for (const float value : values) {
    hn::Store(hn::Set(d, value), d, to);
    to += widest_vector;
  }
}

std::size_t lanes_simd() { return hn::Lanes(FloatTag()); }
const char* name_simd() { return hwy::TargetName(HWY_TARGET); }

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyndall::vm {

HWY_EXPORT(run_code_simd);
HWY_EXPORT(broadcast_simd);
HWY_EXPORT(lanes_simd);
HWY_EXPORT(name_simd);

void run_code(std::span<const Instruction> code, const OperandView* operands, std::size_t lanes) {
  HWY_DYNAMIC_DISPATCH(run_code_simd)(code, operands, lanes);
}

void broadcast(std::span<const float> values, float* to) { HWY_DYNAMIC_DISPATCH(broadcast_simd)(values, to); }

std::size_t simd_lanes() { return HWY_DYNAMIC_DISPATCH(lanes_simd)(); }
std::string simd_name() { return HWY_DYNAMIC_DISPATCH(name_simd)(); }

}  // namespace tyndall::vm
#endif
