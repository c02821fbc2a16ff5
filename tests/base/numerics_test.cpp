// The stable forms at their extremes (transport §7).
#include "base/numerics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tyndall {
namespace {

// (1 - e^-x)/x from x = 1e-30 to 1e30, against long double's expm1l: within 2e-11 everywhere (the series'
// bound is 3e-12, at its end).
TEST(ExpAverage, RightOverSixtyDecades) {
  EXPECT_EQ(exp_average(0.0), 1.0);
  for (double exponent = -30; exponent <= 30; exponent += 0.01) {
    const double x = std::pow(10.0, exponent);
    const double expected =
        static_cast<double>(-expm1l(-static_cast<long double>(x)) / static_cast<long double>(x));
    EXPECT_NEAR(exp_average(x) / expected, 1, 2e-11) << x;
  }
}

// In haze, where 1 - e^-x in float is wrong by a factor of two, absorbed light x * exp_average(x) is right.
TEST(ExpAverage, KeepsHaze) { EXPECT_NEAR(3e-8 * exp_average(3e-8) / 3e-8, 1 - 1.5e-8, 1e-15); }

TEST(SafeSqrt, TakesRoundingBelowZeroAsZero) {
  EXPECT_EQ(safe_sqrt(-1e-30), 0.0);
  EXPECT_EQ(safe_sqrt(4.0), 2.0);
}

}  // namespace
}  // namespace tyndall
