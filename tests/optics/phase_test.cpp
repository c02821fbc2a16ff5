// Laws of the phase functions: normalisation, sample against eval, published moments, extremes in float.
#include "optics/phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/numerics.h"

namespace tyndall::optics {
namespace UNNAMED {

struct Case {
  PhaseKind kind;
  std::array<float, most_phase_parameters> parameters{};

  Phase phase() const { return {kind, parameters}; }
};
template <class Function>
Case named(const Function& function) {
  Case c{phase_kind<Function>, {}};
  std::size_t i = 0;
  Function::fields([&](auto member, const PhaseParameter&) { c.parameters[i++] = function.*member; });
  return c;
}

// Every kind, over a grid of its parameters' ranges. The very ends of a peak's width have tests of their own.
std::vector<Case> cases() {
  std::vector<Case> list;
  for (const PhaseInfo& function : phase_functions()) {
    std::vector<Case> grid{{function.kind, {}}};
    for (std::size_t k = 0; k < function.parameters.size(); ++k) {
      const PhaseParameter& p = function.parameters[k];
      std::vector<Case> finer;
      for (const Case& c : grid)
        for (const double share : {0.02, 0.25, 0.5, 0.98}) {
          finer.push_back(c);
          finer.back().parameters[k] = static_cast<float>(lerp(p.lowest, p.highest, share));
        }
      grid = std::move(finer);
    }
    list.insert(list.end(), grid.begin(), grid.end());
  }
  for (const float g : {-1e-6f, 1e-6f, 0.99f}) list.push_back(named(HenyeyGreenstein{g}));
  for (const float g : {-0.7f, 0.f, 1e-5f, 0.95f})
    for (const float a : {0.f, 1.f, 30.f}) list.push_back(named(Draine{g, a}));
  for (const float mu : {3.5835f, 5.f}) list.push_back(named(FournierForand{1.1f, mu}));
  return list;
}

std::string describe(const Case& c) {
  std::string text(info(c.kind).keyword);
  for (const float parameter : c.parameters) text += " " + std::to_string(parameter);
  return text;
}

// Cells of m, geometric towards the ends so that peaks of any width are met.
const std::vector<double>& cells() {
  static const std::vector<double> edges = [] {
    std::vector<double> e{0};
    for (int i = 0; i <= 400; ++i) e.push_back(std::pow(10.0, -10.0 + 10.0 * i / 400));
    for (int i = 399; i >= 0; --i) e.push_back(2 - std::pow(10.0, -10.0 + 10.0 * i / 400));
    e.push_back(2);
    return e;
  }();
  return edges;
}

// 2π ∫ f(cos) p dcos over m in [m0, m1], by 4-point Gauss-Legendre on the cells.
template <class F>
double integrate(const Phase& phase, double m0, double m1, F&& f) {
  constexpr std::array<double, 4> x{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                    0.8611363115940526};
  constexpr std::array<double, 4> w{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                    0.3478548451374538};
  const std::vector<double>& edges = cells();
  const auto first = std::upper_bound(edges.begin(), edges.end(), m0) - edges.begin();
  double sum = 0;
  for (auto i = static_cast<std::size_t>(first - 1); i + 1 < edges.size() && edges[i] < m1; ++i) {
    const double a = std::max(m0, edges[i]), b = std::min(m1, edges[i + 1]);
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

// The m below which a share lies.
double quantile(const Phase& phase, double share) {
  const std::vector<double>& edges = cells();
  double below = 0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double here = integrate(phase, edges[i], edges[i + 1]);
    if (below + here < share && i + 2 < edges.size()) {
      below += here;
      continue;
    }
    double low = edges[i], high = edges[i + 1];
    for (int step = 0; step < 45; ++step) {
      const double middle = 0.5 * (low + high);
      (below + integrate(phase, edges[i], middle) < share ? low : high) = middle;
    }
    return low;
  }
  return 2;
}

// Of the normal distribution, for a probability p above 1/2.
double normal_quantile(double p) {
  double low = 0, high = 10;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return low;
}

TEST(Phase, IntegratesToOne) {
  for (const Case& c : cases()) EXPECT_NEAR(integrate(c.phase(), 0, 2), 1, 2e-5) << describe(c);
}

TEST(Phase, MeanCosineIsTheFirstMoment) {
  for (const Case& c : cases())
    EXPECT_NEAR(integrate(c.phase(), 0, 2, [](double cosine) { return cosine; }), c.phase().mean_cosine(),
                2e-5)
        << describe(c);
}

TEST(Phase, IsNowhereNegative) {
  for (const Case& c : cases())
    for (const double m : cells()) ASSERT_GE(c.phase().eval(static_cast<float>(m)), 0) << describe(c) << m;
}

TEST(Phase, SoftenedIsNormalisedAndBetweenItselfAndIsotropic) {
  for (const Case& c : cases()) {
    const Phase phase = c.phase();
    for (const double m : {1e-3, 0.1, 1.0, 1.9}) {
      EXPECT_FLOAT_EQ(phase.eval_softened(static_cast<float>(m), 1), phase.eval(static_cast<float>(m)));
      EXPECT_NEAR(phase.eval_softened(static_cast<float>(m), 0), inv_4pi, 1e-7) << describe(c);
    }
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cells().size(); ++i) {
      const double a = cells()[i], b = cells()[i + 1];
      for (const double x : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)})
        sum +=
            0.5 * (b - a) * phase.eval_softened(static_cast<float>(0.5 * (a + b) + 0.5 * (b - a) * x), 0.5f);
    }
    EXPECT_NEAR(2 * pi * sum, 1, 2e-5) << describe(c);
  }
}

// p(w, w') = p(w', w), to the last bit: paths may be followed from either end.
TEST(Phase, IsReciprocal) {
  std::mt19937_64 random(3);
  std::normal_distribution<float> normal;
  for (const Case& c : cases()) {
    const Vec3f a = normalize(Vec3f(normal(random), normal(random), normal(random)));
    const Vec3f b = normalize(Vec3f(normal(random), normal(random), normal(random)));
    EXPECT_EQ(c.phase().eval(one_minus_cos(a, b)), c.phase().eval(one_minus_cos(b, a))) << describe(c);
  }
}

// χ² of 40,000 draws in 20 bins of equal probability by `eval`. Seed 1; significance 0.01 over all cases
// (Šidák), by the Wilson-Hilferty approximation of the χ² quantile.
TEST(Phase, SampleDrawsFromEval) {
  constexpr int bins = 20, draws = 40000;
  const std::vector<Case> all = cases();
  const double z = normal_quantile(std::pow(0.99, 1.0 / static_cast<double>(all.size())));
  constexpr double k = bins - 1;
  const double limit = k * std::pow(1 - 2 / (9 * k) + z * std::sqrt(2 / (9 * k)), 3);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  for (const Case& c : all) {
    const Phase phase = c.phase();
    std::vector<double> edges{0};
    for (int i = 1; i < bins; ++i) edges.push_back(quantile(phase, static_cast<double>(i) / bins));
    std::vector<int> counts(bins, 0);
    for (int i = 0; i < draws; ++i) {
      const float m = phase.sample(uniform(random), uniform(random));
      ASSERT_TRUE(m >= 0 && m <= 2) << describe(c) << " m = " << m;
      ++counts[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), m) - edges.begin() - 1)];
    }
    double chi2 = 0;
    for (const int count : counts) chi2 += sqr(count - draws / double(bins)) / (draws / double(bins));
    EXPECT_LT(chi2, limit) << describe(c);
  }
}

// Every number in [0, 1) is inverted, at the ends of the parameters' ranges too: F(sample(u)) = u.
TEST(Phase, FournierForandInvertsItsCumulativeFunction) {
  for (const float n : {1.01f, 1.1f, 1.35f})
    for (const float mu : {3.01f, 3.3f, 3.5835f, 4.5f, 5.f}) {
      FournierForand f{n, mu};
      f.prepare();
      for (const float u : {0.f, 1e-7f, 1e-3f, 0.3f, 0.9f, 0.999f, one_minus_ulp_f}) {
        const float m = f.sample(u, 0);
        ASSERT_TRUE(m >= 0 && m <= 2) << n << " " << mu << " " << u;
        if (m >= 1e-8f) {
          EXPECT_NEAR(f.cumulative(0.5 * static_cast<double>(m)), u, 1e-7) << n << " " << mu << " " << u;
        }
      }
    }
}

// Fournier and Forand 1994 as Mobley writes it, away from where its terms cancel.
TEST(Phase, FournierForandIsThePublishedForm) {
  for (const double n : {1.05, 1.1, 1.2})
    for (const double mu : {3.3, 3.5835, 4.0, 4.7}) {
      const double nu = (3 - mu) / 2;
      const auto delta = [&](double x) { return 4 / (3 * sqr(n - 1)) * x; };  // x = sin²(theta / 2)
      for (const double degrees : {1.0, 3.0, 25.0, 70.0, 90.0, 130.0, 175.0}) {
        const double theta = degrees * pi / 180, x = sqr(std::sin(theta / 2)), d = delta(x), d180 = delta(1);
        const double dn = std::pow(d, nu), d180n = std::pow(d180, nu);
        const double expected =
            (nu * (1 - d) - (1 - dn) + (d * (1 - dn) - nu * (1 - d)) / x) / (4 * pi * sqr(1 - d) * dn) +
            (1 - d180n) / (16 * pi * (d180 - 1) * d180n) * (3 * sqr(std::cos(theta)) - 1);
        EXPECT_NEAR(Phase(FournierForand{static_cast<float>(n), static_cast<float>(mu)})
                        .eval(static_cast<float>(2 * x)),
                    expected, 2e-5 * expected)
            << n << " " << mu << " " << degrees;
      }
    }
}

// Mobley, Ocean Optics web book: B = 1 - (1 - d90^(nu+1) - (1 - d90^nu) / 2) / ((1 - d90) d90^nu). At n
// = 1.10 and mu = 3.5835 it is 0.0183, Petzold's average particle.
TEST(Phase, FournierForandBackscattersThePublishedShare) {
  for (const double n : {1.02, 1.1, 1.3})
    for (const double mu : {3.2, 3.5835, 4.6}) {
      const double nu = (3 - mu) / 2, d90 = 4 / (3 * sqr(n - 1)) * 0.5, dn = std::pow(d90, nu);
      const double expected = 1 - (1 - dn * d90 - 0.5 * (1 - dn)) / ((1 - d90) * dn);
      const Phase phase = FournierForand{static_cast<float>(n), static_cast<float>(mu)};
      EXPECT_NEAR(integrate(phase, 1, 2), expected, 1e-5 * expected + 1e-7) << n << " " << mu;
    }
  EXPECT_NEAR(integrate(FournierForand{1.1f, 3.5835f}, 1, 2), 0.0183, 5e-5);
}

TEST(Phase, FournierForandOfTheSteepestSlopeIsRayleigh) {
  const Phase f = FournierForand{1.1f, 5}, rayleigh = Rayleigh{};
  for (const float m : {0.f, 0.01f, 0.4f, 1.f, 1.9f, 2.f})
    EXPECT_NEAR(f.eval(m), rayleigh.eval(m), 1e-6f) << m;
}

// The published form is 0/0 where d = 1, and cancels around it: a step of m there changes it smoothly.
TEST(Phase, FournierForandIsSmoothAcrossItsSingularPlace) {
  FournierForand f{1.1f, 3.5835f};
  f.prepare();
  const double there = f.density(f.x0);
  for (const double off : {1e-12, 1e-8, 1e-5, 0.99e-3, 1.01e-3, 3e-3}) {
    const double above = f.density(f.x0 * (1 + off)), below = f.density(f.x0 * (1 - off));
    EXPECT_NEAR(above + below, 2 * there, (5 * off * off + 1e-12) * there) << off;
  }
}

TEST(Phase, HenyeyGreensteinPublishedCdfAndMoments) {
  struct Row {
    float g;
    std::array<double, 3> cdf;  // P(cos <= 0, .5, .9)
  };
  const std::array<double, 3> cosines{0, 0.5, 0.9};
  for (const Row& row : {Row{0.3f, {.286037, .539717, .878406}}, Row{0.85f, {.036140, .086520, .283812}}}) {
    const Phase phase = HenyeyGreenstein{row.g};
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
  EXPECT_NEAR(integrate(Rayleigh{}, 0, 2, [](double c) { return c * c; }), 0.4, 1e-6);
}

TEST(Phase, DropletsPublishedValues) {
  const Phase phase = Droplets{10e-6f};
  EXPECT_NEAR(phase.mean_cosine(), .86416, 5e-6);
  EXPECT_NEAR(phase.eval(1), .001726, 5e-7);
  EXPECT_NEAR(phase.eval(2), .01271, 5e-6);
}

TEST(Phase, DropletDiameterIsClampedToTheFit) {
  EXPECT_EQ(Phase(Droplets{1e-6f}).eval(0.3f), Phase(Droplets{5e-6f}).eval(0.3f));
  EXPECT_EQ(Phase(Droplets{1}).eval(0.3f), Phase(Droplets{50e-6f}).eval(0.3f));
}

TEST(Phase, DraineWithoutItsFactorIsHenyeyGreenstein) {
  for (const float g : {-0.9f, -0.2f, 0.f, 0.6f, 0.99f})
    for (const float u : {0.f, 0.1f, 0.5f, 0.9f, one_minus_ulp_f}) {
      const Phase draine = Draine{g, 0};
      const float m = hg_sample(g, u);
      // Backward lobes are mirrored, so there m is exact to the spacing of floats below 2.
      EXPECT_NEAR(draine.sample(u, 0), m, 1e-6f * m + (g < 0 ? 2.4e-7f : 0.f)) << g << " " << u;
      EXPECT_FLOAT_EQ(draine.eval(m), hg_eval(g, m)) << g << " " << u;
    }
}

TEST(Phase, DraineAtGZeroAndOneIsRayleigh) {
  const Phase draine = Draine{0, 1}, rayleigh = Rayleigh{};
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
  EXPECT_TRUE(std::isfinite(Phase(Draine{1, 1}).eval(0)));
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
  for (const PhaseInfo& a : phase_functions())
    for (const PhaseInfo& b : phase_functions()) EXPECT_EQ(a.keyword == b.keyword, a.kind == b.kind);
}

}  // namespace
}  // namespace tyndall::optics
