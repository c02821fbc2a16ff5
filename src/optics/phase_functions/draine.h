// Draine's phase function of interstellar dust (2003).
#pragma once

#include <cmath>
#include <string_view>

#include "optics/phase_functions/henyey_greenstein.h"

namespace tyndall::optics {

// The normaliser of Draine's phase function: the mean of 1 + a cos² under Henyey and Greenstein.
inline float draine_norm(float g, float a) { return 1 + a * (1 + 2 * g * g) / 3; }

// Draine 2003, eq. 6: Henyey and Greenstein times (1 + a cos²).
inline float draine_eval(float g, float a, float m) {
  return hg_eval(g, m) * (1 + a * sqr(1 - m)) / draine_norm(g, a);
}

// Draws as in Jendersie and d'Eon 2023 by inverting the cumulative distribution, but in the variable s = 2v
// where v is the cumulative probability of Henyey and Greenstein alone. There ∫ cos² ds is
//   s (A³ - A² K s + A K² s²/3 + g E² s³/4) / (A + g s)³,  A = 1 - g, K = 1 - g + g², E = 1 + g²,
// which stays exact for g -> 0, where their root formula divides by zero. Newton's steps, kept in a bracket.
inline float draine_sample(float g_float, float a_float, float u) {
  const double g = clamp_g<double>(g_float), a = a_float;
  const double A = 1 - g, K = 1 - g + g * g, E = 1 + g * g;
  const double target = 2.0 * u * (1 + a * (1 + 2 * g * g) / 3);
  double low = 0, high = 2, s = 2.0 * u;
  for (int i = 0; i < 60; ++i) {
    const double d = A + g * s;
    const double polynomial = A * A * A + s * (-A * A * K + s * (A * K * K / 3 + s * g * E * E / 4));
    const double error = s + a * s * polynomial / (d * d * d) - target;
    (error < 0 ? low : high) = s;
    const double cosine = 1 - hg_inverse(g, 0.5 * s, 1 - 0.5 * s);
    const double newton = s - error / (1 + a * cosine * cosine);
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    const bool converged = std::abs(next - s) <= 1e-14;
    s = next;
    if (converged) break;
  }
  return static_cast<float>(hg_inverse(g, 0.5 * s, 1 - 0.5 * s));
}

inline float draine_mean_cosine(float g, float a) {
  return g * (1 + a * (3 + 2 * g * g) / 5) / draine_norm(g, a);
}

struct Draine {
  static constexpr std::string_view keyword = "draine";
  static constexpr std::string_view documentation =
      "Draine's phase function of dust; a = 0 is hg, a = 1 and g = 0 is rayleigh.";
  static constexpr std::string_view example = "draine(0.5, 1)";
  float g = 0, a = 0;
  template <class F>
  static constexpr void fields(F&& field) {
    field(&Draine::g, PhaseParameter{"g", "as that of hg", -greatest_g, greatest_g});
    field(&Draine::a, PhaseParameter{"a", "the weight of cos²", 0, 1e6});
  }

  float eval(float m) const { return draine_eval(g, a, m); }
  float sample(float u0, float) const { return draine_sample(g, a, u0); }
  float mean_cosine() const { return draine_mean_cosine(g, a); }
  float eval_softened(float m, float anisotropy) const {
    return draine_eval(anisotropy * g, anisotropy * a, m);
  }
};

}  // namespace tyndall::optics
