// The benchmark's shaders compiled straight to machine code: what the VM is measured against.
#pragma once

#include <cstddef>

namespace tyndall::vm {

enum class BenchShader { cloud, transcendental, sums };

// Evaluates the shader at points (x, y, z) with one float at a time, at -O3.
void run_scalar(BenchShader shader, const float* x, const float* y, const float* z, float* out,
                std::size_t count);
// The same with whole vectors of the processor's SIMD class; count is a multiple of 16.
void run_by_hand(BenchShader shader, const float* x, const float* y, const float* z, float* out,
                 std::size_t count);

}  // namespace tyndall::vm
