// From an operation to its kernel.
#if defined(TYNDALL_VM_KERNELS_DISPATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_VM_KERNELS_DISPATCH_INL_H_
#undef TYNDALL_VM_KERNELS_DISPATCH_INL_H_
#else
#define TYNDALL_VM_KERNELS_DISPATCH_INL_H_
#endif

#include "vm/kernels/blackbody-inl.h"
#include "vm/kernels/exponential-inl.h"
#include "vm/kernels/fields-inl.h"
#include "vm/kernels/planes-inl.h"
#include "vm/kernels/trigonometric-inl.h"
#include "vm/op.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// kernel<Op::add>(options, a, b) is op_add(options, a, b).
template <Op op>
struct Kernel;
#define X(name, operand_count)                                          \
  template <>                                                           \
  struct Kernel<Op::name> {                                             \
    static constexpr std::size_t operands = operand_count;              \
    template <class... V>                                               \
    static TYNDALL_VM_INLINE auto run(const Options& options, V... v) { \
      return op_##name(options, v...);                                  \
    }                                                                   \
  };
TYNDALL_VM_OPS(X)
#undef X

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
