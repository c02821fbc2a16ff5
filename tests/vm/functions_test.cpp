// The accuracy of exp, log, pow and the trigonometric functions, in ulps of the double library's result, and
// their special values. Lanes equal the reference to the bit (machine_test), so the reference is measured.
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

constexpr float inf = std::numeric_limits<float>::infinity();

// Distance of `found` from `exact` in units of the last place of the float nearest to `exact`.
double ulps(float found, double exact) {
  const float nearest = static_cast<float>(exact);
  if (std::isnan(exact) || std::isinf(nearest)) return same(found, nearest) ? 0 : inf;
  int exponent = 0;
  std::frexp(std::max(std::fabs(exact), 0x1p-126), &exponent);
  return std::fabs(static_cast<double>(found) - exact) / std::ldexp(1.0, exponent - 24);
}

// The largest error over floats spread evenly in value between low and high, and evenly in bits.
double worst_error(Op op, double (*exact)(double), float low, float high, float& where) {
  double worst = 0;
  const auto check = [&](float x) {
    const double error = ulps(evaluate_lane(op, std::array{x}), exact(static_cast<double>(x)));
    if (!(error <= worst)) worst = error, where = x;
  };
  std::mt19937 random(5);
  std::uniform_real_distribution<float> range(low, high);
  for (int i = 0; i < 300000; ++i) check(range(random));
  for (int i = 0; i < 300000; ++i) {
    const float x = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (x >= low && x <= high) check(x);
  }
  return worst;
}

TEST(Functions, AccuracyInUlps) {
  struct Case {
    Op op;
    double (*exact)(double);
    float low, high;
    double limit;
  };
  const Case cases[] = {
      {Op::exp, std::exp, -87.3f, 88.7f, 2},     {Op::exp, std::exp, -1.0f, 1.0f, 2},
      {Op::log, std::log, 1e-45f, 3.4e38f, 2},   {Op::log, std::log, 0.5f, 2.0f, 2},
      {Op::sin, std::sin, -7.0f, 7.0f, 4},       {Op::sin, std::sin, -6000.0f, 6000.0f, 4},
      {Op::sin, std::sin, -3e38f, 3e38f, 4},     {Op::cos, std::cos, -7.0f, 7.0f, 4},
      {Op::cos, std::cos, -6000.0f, 6000.0f, 4}, {Op::cos, std::cos, -3e38f, 3e38f, 4},
      {Op::tan, std::tan, -7.0f, 7.0f, 4},       {Op::tan, std::tan, -6000.0f, 6000.0f, 4},
      {Op::asin, std::asin, -1.0f, 1.0f, 4},     {Op::acos, std::acos, -1.0f, 1.0f, 4},
      {Op::atan, std::atan, -10.0f, 10.0f, 4},   {Op::atan, std::atan, -3e38f, 3e38f, 4},
  };
  for (const Case& c : cases) {
    float where = 0;
    const double worst = worst_error(c.op, c.exact, c.low, c.high, where);
    EXPECT_LE(worst, c.limit) << op_info(c.op).name << " in [" << c.low << ", " << c.high << "] at " << where;
    RecordProperty(std::string(op_info(c.op).name), std::to_string(worst));
  }
}

TEST(Functions, PowIsAccurateOverItsWholeRange) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> logarithm(-88, 88), exponent(-40, 40);
  double worst = 0;
  float worst_x = 0, worst_y = 0;
  for (int i = 0; i < 400000; ++i) {
    float x = static_cast<float>(std::exp(logarithm(random))), y = static_cast<float>(exponent(random));
    if (i % 2 == 0) x = static_cast<float>(std::exp(logarithm(random) * 0.01));
    if (i % 4 == 0) y = static_cast<float>(logarithm(random) / std::log(static_cast<double>(x)));
    const double exact = std::pow(static_cast<double>(x), static_cast<double>(y));
    if (exact < 0x1p-126 || exact > 0x1.fffffep127) continue;
    const double error = ulps(evaluate_lane(Op::pow, std::array{x, y}), exact);
    if (!(error <= worst)) worst = error, worst_x = x, worst_y = y;
  }
  EXPECT_LE(worst, 4) << worst_x << " ^ " << worst_y;
}

TEST(Functions, Atan2IsAccurateInEveryQuadrant) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> range(-1, 1);
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    const float y = range(random) * (i % 3 == 0 ? 1e-12f : 1.0f),
                x = range(random) * (i % 5 == 0 ? 1e20f : 1.0f);
    worst = std::max(worst, ulps(evaluate_lane(Op::atan2, std::array{y, x}),
                                 std::atan2(static_cast<double>(y), static_cast<double>(x))));
  }
  EXPECT_LE(worst, 4);
}

TEST(Functions, SpecialValuesAreThoseOfTheLibrary) {
  for (const float a : awkward_numbers()) {
    const double x = static_cast<double>(a);
    EXPECT_LE(ulps(evaluate_lane(Op::exp, std::array{a}), std::exp(x)), 2) << a;
    EXPECT_LE(ulps(evaluate_lane(Op::log, std::array{a}), std::log(x)), 2) << a;
    EXPECT_LE(ulps(evaluate_lane(Op::sin, std::array{a}), std::sin(x)), 4) << a;
    EXPECT_LE(ulps(evaluate_lane(Op::cos, std::array{a}), std::cos(x)), 4) << a;
    EXPECT_LE(ulps(evaluate_lane(Op::tan, std::array{a}), std::tan(x)), 4) << a;
    EXPECT_LE(ulps(evaluate_lane(Op::asin, std::array{a}), std::asin(x)), 4) << a;
    EXPECT_LE(ulps(evaluate_lane(Op::acos, std::array{a}), std::acos(x)), 4) << a;
    EXPECT_LE(ulps(evaluate_lane(Op::atan, std::array{a}), std::atan(x)), 4) << a;
    for (const float b : awkward_numbers()) {
      const double y = static_cast<double>(b);
      EXPECT_LE(ulps(evaluate_lane(Op::atan2, std::array{a, b}), std::atan2(x, y)), 4) << a << ' ' << b;
      EXPECT_LE(ulps(evaluate_lane(Op::pow, std::array{a, b}), std::pow(x, y)), 4) << a << " ^ " << b;
    }
  }
  EXPECT_EQ(evaluate_lane(Op::pow, std::array{0.0f, 0.0f}), 1);
  EXPECT_EQ(evaluate_lane(Op::pow, std::array{-2.0f, 3.0f}), -8);
  EXPECT_EQ(evaluate_lane(Op::pow, std::array{-2.0f, -2.0f}), 0.25f);
  EXPECT_TRUE(std::isnan(evaluate_lane(Op::pow, std::array{-2.0f, 0.5f})));
  EXPECT_EQ(evaluate_lane(Op::log, std::array{0.0f}), -inf);
  EXPECT_EQ(evaluate_lane(Op::exp, std::array{0.0f}), 1);
}

}  // namespace
}  // namespace tyndall::vm
