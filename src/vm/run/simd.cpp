// Instructions over vectors of lanes, for every SIMD class.
#include "vm/run/simd.h"

#include <utility>

#include "vm/program/op.h"
#include "vm/run/machine.h"

#if defined(__SANITIZE_ADDRESS__)
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)  // instrumented code takes minutes each
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vm/run/simd.cpp"
#include "hwy/foreach_target.h"
//
#include "vm/kernels/dispatch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Operand k of the vector at lane i.
template <std::size_t k>
TYNDALL_VM_INLINE Floats operand_at(const Step& step, std::size_t i) {
  return Floats(hn::LoadU(FloatTag(), step.operands[k] + (step.lane_mask[k] & i)));
}

// A batch of one vector waits for what surrounds the kernel, so the way to it is short.
template <Op op, std::size_t... k>
TYNDALL_VM_INLINE void run_over_lanes(const Step& step, std::size_t first, std::size_t lanes,
                                      std::index_sequence<k...>) {
  const FloatTag d;
  const std::size_t width = hn::Lanes(d);
  const Options options{step.octaves, step.seed, step.tables};
  std::size_t i = first;
  const std::size_t end = first + lanes;
  if constexpr (op_info(op).has(OpTrait::chain)) {
    for (; i + width < end; i += 2 * width) {
      const FloatsPair result =
          Kernel<op>::run(options, FloatsPair(operand_at<k>(step, i), operand_at<k>(step, i + width))...);
      hn::StoreU(result.a.raw, d, step.destination + i);
      hn::StoreU(result.b.raw, d, step.destination + i + width);
    }
  }
  for (; i < end; i += width)
    hn::StoreU(Kernel<op>::run(options, operand_at<k>(step, i)...).raw, d, step.destination + i);
}

// Four vectors at a time: the short kernels are bound by what surrounds them.
template <Op op, std::size_t... k>
TYNDALL_VM_INLINE void run_short_over_lanes(const Step& step, std::size_t first, std::size_t lanes,
                                            std::index_sequence<k...> operands) {
  const FloatTag d;
  const std::size_t width = hn::Lanes(d);
  if (lanes < 4 * width) return run_over_lanes<op>(step, first, lanes, operands);
  const Options options{step.octaves, step.seed, step.tables};
  // Where each operand is read, and how far on the next vector is: 0 when all lanes read the same one.
  const float* place[] = {step.operands[k] + (step.lane_mask[k] & first)...};
  const std::size_t stride[] = {(step.lane_mask[k] & width)...};
  float* out = step.destination + first;
  float* const end = out + lanes;
  const auto compute = [&](std::size_t vectors_on) HWY_ATTR {
    const Floats result =
        Kernel<op>::run(options, Floats(hn::LoadU(d, place[k] + vectors_on * stride[k]))...);
    hn::StoreU(result.raw, d, out + vectors_on * width);
  };
  for (; end - out >= static_cast<std::ptrdiff_t>(4 * width); out += 4 * width) {
    compute(0), compute(1), compute(2), compute(3);
    ((place[k] += 4 * stride[k]), ...);
  }
  for (; out < end; out += width) {
    compute(0);
    ((place[k] += stride[k]), ...);
  }
}

template <Op op>
void run_step(const Step& step, std::size_t first, std::size_t lanes) {
  constexpr auto operands = std::make_index_sequence<Kernel<op>::operands>();
  if constexpr (op_info(op).has(OpTrait::brief))
    run_short_over_lanes<op>(step, first, lanes, operands);
  else
    run_over_lanes<op>(step, first, lanes, operands);
}

constexpr StepFunction functions[] = {
#define TYNDALL_OP(name, operands, cost, traits) &run_step<Op::name>,
#include "vm/program/operations.inc"
};

std::span<const StepFunction> functions_simd() { return functions; }
std::size_t lanes_simd() { return hn::Lanes(FloatTag()); }
const char* name_simd() { return hwy::TargetName(HWY_TARGET); }

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyndall::vm {

HWY_EXPORT(functions_simd);
HWY_EXPORT(lanes_simd);
HWY_EXPORT(name_simd);

std::span<const StepFunction> step_functions() { return HWY_DYNAMIC_DISPATCH(functions_simd)(); }
std::size_t simd_lanes() { return HWY_DYNAMIC_DISPATCH(lanes_simd)(); }
std::string simd_name() { return HWY_DYNAMIC_DISPATCH(name_simd)(); }

}  // namespace tyndall::vm
#endif
