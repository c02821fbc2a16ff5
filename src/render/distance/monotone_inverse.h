// Where an increasing function reaches a value.
#pragma once

#include <algorithm>
#include <cmath>

namespace tyndall::render {

// The x in [lo, hi] at which `value(x)`, which does not decrease there, reaches `target`; `slope(x)` is its
// derivative. Newton's method within a bracket that is halved where a step would leave it or hardly shrink
// it: to the last digits of x.
template <class Value, class Slope>
double monotone_inverse(double lo, double hi, double target, double guess, Value&& value, Slope&& slope) {
  double x = std::clamp(guess, lo, hi), last_step = hi - lo;
  for (int k = 0; k < 100; ++k) {
    const double missed = value(x) - target;
    if (missed == 0) return x;
    (missed > 0 ? hi : lo) = x;
    double next = x - missed / slope(x);
    if (!(next > lo && next < hi) || std::abs(next - x) > 0.5 * last_step) next = lo + 0.5 * (hi - lo);
    last_step = std::abs(next - x);
    if (!(lo < next && next < hi) || last_step <= 1e-15 * std::abs(next)) return next;
    x = next;
  }
  return x;
}

}  // namespace tyndall::render
