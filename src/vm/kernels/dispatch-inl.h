// From an operation to its kernels: of lanes, and of intervals of them.
#if defined(TYNDALL_VM_KERNELS_DISPATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_DISPATCH_INL_H_
#undef TYNDALL_VM_KERNELS_DISPATCH_INL_H_
#else
#define TYNDALL_VM_KERNELS_DISPATCH_INL_H_
#endif

#include "vm/kernels/blackbody-inl.h"
#include "vm/kernels/exponential-inl.h"
#include "vm/kernels/fields-inl.h"
#include "vm/kernels/hash-inl.h"
#include "vm/kernels/interval-fields-inl.h"
#include "vm/kernels/planes-inl.h"
#include "vm/kernels/trigonometric-inl.h"
#include "vm/kernels/voxels-inl.h"
#include "vm/kernels/worley-inl.h"
#include "vm/program/op.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Kernel<Op::add>::run(options, a, b) is op_add(options, a, b), and BoundKernel<Op::add>::run is bound_add.
// An operation without both does not compile.
template <Op op>
struct Kernel;
template <Op op>
struct BoundKernel;
#define TYNDALL_OP(name, operand_count, cost, traits)                   \
  template <>                                                           \
  struct Kernel<Op::name> {                                             \
    static constexpr std::size_t operands = operand_count;              \
    template <class... V>                                               \
    static TYNDALL_VM_INLINE auto run(const Options& options, V... v) { \
      return op_##name(options, v...);                                  \
    }                                                                   \
  };                                                                    \
  template <>                                                           \
  struct BoundKernel<Op::name> {                                        \
    static constexpr std::size_t operands = operand_count;              \
    template <class... B>                                               \
    static TYNDALL_VM_INLINE auto run(const Options& options, B... b) { \
      return bound_##name(options, b...);                               \
    }                                                                   \
  };
#include "vm/program/operations.inc"

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
