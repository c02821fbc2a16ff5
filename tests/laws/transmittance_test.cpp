// Optical depths and emission of known densities, through whole pictures.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "support/law_scenes.h"
#include "support/measure.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

// However a march jitters, E[τ̂] = τ, and τ̂ moves within a range of step · total variation of the density.
// Hoeffding's lemma: the mean of e^-τ̂ exceeds e^-τ by at most exp(range²/8) - 1 of it.
double bias_bound(const KnownDensity& known, double step) {
  return std::exp(-known.tau) * std::expm1(std::pow(step * known.total_variation, 2) / 8);
}

TEST(OpticalDepth, PublishedRows) {
  for (const KnownDensity& known : known_densities())
    for (const double step : {0.1, 0.01}) {
      SceneBuilder builder = known_density(known);
      builder.image(32, 32, 4).step(step);
      const double truth = std::exp(-known.tau);
      expect_truth(measure(builder.scene).whole(), truth, bias_bound(known, step) + 1e-6 * truth, 0.01,
                   known.name + ", step " + std::to_string(step));
    }
}

// The bias of the plain march, E[e^-τ̂] - e^-τ = e^-τ var(τ̂)/2, falls at least fourfold when the step halves.
TEST(OpticalDepth, BiasFallsFourfoldAHalving) {
  const KnownDensity known = known_densities().back();
  ASSERT_EQ(known.name, "3x²");
  std::vector<double> bias, error;
  for (const int steps : {2, 4, 8}) {
    SceneBuilder builder = known_density(known);
    builder.image(64, 64, 64).step(1.0 / steps);
    const Estimate estimate = measure(builder.scene).whole();
    bias.push_back(estimate.mean.y - std::exp(-1));
    error.push_back(estimate.standard_error.y);
  }
  EXPECT_GT(bias[0], 10 * error[0]) << "the bias at the coarse step is there to be measured";
  for (std::size_t i = 0; i + 1 < bias.size(); ++i)
    EXPECT_LE(bias[i + 1], bias[i] / 4 * 1.15 + sigmas * std::hypot(error[i] / 4, error[i + 1]))
        << "halving " << i << ": " << bias[i] << " then " << bias[i + 1];
}

// Neighbouring volumes multiply: T(a, c) = T(a, b) T(b, c), to the rounding of floats for closed forms.
TEST(Transmittance, IsMultiplicative) {
  const auto through = [](double from, double to, bool split) {
    SceneBuilder builder;
    builder.image(4, 4, 1).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6).environment(1);
    MediumColors colors;
    colors.sigma_t = Rgb(0.3f, 1, 2.7f);
    colors.albedo = Rgb(0);
    const scene::MediumId medium = builder.constant(colors);
    const double middle = split ? 0.5 * (from + to) : to;
    builder.volume(scene::Box{{from, -1, -1}, {middle, 1, 1}}, medium);
    if (split) builder.volume(scene::Box{{middle, -1, -1}, {to, 1, 1}}, medium);
    return measure(builder.scene).whole().mean;
  };
  const Vec3d one = through(0, 1.3, false), left = through(0, 0.65, false), right = through(0.65, 1.3, false);
  const Vec3d split = through(0, 1.3, true);
  const Vec3d truth{std::exp(-0.3f * 1.3), std::exp(-1.3), std::exp(-2.7f * 1.3)};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(one[c], truth[c], 1e-6 * truth[c]);
    EXPECT_NEAR(left[c] * right[c], one[c], 1e-6 * one[c]);
    EXPECT_NEAR(split[c], one[c], 1e-6 * one[c]);
  }
}

// The same both ways, for a density without symmetry.
TEST(Transmittance, IsTheSameBothWays) {
  const auto look = [](bool reverse) {
    SceneBuilder builder;
    MediumColors absorbing;
    absorbing.albedo = Rgb(0);
    builder.image(32, 32, 16)
        .step(0.1)
        .environment(1)
        .volume(scene::Box{{0, -1, -1}, {1, 1, 1}},
                builder.shader(absorbing, [](const Point& p) { return p.x * p.x * 3.f + exp(p.x * -9.f); }));
    builder.orthographic(reverse ? Vec3d(2, 0, 0) : Vec3d(-1, 0, 0), {0.5, 0, 0}, 1e-6);
    return measure(builder.scene).whole();
  };
  expect_same(look(false), look(true), 0, 0.01, "forth and back");
}

// A density whose period is the step defeats one offset for the whole ray: it sees the same phase everywhere
// and is wrong by I0(2) = 2.28. Jitter in every segment keeps the bound of Hoeffding, exp(Σ Δ² (M - m)² / 8)
// - 1.
TEST(Transmittance, SurvivesADensityWithThePeriodOfTheStep) {
  constexpr int steps = 64;
  constexpr double length = 2, step = length / steps;
  SceneBuilder builder;
  MediumColors absorbing;
  absorbing.albedo = Rgb(0);
  builder.image(32, 32, 16).step(step).environment(1).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6);
  builder.volume(scene::Box{{0, -1, -1}, {length, 1, 1}}, builder.shader(absorbing, [](const Point& p) {
    return cos(p.x * static_cast<float>(2 * pi / step)) + 1.f;
  }));
  const double truth = std::exp(-length), bound = std::exp(steps * step * step * 4 / 8) - 1;
  expect_truth(measure(builder.scene).whole(), truth, bound * truth, 0.01, "period of the step");
}

// A ray of length 1 along x through an emitting and absorbing box.
double emitted(const MediumColors& colors, const Density& density) {
  SceneBuilder builder;
  builder.image(32, 32, 16).step(0.005).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6);
  const scene::MediumId medium = density ? builder.shader(colors, density) : builder.constant(colors);
  builder.volume(scene::Box{{0, -1, -1}, {1, 1, 1}}, medium);
  return measure(builder.scene).whole().mean.y;
}

MediumColors burning() {
  MediumColors colors;
  colors.albedo = Rgb(0);
  colors.emission = Rgb(1);
  return colors;
}

// Emission in proportion to density, and τ = 1: 1 - 1/e for any density. The allowance is the bias bound of a
// march with step 0.005 and total variation at most 10, (0.005 · 10 / 2)² / 2 e^-1.
TEST(Emission, DependsOnOpticalDepthAlone) {
  const double truth = 1 - std::exp(-1), allowance = 1.1e-5;
  EXPECT_NEAR(emitted(burning(), {}), truth, 1e-6);
  EXPECT_NEAR(emitted(burning(), [](const Point& p) { return p.x.like(1); }), truth, 1e-6);
  EXPECT_NEAR(emitted(burning(), [](const Point& p) { return p.x * p.x * 3.f; }), truth, allowance);
  EXPECT_NEAR(emitted(burning(), [](const Point& p) { return p.x * 2.f; }), truth, allowance);
  EXPECT_NEAR(emitted(burning(), [](const Point& p) { return less(fract(p.x * 4.f), 0.25f) * 4.f; }), truth,
              1e-3);
}

// σa = 1 and emission growing with distance x: ∫ x e^-x = 1 - 2/e. The step's midpoints are exact for it to
// 1e-5.
TEST(Emission, GrowingWithDistance) {
  SceneBuilder builder;
  builder.image(32, 32, 16).step(0.005).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6);
  MediumColors absorbing = burning(), glowing = burning();
  absorbing.emission = Rgb(0);
  glowing.sigma_t = Rgb(0);
  const scene::Box box{{0, -1, -1}, {1, 1, 1}};
  builder.volume(box, builder.constant(absorbing)).volume(box, builder.shader(glowing, [](const Point& p) {
    return p.x;
  }));
  expect_truth(measure(builder.scene).whole(), 1 - 2 * std::exp(-1), 1e-5, 0.001, "emission along x");
}

// Without extinction the integral of emission is its length, whatever the stable forms do at σ = 0.
TEST(Emission, WithoutExtinction) {
  MediumColors glowing = burning();
  glowing.sigma_t = Rgb(0);
  glowing.emission = Rgb(2.5f);
  EXPECT_NEAR(emitted(glowing, {}), 2.5, 1e-6);
}

}  // namespace
}  // namespace tyndall
