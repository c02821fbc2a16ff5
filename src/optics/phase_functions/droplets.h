// Mie scattering of water droplets, as fitted by Jendersie and d'Eon ("An approximate Mie scattering function
// for fog and cloud rendering", SIGGRAPH 2023): Henyey and Greenstein's function and Draine's.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "optics/phase_functions/draine.h"

namespace tyndall::optics {

struct Droplets {
  static constexpr std::string_view keyword = "droplets";
  static constexpr std::string_view documentation = "Water droplets as in fog and clouds.";
  static constexpr std::string_view example = "droplets(0.01mm)";
  static constexpr double least_diameter = 5e-6, greatest_diameter = 50e-6;  // [m], of the fit
  float diameter = 10e-6f;                                                   // [m]
  template <class F>
  static constexpr void fields(F&& field) {
    field(&Droplets::diameter, PhaseParameter{"diameter", "their diameter [m]", least_diameter,
                                              greatest_diameter, Quantity::length, "[0.005mm, 0.05mm]"});
  }
  // The numbers of the fit, eqs. 4-7.
  void prepare() {
    const double d = std::clamp(static_cast<double>(diameter), least_diameter, greatest_diameter) * 1e6;
    g_hg = static_cast<float>(std::exp(-0.0990567 / (d - 1.67154)));
    g_draine = static_cast<float>(std::exp(-2.20679 / (d + 3.91029) - 0.428934));
    a = static_cast<float>(std::exp(3.62489 - 8.29288 / (d + 5.52825)));
    weight_draine = static_cast<float>(std::exp(-0.599085 / (d - 0.641583) - 0.665888));
  }

  float eval(float m) const { return eval_softened(m, 1); }
  float sample(float u0, float u1) const {
    return u1 < weight_draine ? draine_sample(g_draine, a, u0) : hg_sample(g_hg, u0);
  }
  float mean_cosine() const { return lerp(g_hg, draine_mean_cosine(g_draine, a), weight_draine); }
  float eval_softened(float m, float anisotropy) const {
    return lerp(hg_eval(anisotropy * g_hg, m), draine_eval(anisotropy * g_draine, anisotropy * a, m),
                weight_draine);
  }

  float g_hg = 0, g_draine = 0, a = 0, weight_draine = 0;
};

}  // namespace tyndall::optics
