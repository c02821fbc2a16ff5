// The names and operand counts of the operations.
#include "vm/op.h"

#include <array>
#include <cstddef>

namespace tyndall::vm {

namespace {

constexpr bool has_octaves(Op op) { return op >= Op::fbm3 && op <= Op::ridged4; }
constexpr bool has_seed(Op op) { return op >= Op::noise3 && op <= Op::curl4_z; }
constexpr bool is_float_only(Op op) {
  return has_seed(op) || (op >= Op::random1 && op <= Op::random4) || op >= Op::blackbody_r;
}

constexpr std::array infos = {
#define X(name, operands)       \
  OpInfo{#name,                 \
         operands,              \
         has_octaves(Op::name), \
         has_seed(Op::name),    \
         Op::name == Op::plane, \
         is_float_only(Op::name)},
    TYNDALL_VM_OPS(X)
#undef X
};

}  // namespace

const OpInfo& op_info(Op op) { return infos[static_cast<std::size_t>(op)]; }

int op_count() { return static_cast<int>(infos.size()); }

}  // namespace tyndall::vm
