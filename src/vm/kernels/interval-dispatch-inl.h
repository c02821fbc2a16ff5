// From an operation to its kernel on intervals: an operation without one does not compile.
#if defined(TYNDALL_VM_KERNELS_INTERVAL_DISPATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_INTERVAL_DISPATCH_INL_H_
#undef TYNDALL_VM_KERNELS_INTERVAL_DISPATCH_INL_H_
#else
#define TYNDALL_VM_KERNELS_INTERVAL_DISPATCH_INL_H_
#endif

#include "vm/kernels/interval-fields-inl.h"
#include "vm/kernels/interval-functions-inl.h"
#include "vm/op.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// BoundKernel<Op::add>::run(options, a, b) is bound_add(options, a, b).
template <Op op>
struct BoundKernel;
#define X(name, operand_count)                                          \
  template <>                                                           \
  struct BoundKernel<Op::name> {                                        \
    static constexpr std::size_t operands = operand_count;              \
    template <class... B>                                               \
    static TYNDALL_VM_INLINE auto run(const Options& options, B... b) { \
      return bound_##name(options, b...);                               \
    }                                                                   \
  };
TYNDALL_VM_OPS(X)
#undef X

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
