// Equi-angular sampling: published values, and its laws from D = 0 to D = 1e6.
#include "render/distance/equiangular.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::render {
namespace UNNAMED {

// A ray along z; the pivot at distance D from it, nearest at z = 0.
Equiangular about(double distance, const std::vector<Intervald>& marched) {
  return {{0, 0, 0}, {0, 0, 1}, {distance, 0, 0}, marched};
}

TEST(Equiangular, PublishedValues) {
  const std::vector<Intervald> marched{{-5, 5}};
  const Equiangular e = about(1, marched);
  EXPECT_NEAR(e.pdf(0), 0.36405979, 5e-9);
  EXPECT_NEAR(e.pdf(5), 0.01400230, 5e-9);
  EXPECT_NEAR(e.sample(0.75), 0.81980390, 5e-9);
}

struct Case {
  double distance;
  std::vector<Intervald> marched;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const double d : {0.0, 1e-300, 1e-150, 1e-30, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    if (d * d > 0) all.push_back({d, {{-5, 5}}});  // else the pivot counts as on the ray: see below
    all.push_back({d, {{0.5, 7}}});
    all.push_back({d, {{-3, -1}, {1e-3, 0.2}, {4, 1e4}}});
    all.push_back({d, {{1e5, 1e5 + 1e-3}}});
  }
  return all;
}

// P(t <= sample(u)) = u, with the probability from the angle in long double: samples follow the density.
// u = k/1000; the error allowed is the rounding of t in its interval.
TEST(Equiangular, SampleInvertsTheDistribution) {
  for (const Case& c : cases()) {
    const Equiangular e = about(c.distance, c.marched);
    ASSERT_TRUE(e.available()) << c.distance;
    // Mass up to t, unnormalised: the angle over D (its limit for D = 0).
    const auto mass = [&](double t) {
      long double sum = 0;
      const long double d = c.distance;
      for (const Intervald& s : c.marched) {
        const Intervald part = s.clipped_to({-infinity, t});
        if (part.empty()) continue;
        const long double a = part.lo, b = part.hi;
        sum += d > 0 ? atan2l(d * (b - a), d * d + a * b) / d : (b - a) / (a * b);
      }
      return sum;
    };
    const long double total = mass(c.marched.back().hi);
    for (int k = 1; k < 1000; ++k) {
      const double u = k / 1000.0, t = e.sample(u);
      bool inside = false;
      for (const Intervald& s : c.marched) inside |= s.lo <= t && t <= s.hi;
      ASSERT_TRUE(inside) << "D " << c.distance << " u " << u << " t " << t;
      const double slack = 1e-9 + 4e-16 * std::abs(t) * e.pdf(t);
      ASSERT_NEAR(static_cast<double>(mass(t) / total), u, slack)
          << "D " << c.distance << " u " << u << " t " << t;
    }
  }
}

// The density is the derivative of the distribution: between neighbouring samples it averages to du/dt.
TEST(Equiangular, DensityMatchesTheSamples) {
  for (const Case& c : cases()) {
    const Equiangular e = about(c.distance, c.marched);
    for (int k = 50; k < 950; k += 9) {
      const double t0 = e.sample((k - 0.01) / 1000), t1 = e.sample((k + 0.01) / 1000),
                   t = e.sample(k / 1000.0);
      const bool one_interval = std::any_of(c.marched.begin(), c.marched.end(),
                                            [&](const Intervald& s) { return s.lo <= t0 && t1 <= s.hi; });
      if (!one_interval || t1 - t0 < 1e-9 * std::abs(t)) continue;  // a jump, or too narrow to divide by
      EXPECT_NEAR(e.pdf(t) * (t1 - t0) / 2e-5, 1, 2e-3) << "D " << c.distance << " t " << t;
    }
  }
}

TEST(Equiangular, IsNotAvailableThroughThePivot) {
  const std::vector<Intervald> through{{-5, 5}}, none;
  EXPECT_FALSE(about(0, through).available());
  EXPECT_FALSE(about(1e-300, through).available());
  EXPECT_EQ(about(0, through).pdf(1), 0.0);
  EXPECT_FALSE(about(1, none).available());
}

}  // namespace
}  // namespace tyndall::render
