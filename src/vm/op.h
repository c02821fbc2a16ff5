// The operations of the shader VM. Every value is a float; vectors are three operands, booleans are 0 or 1.
#pragma once

#include <cstdint>
#include <string_view>

namespace tyndall::vm {

// X(name, operand count). The order is the encoding; op_info() in op.cpp gives printed names.
#define TYNDALL_VM_OPS(X)                                                                                \
  X(copy, 1)                                                                                             \
  X(add, 2)                                                                                              \
  X(sub, 2)                                                                                              \
  X(mul, 2)                                                                                              \
  X(div, 2)                                                                                              \
  X(neg, 1)                                                                                              \
  X(fma, 3) /* a*b + c; this and the next four round after each operation */                             \
  X(fms, 3)                                                                                              \
  /* a*b - c */ X(fnma, 3) /* c - a*b */ X(add_mul, 3) /* (a + b)*c */ X(sub_mul, 3) /* (a - b)*c */ X(  \
      dot2, 4) /* a*b + c*d */                                                                           \
      X(min, 2) X(max, 2) X(clamp, 3) X(limit, 3) /* clamp, for which NaN is 0 */ X(abs, 1) X(floor, 1)  \
          X(ceil, 1) X(fract, 1) X(mod, 2) /* sign of b */                                               \
      X(mix, 3) X(step, 2) X(smoothstep, 3) X(sqrt, 1) X(pow, 2) X(exp, 1) X(log, 1) X(sin, 1) X(cos, 1) \
          X(tan, 1) X(asin, 1) X(acos, 1) X(atan, 1) X(atan2, 2) X(length2, 2)                           \
              X(length3, 3) /* sqrt of the sum of squares */                                             \
      X(less, 2) X(less_equal, 2) X(equal, 2) X(not_equal, 2) X(logical_and, 2) X(logical_or, 2)         \
          X(logical_not, 1) X(select, 3) /* a != 0 ? b : c; the branch not taken may hold anything */    \
      X(noise3, 3) X(noise4, 4)          /* gradient noise of (x, y, z) or (x, y, z, t); imm = seed */   \
      X(fbm3, 3) X(fbm4, 4) /* count = octaves; imm = seed; lacunarity 2, gain 1/2, normalised */        \
      X(turbulence3, 3) X(turbulence4, 4) X(ridged3, 3) X(ridged4, 4) X(cells3, 3)                       \
          X(cells4, 4) /* distance to the nearest feature point */                                       \
      X(curl3_x, 3) X(curl3_y, 3) X(curl3_z, 3) X(curl4_x, 4) X(curl4_y, 4) X(curl4_z, 4) X(random1, 1)  \
          X(random2, 2) X(random3, 3) X(random4, 4) /* hash of the operands' bits, in [0, 1) */          \
      X(checker, 2) X(blackbody_r, 1) X(blackbody_g, 1)                                                  \
          X(blackbody_b, 1) /* linear Rec. 709, luminance 1; kelvin */                                   \
      X(plane, 2)           /* bilinear lookup at (u, v) in the program's plane imm; repeats */

enum class Op : std::uint8_t {
#define X(name, operands) name,
  TYNDALL_VM_OPS(X)
#undef X
};

// Octaves of fbm, turbulence and ridged: 1 to this.
inline constexpr int max_octaves = 32;

struct OpInfo {
  std::string_view name;
  int operands;
  bool octaves;     // `count` is the number of octaves
  bool seed;        // `immediate` is the seed
  bool plane;       // `immediate` is the index of one of the program's planes
  bool float_only;  // hashes the bits of floats, or reads a table: has no form in double
};
const OpInfo& op_info(Op op);
// Whether it is made of a lattice of whole coordinates.
constexpr bool is_lattice_field(Op op) {
  return (op >= Op::noise3 && op <= Op::curl4_z) || op == Op::checker;
}
int op_count();

}  // namespace tyndall::vm
