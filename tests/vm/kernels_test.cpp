// What the arithmetic kernels promise at ordinary and at awkward arguments, in float and in double.
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

constexpr float inf = std::numeric_limits<float>::infinity();
const float nan_f = std::numeric_limits<float>::quiet_NaN();

template <class... T>
float lane(Op op, T... operands) {
  const std::array<float, sizeof...(T)> a = {static_cast<float>(operands)...};
  const std::array<double, sizeof...(T)> b = {static_cast<double>(operands)...};
  const float result = evaluate_lane(op, a);
  // Scenes and bodies agree about what is not a number and what is infinite.
  const double exact = evaluate(op, b);
  EXPECT_EQ(std::isnan(result), std::isnan(exact)) << op_info(op).name;
  EXPECT_EQ(std::isinf(result), std::isinf(exact)) << op_info(op).name;
  return result;
}

TEST(Kernels, RemainderHasTheSignOfTheDivisorAndStaysBelowIt) {
  EXPECT_EQ(lane(Op::mod, 7, 3), 1);
  EXPECT_EQ(lane(Op::mod, -1, 3), 2);
  EXPECT_EQ(lane(Op::mod, 1, -3), -2);
  EXPECT_EQ(lane(Op::mod, -6, 3), 0);
  EXPECT_EQ(lane(Op::mod, 5, inf), 5);
  EXPECT_TRUE(std::isnan(lane(Op::mod, 5, 0)));
  EXPECT_TRUE(std::isnan(lane(Op::mod, inf, 2)));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> range(-100, 100);
  for (int i = 0; i < 100000; ++i) {
    const float a = range(random) * (i % 7 == 0 ? 1e-9f : 1.0f), b = range(random);
    const float r = evaluate_lane(Op::mod, std::array{a, b});
    ASSERT_TRUE(b > 0 ? r >= 0 && r < b : r <= 0 && r > b) << a << ' ' << b << ' ' << r;
  }
}

TEST(Kernels, FractionIsBelowOne) {
  EXPECT_EQ(lane(Op::fract, 2.75), 0.75f);
  EXPECT_EQ(lane(Op::fract, -0.25), 0.75f);
  EXPECT_LT(evaluate_lane(Op::fract, std::array{-1e-30f}), 1.0f);
  EXPECT_LT(evaluate(Op::fract, std::array{-1e-30}), 1.0);
  EXPECT_TRUE(std::isnan(lane(Op::fract, inf)));
  EXPECT_TRUE(std::isnan(lane(Op::fract, nan_f)));
}

TEST(Kernels, NaNGoesThroughMinMaxAndClampFromEitherSide) {
  for (const Op op : {Op::min, Op::max}) {
    EXPECT_TRUE(std::isnan(lane(op, nan_f, 1)));
    EXPECT_TRUE(std::isnan(lane(op, 1, nan_f)));
  }
  EXPECT_TRUE(std::isnan(lane(Op::clamp, nan_f, 0, 1)));
  EXPECT_TRUE(std::isnan(lane(Op::smoothstep, 0, 1, nan_f)));
  EXPECT_EQ(lane(Op::clamp, inf, 0, 1), 1);
  EXPECT_EQ(lane(Op::clamp, -3, 0, 1), 0);
}

TEST(Kernels, LimitTakesNaNForZero) {
  EXPECT_EQ(evaluate_lane(Op::limit, std::array{nan_f, -1.0f, 1.0f}), 0);
  EXPECT_EQ(evaluate_lane(Op::limit, std::array{nan_f, 2.0f, 3.0f}), 2);
  EXPECT_EQ(lane(Op::limit, inf, 0, 1), 1);
  EXPECT_EQ(lane(Op::limit, -3, 0, 1), 0);
  EXPECT_EQ(lane(Op::limit, 0.25f, 0, 1), 0.25f);
}

TEST(Kernels, ComparisonsWithNaNAreFalse) {
  for (const Op op : {Op::less, Op::less_equal, Op::equal, Op::not_equal})
    for (const auto& [a, b] : {std::pair{nan_f, 1.0f}, {1.0f, nan_f}, {nan_f, nan_f}})
      EXPECT_EQ(lane(op, a, b), 0) << op_info(op).name;
  EXPECT_EQ(lane(Op::logical_not, nan_f), 0);
  EXPECT_EQ(lane(Op::logical_not, 0), 1);
  EXPECT_EQ(lane(Op::logical_not, -0.0), 1);
  EXPECT_EQ(lane(Op::not_equal, 1, 2), 1);
  EXPECT_EQ(lane(Op::logical_and, 1, 0), 0);
  EXPECT_EQ(lane(Op::logical_or, 1, 0), 1);
}

TEST(Kernels, TheBranchNotTakenMayHoldAnything) {
  EXPECT_EQ(lane(Op::select, 1, 5, nan_f), 5);
  EXPECT_EQ(lane(Op::select, 0, inf, 6), 6);
  EXPECT_EQ(lane(Op::select, -0.0, nan_f, 6), 6);
}

TEST(Kernels, MixHitsBothEndsExactly) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> range(-1e4f, 1e4f);
  for (int i = 0; i < 1000; ++i) {
    const float a = range(random), b = range(random) * 1e-5f;
    EXPECT_EQ(evaluate_lane(Op::mix, std::array{a, b, 0.0f}), a);
    EXPECT_EQ(evaluate_lane(Op::mix, std::array{a, b, 1.0f}), b);
  }
}

TEST(Kernels, SmoothstepRisesFallsAndSteps) {
  EXPECT_EQ(lane(Op::smoothstep, 0, 1, 0.5), 0.5f);
  EXPECT_EQ(lane(Op::smoothstep, 1, 0, 0), 1);
  EXPECT_EQ(lane(Op::smoothstep, 1, 0, 1), 0);
  EXPECT_EQ(lane(Op::smoothstep, 1, 0, 2), 0);
  EXPECT_EQ(lane(Op::smoothstep, 1, 1, 0.99), 0);
  EXPECT_EQ(lane(Op::smoothstep, 1, 1, 1), 1);
  float last = 0;
  for (int i = 0; i <= 1000; ++i) {
    const float x = static_cast<float>(i) * 1e-3f;
    const float rising = evaluate_lane(Op::smoothstep, std::array{0.0f, 1.0f, x});
    const float falling = evaluate_lane(Op::smoothstep, std::array{1.0f, 0.0f, x});
    EXPECT_GE(rising, last);
    EXPECT_NEAR(rising + falling, 1, 2e-7);
    last = rising;
  }
}

TEST(Kernels, DivisionsAndRootsOutOfTheirDomains) {
  EXPECT_EQ(lane(Op::div, 1, 0), inf);
  EXPECT_EQ(lane(Op::div, -1, 0), -inf);
  EXPECT_TRUE(std::isnan(lane(Op::div, 0, 0)));
  EXPECT_TRUE(std::isnan(lane(Op::sqrt, -1)));
  EXPECT_EQ(lane(Op::sqrt, inf), inf);
  EXPECT_EQ(lane(Op::length3, 1, 2, 2), 3);
  EXPECT_EQ(lane(Op::length2, 3, 4), 5);
  EXPECT_EQ(lane(Op::step, 1, 1), 1);
  EXPECT_EQ(lane(Op::step, 1, 0.9), 0);
}

TEST(Kernels, CheckerAlternates) {
  for (int y = -3; y < 4; ++y)
    for (int x = -3; x < 4; ++x)
      EXPECT_EQ(lane(Op::checker, x + 0.5, y + 0.25), (x + y) % 2 == 0 ? 1 : 0) << x << ' ' << y;
}

}  // namespace
}  // namespace tyndall::vm
