// Student's distribution against closed forms and tables.
#include "base/student_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall {
namespace UNNAMED {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(StudentT, OneAndTwoDegreesHaveClosedForms) {
  for (const double t : {0.0, 0.1, 0.5, 1.0, 3.0, 20.0, 1e3, 1e5}) {
    const double cauchy = 2 / std::numbers::pi * std::atan2(1.0, t);
    EXPECT_NEAR(student_t_two_sided(t, 1) / cauchy, 1, 1e-9) << t;
    const double root = std::sqrt(2 + t * t), two = 2 / (root * (root + t));  // 1 - t / root
    EXPECT_NEAR(student_t_two_sided(t, 2) / two, 1, 1e-9) << t;
    EXPECT_EQ(student_t_two_sided(-t, 2), student_t_two_sided(t, 2));
  }
}

TEST(StudentT, IsThatOfTables) {
  EXPECT_NEAR(student_t_two_sided(3.182446, 3), 0.05, 1e-7);
  EXPECT_NEAR(student_t_two_sided(2.131450, 15), 0.05, 1e-7);
  EXPECT_NEAR(student_t_two_sided(2.576, 1e6), 0.009995, 2e-6);
  EXPECT_NEAR(student_t_two_sided(1.959964, infinite), 0.05, 1e-7);
  EXPECT_EQ(student_t_two_sided(infinite, 3), 0);
}

TEST(StudentT, GoesToTheNormalDistribution) {
  for (const double t : {0.5, 2.0, 5.0, 8.0})
    EXPECT_NEAR(student_t_two_sided(t, 9e6) / student_t_two_sided(t, infinite), 1, 3e-4) << t;
}

TEST(StudentT, SignificanceOfManyTests) {
  EXPECT_NEAR(sidak_together(sidak_each(0.01, 5000), 5000), 0.01, 1e-12);
  EXPECT_NEAR(sidak_each(0.19, 2), 0.1, 1e-15);
  EXPECT_EQ(sidak_together(0, 10), 0);
  EXPECT_EQ(sidak_together(1, 10), 1);
  EXPECT_NEAR(fisher_together(std::log(0.03), 1), 0.03, 1e-15);
  EXPECT_NEAR(fisher_together(2 * std::log(0.1), 2), 0.01 * (1 - 2 * std::log(0.1)), 1e-15);
  EXPECT_EQ(fisher_together(0, 5), 1);
  EXPECT_EQ(fisher_together(-infinite, 5), 0);
  EXPECT_LT(fisher_together(100 * std::log(0.2), 100), 1e-5) << "chi-squared of 322 with 200 degrees";
}

}  // namespace UNNAMED
}  // namespace tyndall
