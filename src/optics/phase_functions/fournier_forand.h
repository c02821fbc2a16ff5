// Fournier and Forand's phase function of sea water (SPIE 2258, 1994), in the form of Fournier and Jonasz
// (SPIE 3761, 1999): spheres of one refractive index in anomalous diffraction, their sizes by a power law.
//
// Written in x = sin²(theta / 2) = (1 - cos) / 2, d = x / x0 with x0 = 3 (n - 1)² / 4, and e = (mu - 3) / 2,
// their -nu. The light scattered by more than theta is
//   1 - F(x) = (1 - x) (h(d) - C / 2 x (1 - 2x)),  h(d) = (1 - d^e) / (1 - d),  C = h(1 / x0),
// which is their eq. for the cumulative function without its 0/0 at d = 1. F' / 4 pi is the phase function.
// It grows without bound towards theta = 0 like x^(e - 1); inside of `core` its mean stands for it.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/numerics.h"
#include "optics/phase_functions/phase_parameter.h"

namespace tyndall::optics {

struct FournierForand {
  static constexpr std::string_view keyword = "fournier_forand";
  static constexpr std::string_view documentation =
      "Fournier and Forand's phase function of particles in sea water; (1.1, 3.5835) is near Petzold's "
      "measured average, of which 1.8 % is scattered backwards.";
  static constexpr std::string_view example = "fournier_forand(1.1, 3.5835)";
  // 1 - cos within which it is constant, 1.4e-4 rad: directions in floats are not much finer.
  static constexpr double core = 1e-8;
  float n = 1.1f, mu = 3.5835f;
  template <class F>
  static constexpr void fields(F&& field) {
    field(&FournierForand::n,
          PhaseParameter{"n", "the refractive index of the particles in water", 1.01, 1.35});
    field(&FournierForand::mu,
          PhaseParameter{"mu", "the slope of their size distribution; smaller sends more straight on", 3.01,
                         5});
  }
  void prepare() {
    exponent = (static_cast<double>(mu) - 3) / 2;
    x0 = 0.75 * sqr(static_cast<double>(n) - 1);
    back = ratio(1 / x0);
    core_share = cumulative(0.5 * core);
  }

  float eval(float m) const {
    const double x = 0.5 * static_cast<double>(m);
    return static_cast<float>(inv_4pi * (m < core ? core_share / (0.5 * core) : density(x)));
  }
  // Inverts F in ln x, where it is smooth: Newton's steps, kept in a bracket.
  float sample(float u0, float) const {
    const double u = u0;
    if (u < core_share) return static_cast<float>(core * (u / core_share));
    double low = std::log(0.5 * core), high = 0;
    double y = std::clamp(std::log(x0) + std::log(u) / exponent, low, high);  // where d is small
    for (int i = 0; i < 60; ++i) {
      const double x = std::exp(y), error = cumulative(x) - u;
      (error < 0 ? low : high) = y;
      const double newton = y - error / (x * density(x));
      const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
      const bool converged = std::abs(next - y) <= 1e-10;
      y = next;
      if (converged) break;
    }
    return std::min(2.0f, static_cast<float>(2 * std::exp(y)));
  }
  // 1 - 2 ∫ (1 - x) h dx: the term with C is odd about x = 1/2. In ln x, by Gauss's rule of two points.
  float mean_cosine() const {
    constexpr int cells = 128;
    constexpr double lowest = -32, width = -lowest / cells;  // e^-32 is 1e-14
    double sum = 0;
    for (int i = 0; i < 2 * cells; ++i) {
      const double place = 0.5 + (i % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.0);
      const double x = std::exp(lowest + (i / 2 + place) * width);
      sum += x * (1 - x) * ratio(x / x0);
    }
    return static_cast<float>(1 - sum * width);
  }

  // F: the share of light that is scattered by less. Free of cancellation towards x = 0.
  double cumulative(double x) const {
    const double d = x / x0, log_d = std::log(d), h = ratio(d);
    const double forward =
        d < 0.5 ? -std::exp(exponent * log_d) * std::expm1((1 - exponent) * log_d) / (1 - d) : 1 - h;
    return forward + x * (h + 0.5 * back * (1 - x) * (1 - 2 * x));
  }
  // F'.
  double density(double x) const {
    const double d = x / x0, h = ratio(d);
    return h - 0.5 * back * x * (1 - 2 * x) - (1 - x) * (slope(d, h) / x0 - 0.5 * back * (1 - 4 * x));
  }

  double exponent = 0, x0 = 1, back = 0, core_share = 0;

 private:
  // h.
  double ratio(double d) const {
    return d == 1 ? exponent : std::expm1(exponent * std::log1p(d - 1)) / (d - 1);
  }
  // h'; by its series about d = 1, where it is 0/0.
  double slope(double d, double h) const {
    const double e = exponent, off = d - 1;
    if (std::abs(off) < 1e-3) return e * (e - 1) * (0.5 + (e - 2) * off * (1.0 / 3 + (e - 3) * off / 8));
    return (h - e * std::pow(d, e - 1)) / (1 - d);
  }
};

}  // namespace tyndall::optics
