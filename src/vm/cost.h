// What operations cost, relative to one another: for guards and profiles.
#pragma once

#include <cstdint>

#include "vm/op.h"

namespace tyndall::vm {

// Nanoseconds a lane in full batches on one processor with AVX-512; elsewhere the ratios are about the same.
double op_cost(Op op, std::uint8_t octaves);

}  // namespace tyndall::vm
