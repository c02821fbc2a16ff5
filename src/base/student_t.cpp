#include "base/student_t.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

// The continued fraction of the incomplete beta function (DLMF 8.17.22), evaluated from the front (Lentz
// 1976): x at most about (a + 1) / (a + b + 2), where it converges fast.
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300, precision = 1e-15;
  const auto away_from_zero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
  double c = 1, d = 1 / away_from_zero(1 - (a + b) * x / (a + 1)), fraction = d;
  for (int m = 1; m < 10000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / away_from_zero(1 + even * d);
    c = away_from_zero(1 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / away_from_zero(1 + odd * d);
    c = away_from_zero(1 + odd / c);
    fraction *= d * c;
    if (std::abs(d * c - 1) < precision) break;
  }
  return fraction;
}

// Regularised, I_x(a, b); `y` is 1 - x.
double incomplete_beta(double a, double b, double x, double y) {
  if (x <= 0 || y <= 0) return x <= 0 ? 0 : 1;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log(y));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
  return 1 - front * beta_fraction(b, a, y) / b;
}

}  // namespace

double student_t_two_sided(double t, double degrees_of_freedom) {
  constexpr double as_good_as_infinite = 1e7;
  if (std::isinf(t)) return 0;
  if (degrees_of_freedom > as_good_as_infinite) return std::erfc(std::abs(t) / std::sqrt(2.0));
  const double whole = degrees_of_freedom + t * t;
  return incomplete_beta(degrees_of_freedom / 2, 0.5, degrees_of_freedom / whole, t * t / whole);
}

double sidak_each(double together, double count) { return -std::expm1(std::log1p(-together) / count); }
double sidak_together(double least, double count) { return -std::expm1(count * std::log1p(-least)); }

// -2 times the sum has the chi-squared distribution with 2 * count degrees of freedom: a finite sum.
double fisher_together(double sum_of_logarithms, int count) {
  const double half = -sum_of_logarithms;
  if (std::isinf(half)) return 0;
  if (half <= 0) return 1;
  double probability = 0, log_factorial = 0;
  for (int k = 0; k < count; ++k) {
    if (k > 0) log_factorial += std::log(k);
    probability += std::exp(k * std::log(half) - half - log_factorial);
  }
  return std::min(probability, 1.0);
}

}  // namespace tyndall
