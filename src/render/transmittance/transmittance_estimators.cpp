#include "render/transmittance/transmittance_estimators.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/sampler.h"

namespace tyndall::render {

namespace {

constexpr double order_zero = 0.9;       // probability of the series' first term alone
constexpr std::uint32_t sure_order = 2;  // that any longer series reaches
constexpr double roulette_strength = 2;

// Of going on from order k to k + 1.
double order_continues(std::uint32_t k) {
  if (k == 0) return 1 - order_zero;
  return k < sure_order ? 1 : std::min(1.0, roulette_strength / (k + 1));
}

}  // namespace

double jackknife(double x1, double x2) { return std::exp(-0.5 * (x1 + x2)) * std::cos(0.5 * (x1 - x2)); }

std::uint32_t series_order(std::uint32_t seed) {
  std::uint32_t k = 0;
  while (unit_float(static_cast<std::uint32_t>(hash_bits(seed, 0x5e71e5u + k) >> 32)) < order_continues(k))
    ++k;
  return k;
}

double power_series(std::span<const double> x) {
  const std::size_t order = x.size() - 1;
  if (order == 0) return std::exp(-x[0]);
  double sum = 0;
  std::vector<double> symmetric(order + 1);  // elementary symmetric polynomials of the differences
  for (std::size_t pivot = 0; pivot <= order; ++pivot) {
    std::fill(symmetric.begin(), symmetric.end(), 0.0);
    symmetric[0] = 1;
    std::size_t used = 0;
    for (std::size_t i = 0; i <= order; ++i) {
      if (i == pivot) continue;
      ++used;
      for (std::size_t k = used; k > 0; --k) symmetric[k] += symmetric[k - 1] * (x[pivot] - x[i]);
    }
    // Term k: (product of k different differences, averaged) / k!, over the probability of reaching it.
    double series = 0, weight = 1;
    for (std::size_t k = 0; k <= order; ++k) {
      series += symmetric[k] * weight;
      // C(order, k + 1) (k + 1)! = C(order, k) k! (order - k)
      if (k < order)
        weight /= static_cast<double>(order - k) * order_continues(static_cast<std::uint32_t>(k));
    }
    sum += std::exp(-x[pivot]) * series;
  }
  return sum / static_cast<double>(order + 1);
}

}  // namespace tyndall::render
