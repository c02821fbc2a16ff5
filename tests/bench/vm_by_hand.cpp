// The benchmark's shaders in hand-written Highway, for every SIMD class.
#include "vm_by_hand.h"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "vm_by_hand.cpp"
#include "hwy/foreach_target.h"
//
#include "vm_shaders-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

template <class Shader>
void run_vectors(const float* x, const float* y, const float* z, float* out, std::size_t count) {
  const FloatTag d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Floats result = Shader()(Direct<Floats>(), Floats(hn::LoadU(d, x + i)), Floats(hn::LoadU(d, y + i)),
                                   Floats(hn::LoadU(d, z + i)));
    hn::StoreU(result.raw, d, out + i);
  }
}

void run_by_hand_simd(BenchShader shader, const float* x, const float* y, const float* z, float* out,
                      std::size_t count) {
  switch (shader) {
    case BenchShader::cloud:
      return run_vectors<Cloud>(x, y, z, out, count);
    case BenchShader::transcendental:
      return run_vectors<Transcendental>(x, y, z, out, count);
    case BenchShader::sums:
      return run_vectors<Sums>(x, y, z, out, count);
  }
}

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyndall::vm {

HWY_EXPORT(run_by_hand_simd);

void run_by_hand(BenchShader shader, const float* x, const float* y, const float* z, float* out,
                 std::size_t count) {
  HWY_DYNAMIC_DISPATCH(run_by_hand_simd)(shader, x, y, z, out, count);
}

}  // namespace tyndall::vm
#endif
