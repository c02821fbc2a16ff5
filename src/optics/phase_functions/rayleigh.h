// Rayleigh's phase function (1871), without the depolarisation of real gases.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "optics/phase_functions/draine.h"

namespace tyndall::optics {

struct Rayleigh {
  static constexpr std::string_view keyword = "rayleigh";
  static constexpr std::string_view documentation =
      "Scatters as particles far smaller than the wavelength do.";
  static constexpr std::string_view example = "rayleigh";
  template <class F>
  static constexpr void fields(F&&) {}

  float eval(float m) const { return 0.75f * static_cast<float>(inv_4pi) * (1 + sqr(1 - m)); }
  // Inverts u = 1/2 + 3/8 (c + c³/3), Cardano's form for one real root.
  float sample(float u0, float) const {
    const double q = 4.0 * u0 - 2;
    const double root = std::cbrt(std::abs(q) + std::sqrt(q * q + 1));
    const double cosine = std::copysign(root - 1 / root, q);
    return static_cast<float>(std::clamp(1 - cosine, 0.0, 2.0));
  }
  float mean_cosine() const { return 0; }
  float eval_softened(float m, float anisotropy) const { return draine_eval(0, anisotropy, m); }
};

}  // namespace tyndall::optics
