// Laws of the phase functions: normalisation, sample against eval, published moments, extremes in float.
#include "optics/phase.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/numerics.h"

namespace tyndall::optics {
namespace {

constexpr PhaseKind all_kinds[] = {PhaseKind::isotropic, PhaseKind::rayleigh, PhaseKind::hg,
                                   PhaseKind::draine, PhaseKind::droplets};

// Every kind at ordinary and at awkward parameters.
std::vector<Phase> cases() {
  std::vector<Phase> list;
  for (const PhaseKind kind : all_kinds) {
    switch (kind) {
      case PhaseKind::isotropic:
      case PhaseKind::rayleigh:
        list.push_back({kind, {}});
        break;
      case PhaseKind::hg:
        for (const float g : {-0.95f, -0.3f, -1e-6f, 0.f, 1e-6f, 0.5f, 0.85f, 0.99f})
          list.push_back({kind, {g, 0}});
        break;
      case PhaseKind::draine:
        for (const float g : {-0.7f, 0.f, 1e-5f, 0.3f, 0.75f, 0.95f})
          for (const float a : {0.f, 1.f, 30.f}) list.push_back({kind, {g, a}});
        break;
      case PhaseKind::droplets:
        for (const float d : {5e-6f, 10e-6f, 50e-6f}) list.push_back({kind, {d, 0}});
        break;
    }
  }
  return list;
}

std::string describe(const Phase& phase) {
  return std::string(keyword(phase.kind)) + "(" + std::to_string(phase.parameters[0]) + ", " +
         std::to_string(phase.parameters[1]) + ")";
}

// 2π ∫ f(cos) p dcos over m in [m0, m1], by 4-point Gauss-Legendre on cells that are geometric towards the
// ends, so that peaks of any width are met.
template <class F>
double integrate(const Phase& phase, double m0, double m1, F&& f) {
  constexpr std::array<double, 4> x{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                    0.8611363115940526};
  constexpr std::array<double, 4> w{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                    0.3478548451374538};
  std::vector<double> edges;
  for (int i = 0; i <= 400; ++i) edges.push_back(std::pow(10.0, -10.0 + 10.0 * i / 400));
  for (int i = 399; i >= 0; --i) edges.push_back(2 - edges[i]);
  edges.insert(edges.begin(), 0.0);
  edges.push_back(2.0);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double a = std::max(m0, edges[i]), b = std::min(m1, edges[i + 1]);
    if (!(a < b)) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const double m = 0.5 * (a + b) + 0.5 * (b - a) * x[k];
      sum += 0.5 * (b - a) * w[k] * f(1 - m) * phase.eval(static_cast<float>(m));
    }
  }
  return 2 * pi * sum;
}
double integrate(const Phase& phase, double m0, double m1) {
  return integrate(phase, m0, m1, [](double) { return 1.0; });
}

TEST(Phase, IntegratesToOne) {
  for (const Phase& phase : cases()) EXPECT_NEAR(integrate(phase, 0, 2), 1, 2e-5) << describe(phase);
}

TEST(Phase, MeanCosineIsTheFirstMoment) {
  for (const Phase& phase : cases())
    EXPECT_NEAR(integrate(phase, 0, 2, [](double c) { return c; }), phase.mean_cosine(), 2e-5)
        << describe(phase);
}

// χ² of 40,000 draws in 20 bins of equal probability by `eval`. Seed 1; significance 0.01 over all cases
// (Šidák), by the Wilson-Hilferty approximation of the χ² quantile.
TEST(Phase, SampleDrawsFromEval) {
  constexpr int bins = 20, draws = 40000;
  const std::vector<Phase> phases = cases();
  // Normal quantile of 1 - 0.01/35 for the number of cases here, at most 35: 3.446.
  ASSERT_LE(phases.size(), 35u);
  constexpr double z = 3.446, k = bins - 1;
  const double limit = k * std::pow(1 - 2 / (9 * k) + z * std::sqrt(2 / (9 * k)), 3);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  for (const Phase& phase : phases) {
    std::vector<double> edges{0};
    for (int i = 1; i < bins; ++i) {
      double low = edges.back(), high = 2;
      for (int step = 0; step < 45; ++step) {
        const double middle = 0.5 * (low + high);
        (integrate(phase, 0, middle) < static_cast<double>(i) / bins ? low : high) = middle;
      }
      edges.push_back(low);
    }
    std::vector<int> counts(bins, 0);
    for (int i = 0; i < draws; ++i) {
      const float m = phase.sample(uniform(random), uniform(random));
      ASSERT_TRUE(m >= 0 && m <= 2) << describe(phase) << " m = " << m;
      ++counts[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), m) - edges.begin() - 1)];
    }
    double chi2 = 0;
    for (const int count : counts) chi2 += sqr(count - draws / double(bins)) / (draws / double(bins));
    EXPECT_LT(chi2, limit) << describe(phase);
  }
}

TEST(Phase, HenyeyGreensteinPublishedCdfAndMoments) {
  struct Row {
    float g;
    std::array<double, 3> cdf;  // P(cos <= 0, .5, .9)
  };
  const std::array<double, 3> cosines{0, 0.5, 0.9};
  for (const Row& row : {Row{0.3f, {.286037, .539717, .878406}}, Row{0.85f, {.036140, .086520, .283812}}}) {
    const Phase phase{PhaseKind::hg, {row.g, 0}};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(integrate(phase, 1 - cosines[i], 2), row.cdf[i], 2e-6);
    // Legendre moments are powers of g.
    EXPECT_NEAR(integrate(phase, 0, 2, [](double c) { return 1.5 * c * c - 0.5; }), sqr(row.g), 2e-5);
    EXPECT_NEAR(integrate(phase, 0, 2, [](double c) { return 2.5 * c * c * c - 1.5 * c; }),
                row.g * sqr(row.g), 2e-5);
    // The sampler's inverse is the same distribution: P(cos <= c) = u where it returns c.
    for (const double cosine : cosines) {
      const auto cdf = static_cast<float>(integrate(phase, 1 - cosine, 2));
      EXPECT_NEAR(1 - hg_sample(row.g, cdf), cosine, 1e-5);
    }
  }
}

TEST(Phase, RayleighMeanSquaredCosine) {
  EXPECT_NEAR(integrate({PhaseKind::rayleigh, {}}, 0, 2, [](double c) { return c * c; }), 0.4, 1e-6);
}

TEST(Phase, DropletsPublishedValues) {
  const Phase phase{PhaseKind::droplets, {10e-6f, 0}};
  EXPECT_NEAR(phase.mean_cosine(), .86416, 5e-6);
  EXPECT_NEAR(phase.eval(1), .001726, 5e-7);
  EXPECT_NEAR(phase.eval(2), .01271, 5e-6);
}

TEST(Phase, DropletDiameterIsClampedToTheFit) {
  EXPECT_EQ(Phase({PhaseKind::droplets, {1e-6f, 0}}).eval(0.3f),
            Phase({PhaseKind::droplets, {5e-6f, 0}}).eval(0.3f));
  EXPECT_EQ(Phase({PhaseKind::droplets, {1.f, 0}}).eval(0.3f),
            Phase({PhaseKind::droplets, {50e-6f, 0}}).eval(0.3f));
}

TEST(Phase, DraineWithoutItsFactorIsHenyeyGreenstein) {
  for (const float g : {-0.9f, -0.2f, 0.f, 0.6f, 0.99f})
    for (const float u : {0.f, 0.1f, 0.5f, 0.9f, one_minus_ulp_f}) {
      const Phase draine{PhaseKind::draine, {g, 0}};
      const float m = hg_sample(g, u);
      // Backward lobes are mirrored, so there m is exact to the spacing of floats below 2.
      EXPECT_NEAR(draine.sample(u, 0), m, 1e-6f * m + (g < 0 ? 2.4e-7f : 0.f)) << g << " " << u;
      EXPECT_FLOAT_EQ(draine.eval(m), hg_eval(g, m)) << g << " " << u;
    }
}

TEST(Phase, DraineAtGZeroAndOneIsRayleigh) {
  const Phase draine{PhaseKind::draine, {0, 1}}, rayleigh{PhaseKind::rayleigh, {}};
  for (const float u : {0.f, 0.1f, 0.5f, 0.7f, one_minus_ulp_f}) {
    const float m = rayleigh.sample(u, 0);
    EXPECT_NEAR(draine.sample(u, 0), m, 1e-6f) << u;
    EXPECT_FLOAT_EQ(draine.eval(m), rayleigh.eval(m)) << u;
  }
}

// At |g| = 0.9999 the peak is 1e-4 rad wide. Float against the textbook formulas in double on the same
// arguments; stated error 4e-7 relative for eval; for sampling 1e-6 relative in m, the distance from the peak
// at g > 0, and half an ulp of 2 plus 1e-6 (2 - m) at g < 0.
TEST(Phase, ExtremeAnisotropyInFloat) {
  for (const float g : {0.9999f, -0.9999f}) {
    for (const double base : {1e-9, 1e-8, 1e-7, 1e-5, 1e-3, 0.1, 1.0, 1.9, 1.9999999, 2.0}) {
      const auto m = static_cast<float>(base);
      const double gd = g, cosine = 1 - static_cast<double>(m);
      const double expected = inv_4pi * (1 - gd * gd) / std::pow(1 + gd * gd - 2 * gd * cosine, 1.5);
      EXPECT_NEAR(hg_eval(g, m), expected, 4e-7 * expected) << g << " " << m;
    }
    for (const float u : {0.f, 1e-6f, 1e-3f, 0.25f, 0.5f, 0.9f, 0.999f, one_minus_ulp_f}) {
      // x² - (1 - g)² factored, or the textbook form loses the peak's digits even here.
      const double gd = g, v = 1.0 - u, x = (1 - gd * gd) / (1 - gd + 2 * gd * u);
      const double expected = (1 - gd) * v / (1 - gd + 2 * gd * u) * (x + 1 - gd);
      const double error = g > 0 ? 1e-6 * expected : 1.2e-7 + 1e-6 * (2 - expected);
      EXPECT_NEAR(hg_sample(g, u), expected, error) << g << " " << u;
    }
  }
}

TEST(Phase, GIsClampedBelowOne) {
  EXPECT_EQ(hg_eval(1, 0.5f), hg_eval(0.9999f, 0.5f));
  EXPECT_EQ(hg_eval(-3, 0.5f), hg_eval(-0.9999f, 0.5f));
  EXPECT_TRUE(std::isfinite(Phase({PhaseKind::draine, {1, 1}}).eval(0)));
}

// Down to the smallest float angles the turned direction has the asked angle: 1e-5 relative plus float
// spacing.
TEST(Phase, RotateFromTurnsByTheAngle) {
  const Vec3f directions[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, normalize(Vec3f(1, -2, 3))};
  for (const Vec3f& w : directions)
    for (const float m : {0.f, 1e-8f, 1e-4f, 0.5f, 1.f, 1.7f, 2.f})
      for (const float phi : {0.f, 1.f, 4.f}) {
        const Vec3f v = rotate_from(w, m, phi);
        EXPECT_NEAR(length(v), 1, 2e-7f);
        // The components' rounding of 6e-8 moves a distance of √(2m) by as much: m by √(2m) 1.5e-7.
        EXPECT_NEAR(one_minus_cos(w, v), m, 1e-6f * m + 2e-7f * std::sqrt(2 * m) + 2e-14f) << m << " " << phi;
      }
}

TEST(Phase, KeywordsAreDistinct) {
  for (const PhaseKind a : all_kinds)
    for (const PhaseKind b : all_kinds) EXPECT_EQ(keyword(a) == keyword(b), a == b);
}

}  // namespace
}  // namespace tyndall::optics
