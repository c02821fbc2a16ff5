// The stable forms at their extremes (transport §7).
#include "base/numerics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tyndall {
namespace UNNAMED {

TEST(SafeSqrt, TakesRoundingBelowZeroAsZero) {
  EXPECT_EQ(safe_sqrt(-1e-30), 0.0);
  EXPECT_EQ(safe_sqrt(4.0), 2.0);
}

}  // namespace
}  // namespace tyndall
