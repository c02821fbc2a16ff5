// Measured with `tyndall-bench ops`, rounded.
#include "vm/cost.h"

#include "base/check.h"

namespace tyndall::vm {

double op_cost(Op op, std::uint8_t octaves) {
  switch (op) {
    case Op::copy:
    case Op::neg:
    case Op::abs:
    case Op::floor:
    case Op::ceil:
    case Op::logical_not:
      return 0.04;
    case Op::add:
    case Op::sub:
    case Op::mul:
    case Op::fma:
    case Op::min:
    case Op::max:
    case Op::logical_and:
    case Op::logical_or:
      return 0.08;
    case Op::div:
    case Op::fms:
    case Op::fnma:
    case Op::add_mul:
    case Op::sub_mul:
    case Op::clamp:
    case Op::limit:
    case Op::not_equal:
    case Op::select:
    case Op::checker:
      return 0.1;
    case Op::dot2:
    case Op::mix:
      return 0.12;
    case Op::fract:
    case Op::step:
    case Op::less:
    case Op::less_equal:
    case Op::equal:
      return 0.06;
    case Op::mod:
      return 0.2;
    case Op::smoothstep:
      return 0.14;
    case Op::sqrt:
    case Op::random1:
      return 0.16;
    case Op::pow:
    case Op::blackbody_r:
    case Op::blackbody_g:
    case Op::blackbody_b:
    case Op::plane:
      return 1.5;
    case Op::exp:
      return 0.4;
    case Op::log:
      return 0.58;
    case Op::sin:
      return 0.44;
    case Op::cos:
      return 0.42;
    case Op::tan:
    case Op::random3:
      return 0.5;
    case Op::asin:
      return 0.3;
    case Op::acos:
    case Op::random2:
      return 0.32;
    case Op::atan:
      return 0.38;
    case Op::atan2:
      return 0.72;
    case Op::length2:
    case Op::length3:
      return 0.18;
    case Op::noise3:
      return 2.5;
    case Op::noise4:
      return 5.6;
    case Op::fbm3:
    case Op::turbulence3:
      return 2.7 * octaves;
    case Op::fbm4:
      return 6.5 * octaves;
    case Op::curl3_y:
      return 6.8;
    case Op::turbulence4:
    case Op::ridged4:
      return 6.8 * octaves;
    case Op::ridged3:
      return 2.8 * octaves;
    case Op::cells3:
      return 12.7;
    case Op::cells4:
      return 46.1;
    case Op::curl3_x:
    case Op::curl3_z:
      return 7;
    case Op::curl4_x:
      return 22;
    case Op::curl4_y:
      return 22.5;
    case Op::curl4_z:
      return 22.3;
    case Op::random4:
      return 0.69;
  }
  check_failed(__FILE__, __LINE__, "unknown operation");
}

}  // namespace tyndall::vm
