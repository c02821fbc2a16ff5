// The shaders of the VM's benchmark, each written once: emitted as nodes, or computed with the kernels in
// registers.
#if defined(TYNDALL_BENCH_VM_SHADERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TYNDALL_BENCH_VM_SHADERS_INL_H_
#undef TYNDALL_BENCH_VM_SHADERS_INL_H_
#else
#define TYNDALL_BENCH_VM_SHADERS_INL_H_
#endif

#include "vm/kernels/dispatch-inl.h"
#include "vm_scalar_noise.h"

HWY_BEFORE_NAMESPACE();
namespace tyndall::vm::HWY_NAMESPACE {

// Calls the kernels directly: what one writes by hand. Plain floats take exp, log, pow and sin from the C
// library.
template <class V>
struct Direct {
  using Value = V;
  TYNDALL_VM_INLINE V constant(float v) const { return V(v); }
  template <Op op, class... T>
  TYNDALL_VM_INLINE V call(T... v) const {
    if constexpr (std::is_same_v<V, float> && op == Op::exp)
      return std::exp(v...);
    else if constexpr (std::is_same_v<V, float> && op == Op::log)
      return std::log(v...);
    else if constexpr (std::is_same_v<V, float> && op == Op::pow)
      return std::pow(v...);
    else if constexpr (std::is_same_v<V, float> && op == Op::sin)
      return std::sin(v...);
    else if constexpr (std::is_same_v<V, float> && op == Op::noise3)
      return scalar_noise(v..., 0);
    else
      return Kernel<op>::run(Options{}, v...);
  }
  template <Op op, class... T>
  TYNDALL_VM_INLINE V octaves(int count, T... v) const {
    if constexpr (std::is_same_v<V, float> && op == Op::fbm3)
      return scalar_fbm(v..., count);
    else
      return Kernel<op>::run(Options{count, 0}, v...);
  }
};

// Five octaves of fbm and a second noise, pow, exp, select, mixes.
struct Cloud {
  static constexpr const char* name = "noise shader";
  template <class Ops, class V = typename Ops::Value>
  TYNDALL_VM_INLINE V operator()(const Ops& o, V x, V y, V z) const {
    const V scale = o.constant(2.3f);
    const V qx = o.template call<Op::mul>(x, scale), qy = o.template call<Op::mul>(y, scale),
            qz = o.template call<Op::mul>(z, scale);
    const V billow = o.template octaves<Op::fbm3>(5, qx, o.template call<Op::sub>(qy, o.constant(0.4f)), qz);
    const V radius = o.template call<Op::length3>(x, o.template call<Op::div>(y, o.constant(0.7f)), z);
    const V edge = o.template call<Op::add>(radius, o.template call<Op::mul>(billow, o.constant(0.35f)));
    const V shape = o.template call<Op::smoothstep>(o.constant(1.0f), o.constant(0.4f), edge);
    const V fine = o.constant(9.0f);
    const V detail =
        o.template call<Op::noise3>(o.template call<Op::mul>(x, fine), o.template call<Op::mul>(y, fine),
                                    o.template call<Op::mul>(z, fine));
    const V half = o.constant(0.5f);
    const V wisps = o.template call<Op::pow>(
        o.template call<Op::clamp>(o.template call<Op::add>(o.template call<Op::mul>(detail, half), half),
                                   o.constant(0.0f), o.constant(1.0f)),
        o.constant(1.5f));
    const V depth = o.template call<Op::exp>(o.template call<Op::mul>(radius, o.constant(-3.0f)));
    const V body = o.template call<Op::mix>(shape, o.template call<Op::mul>(shape, wisps), depth);
    const V lower = o.template call<Op::mix>(body, wisps, o.constant(0.1f));
    const V below = o.template call<Op::less>(y, o.constant(0.0f));
    return o.template call<Op::mul>(o.template call<Op::select>(below, lower, body), o.constant(20.0f));
  }
};

// Arithmetic with exp, log, pow, sin and sqrt.
struct Transcendental {
  static constexpr const char* name = "arithmetic + transcendentals";
  template <class Ops, class V = typename Ops::Value>
  TYNDALL_VM_INLINE V operator()(const Ops& o, V x, V y, V z) const {
    const V r = o.template call<Op::length3>(x, y, z);
    const V wave = o.template call<Op::sin>(o.template call<Op::add>(
        o.template call<Op::mul>(x, o.constant(7.0f)), o.template call<Op::mul>(y, z)));
    const V fall = o.template call<Op::exp>(o.template call<Op::mul>(r, o.constant(-1.5f)));
    const V slow = o.template call<Op::log>(o.template call<Op::add>(r, o.constant(1.0f)));
    const V bent = o.template call<Op::pow>(o.template call<Op::add>(o.template call<Op::abs>(wave), fall),
                                            o.constant(1.7f));
    const V root =
        o.template call<Op::sqrt>(o.template call<Op::add>(o.template call<Op::mul>(bent, slow), fall));
    return o.template call<Op::mix>(root, o.template call<Op::mul>(fall, wave), o.constant(0.3f));
  }
};

// Nothing but sums and products.
struct Sums {
  static constexpr const char* name = "add/mul only";
  template <class Ops, class V = typename Ops::Value>
  TYNDALL_VM_INLINE V operator()(const Ops& o, V x, V y, V z) const {
    V a = x, b = y;
    for (int i = 0; i < 10; ++i) {
      const V c = o.template call<Op::sub>(o.template call<Op::mul>(a, b), z);
      a = o.template call<Op::mul>(o.template call<Op::add>(b, c),
                                   o.constant(0.25f + 0.01f * static_cast<float>(i)));
      b = o.template call<Op::add>(c, x);
    }
    return o.template call<Op::add>(a, b);
  }
};

}  // namespace tyndall::vm::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
