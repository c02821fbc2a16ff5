// Henyey and Greenstein's phase function (1941).
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/numerics.h"
#include "optics/phase_functions/phase_parameter.h"

namespace tyndall::optics {

// Nearer to 1 the peak is narrower than directions in floats are fine.
inline constexpr double greatest_g = 0.9999;

template <class T>
T clamp_g(T g) {
  return std::clamp(g, T(-greatest_g), T(greatest_g));
}

// Henyey and Greenstein's 1 - cos whose cumulative probability, counted from straight back, is u; 1 - u is
// given apart because near the peak it holds the digits (transport §7). For g < 0 the mirror image: its peak
// is at m = 2.
template <class T>
T hg_inverse(T g, T u, T one_minus_u) {
  if (g < 0) return 2 - hg_inverse(-g, one_minus_u, u);
  const T denominator = (1 - g) * one_minus_u + (1 + g) * u;
  return std::min(T(2), 2 * sqr(1 - g) * one_minus_u * (1 + g * u) / sqr(denominator));
}

// At m = 1 - cos_theta, which keeps full precision for forward peaks (transport §7); g is clamped. The
// denominator is |1 - g e^(i theta)|² = (1 - g)² + 2 g m. For g < 0 the peak is at m = 2, and 2 - m is exact
// there.
inline float hg_eval(float g, float m) {
  g = clamp_g(g);
  const float denominator = g >= 0 ? sqr(1 - g) + 2 * g * m : sqr(1 + g) - 2 * g * (2 - m);
  return static_cast<float>(inv_4pi) * (1 - g) * (1 + g) / (denominator * std::sqrt(denominator));
}
// Draws m in [0, 2] for u in [0, 1).
inline float hg_sample(float g, float u) { return hg_inverse(clamp_g(g), u, 1 - u); }

struct HenyeyGreenstein {
  static constexpr std::string_view keyword = "hg";
  static constexpr std::string_view documentation = "Henyey and Greenstein's phase function.";
  static constexpr std::string_view example = "hg(0.6)";
  float g = 0;
  template <class F>
  static constexpr void fields(F&& field) {
    field(&HenyeyGreenstein::g,
          PhaseParameter{"g", "the mean cosine, above 0 for forward scattering", -greatest_g, greatest_g});
  }

  float eval(float m) const { return hg_eval(g, m); }
  float sample(float u0, float) const { return hg_sample(g, u0); }
  float mean_cosine() const { return g; }
  float eval_softened(float m, float anisotropy) const { return hg_eval(anisotropy * g, m); }
};

}  // namespace tyndall::optics
