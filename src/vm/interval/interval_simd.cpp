// Instructions over vectors of boxes, for every SIMD class.
#include "vm/interval/interval_simd.h"

#include <utility>

#include "vm/program/op.h"

#if defined(__SANITIZE_ADDRESS__)
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)  // instrumented code takes minutes each
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vm/interval/interval_simd.cpp"
#include "hwy/foreach_target.h"
//
#include "vm/kernels/dispatch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

TYNDALL_VM_INLINE Bound<Floats> load_bound(const BoundView& view, std::size_t at) {
  const FloatTag d;
  const float* place = view.data + (at & view.lane_mask);
  return {hn::Load(d, place), hn::Load(d, place + view.pitch),
          Floats(hn::Load(d, place + 2 * view.pitch)) > Floats(0.0f)};
}

template <Op op, std::size_t... k>
TYNDALL_VM_INLINE void bound_over_boxes(const Instruction& instruction, const BoundView* operands,
                                        std::size_t boxes, const Tables& tables, std::index_sequence<k...>) {
  const FloatTag d;
  const Options options{instruction.count, instruction.immediate, &tables};
  const BoundView& out = operands[instruction.destination];
  for (std::size_t i = 0; i < boxes; i += hn::Lanes(d)) {
    const Bound<Floats> result =
        BoundKernel<op>::run(options, load_bound(operands[instruction.operands[k]], i)...);
    hn::Store(result.lo.raw, d, out.data + i);
    hn::Store(result.hi.raw, d, out.data + out.pitch + i);
    hn::Store(as_boolean<Floats>(result.nan).raw, d, out.data + 2 * out.pitch + i);
  }
}

template <Op op>
void bound_instruction(const Instruction& instruction, const BoundView* operands, std::size_t boxes,
                       const Tables& tables) {
  bound_over_boxes<op>(instruction, operands, boxes, tables,
                       std::make_index_sequence<BoundKernel<op>::operands>());
}

using BoundFunction = void (*)(const Instruction&, const BoundView*, std::size_t, const Tables&);

constexpr BoundFunction bound_functions[] = {
#define TYNDALL_OP(name, operands, cost, traits) &bound_instruction<Op::name>,
#include "vm/program/operations.inc"
};

void run_interval_code_simd(std::span<const Instruction> code, const BoundView* operands, std::size_t boxes,
                            const Tables& tables) {
  for (const Instruction& instruction : code)
    bound_functions[static_cast<std::size_t>(instruction.op)](instruction, operands, boxes, tables);
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyndall::vm {

HWY_EXPORT(run_interval_code_simd);

void run_interval_code(std::span<const Instruction> code, const BoundView* operands, std::size_t boxes,
                       const Tables& tables) {
  HWY_DYNAMIC_DISPATCH(run_interval_code_simd)(code, operands, boxes, tables);
}

}  // namespace tyndall::vm
#endif
