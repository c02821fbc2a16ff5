// The estimators of transmittance against exact values of known densities (transport §4).
// 65536 independent estimates each; a comparison accepts 4 standard errors (significance 6e-5), seed 1.
#include <gtest/gtest.h>

#include "render/transmittance/transmittance_estimators.h"
#include "support/transmittance_measure.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;
using render::Transmittance;

constexpr int estimates = 1 << 16;

bool smooth(const KnownDensity& known) { return known.total_variation < 20; }

// E[τ̂] = τ for each march, so the plain estimate is too bright, by no more than Hoeffding's bound of a march
// whose mirrored pairs are independent: exp(Σ range²/8) - 1, where a pair's range is at most step times twice
// the variation in it. Σ range² <= step² · 4 · variation² / 1.
TEST(MarchedTransmittance, IsTooBrightWithinItsBound) {
  for (const KnownDensity& known : transmittance_densities()) {
    if (!smooth(known)) continue;
    for (const double step : {0.2, 0.05}) {
      const TransmittanceMeasure m = measure_transmittance(known, Transmittance::march, step, estimates);
      const double truth = std::exp(-known.tau), rounding = 1e-6 * truth;
      const double bound = truth * std::expm1(std::pow(step * known.total_variation, 2) / 8);
      EXPECT_GE(m.mean, truth - 4 * m.standard_error - rounding) << known.name << ", step " << step;
      EXPECT_LE(m.mean, truth + bound + 4 * m.standard_error + rounding) << known.name << ", step " << step;
    }
  }
}

// The power series has no bias at any step, on any density that leaves it a finite variance.
TEST(SeriesTransmittance, IsUnbiased) {
  for (const KnownDensity& known : transmittance_densities()) {
    if (known.name == "spike") continue;
    for (const double step : {0.3, 0.1, 0.03}) {
      const TransmittanceMeasure m = measure_transmittance(known, Transmittance::series, step, estimates);
      const double truth = std::exp(-known.tau);
      EXPECT_NEAR(m.mean, truth, 4 * m.standard_error + 1e-6 * truth) << known.name << ", step " << step;
    }
  }
}

// Of independent normal estimates the jackknife is unbiased whatever their variance: quadrature over a grid.
TEST(Jackknife, IsExactForNormalEstimates) {
  for (const double s : {0.1, 0.5, 1.0}) {
    double sum = 0, weight = 0;
    for (double a = -8; a <= 8; a += 0.02)
      for (double b = -8; b <= 8; b += 0.02) {
        const double w = std::exp(-0.5 * (a * a + b * b));
        sum += w * render::jackknife(2 + s * a, 2 + s * b);
        weight += w;
      }
    EXPECT_NEAR(sum / weight, std::exp(-2.0), 1e-9) << "sd " << s;
  }
}

// The series is for estimates of any distribution: here 0.5 or 1.5, as often.
TEST(PowerSeries, IsUnbiasedForTwoPointEstimates) {
  constexpr std::uint32_t draws = 1 << 20;
  double sum = 0, squares = 0, used = 0;
  std::vector<double> x;
  for (std::uint32_t draw = 0; draw < draws; ++draw) {
    x.clear();
    for (std::uint32_t k = 0; k <= render::series_order(draw); ++k)
      x.push_back(hash_bits(draw, k) >> 63 ? 0.5 : 1.5);
    const double t = render::power_series(x);
    sum += t;
    squares += t * t;
    used += static_cast<double>(x.size());
  }
  const double mean = sum / draws, error = std::sqrt((squares / draws - mean * mean) / draws);
  EXPECT_NEAR(mean, std::exp(-1.0), 4 * error);
  EXPECT_LT(error, 1e-3);
  EXPECT_LT(used / draws, 1.4) << "estimates that one value costs";
}

// Ratio and residual ratio tracking have no bias either, and know nothing of steps: also not of the spike's,
// whose variance is only that of random points.
TEST(RatioTransmittance, IsUnbiased) {
  for (const KnownDensity& known : transmittance_densities())
    for (const auto& [name, method] : all_transmittances()) {
      if (!render::by_ratio(method)) continue;
      const TransmittanceMeasure m = measure_transmittance(known, method, 0.1, estimates);
      const double truth = std::exp(-known.tau);
      EXPECT_NEAR(m.mean, truth, 4 * m.standard_error + 1e-6 * truth) << known.name << ", " << name;
      EXPECT_LT(m.standard_error, 0.05 * truth) << known.name;
    }
}

// What the jackknife gains: at as many evaluations its bias is a small part of the march's where that is
// large, as long as the depths scatter by less than about 1.
TEST(JackknifeTransmittance, HasLessBiasThanTheMarch) {
  for (const KnownDensity& known : transmittance_densities()) {
    if (known.name != "waves" && known.name != "gaussian, b 0.000000") continue;
    const double step = known.name == "waves" ? 0.1 : 0.4, truth = std::exp(-known.tau);
    const TransmittanceMeasure march = measure_transmittance(known, Transmittance::march, step, estimates),
                               jackknife =
                                   measure_transmittance(known, Transmittance::jackknife, step, estimates);
    EXPECT_LE(jackknife.evaluations, 1.25 * march.evaluations) << known.name;
    EXPECT_GT(march.mean - truth, 0.05 * truth) << known.name;
    EXPECT_LT(std::abs(jackknife.mean - truth), (march.mean - truth) / 5) << known.name;
  }
}

// Where it fails, and so does the march: all of the optical depth in a spike that most marches miss, though
// most of the empty space around it is skipped: two marches of eight places each look at fewer.
TEST(JackknifeTransmittance, FailsOnNarrowSpikes) {
  const KnownDensity spike = transmittance_densities().back();
  ASSERT_EQ(spike.name, "spike");
  const TransmittanceMeasure m = measure_transmittance(spike, Transmittance::jackknife, 1.0 / 16, estimates);
  EXPECT_LE(m.evaluations, 16);
  EXPECT_GT(m.mean, 10 * std::exp(-spike.tau));
}

}  // namespace
}  // namespace tyndall
