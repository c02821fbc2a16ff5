// Russian roulette changes no mean, where paths are longest: media a hundred free paths thick that absorb
// little or nothing. Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/law_scenes.h"
#include "support/measure.h"
#include "support/transmittance_measure.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

// What a half-space that scatters alike in all directions reflects of a white sky, straight up: 1 - √(1-c)
// H(1), with H from Chandrasekhar's equation 1/H(u) = √(1-c) + c/2 ∫ v H(v) / (u + v) dv by iteration
// (Radiative Transfer, 1950, chapter V).
double reflected_straight_up(double albedo) {
  constexpr int points = 400;
  const double root = std::sqrt(1 - albedo);
  std::vector<double> h(points, 1);
  const auto at = [&](double u) {
    double sum = 0;
    for (int i = 0; i < points; ++i) {
      const double v = (i + 0.5) / points;
      sum += v * h[i] / (u + v) / points;
    }
    return 1 / (root + 0.5 * albedo * sum);
  };
  for (int round = 0; round < 200; ++round) {
    std::vector<double> next(points);
    for (int i = 0; i < points; ++i) next[i] = 0.5 * (h[i] + at((i + 0.5) / points));
    h = next;
  }
  return 1 - root * at(1);
}

TEST(Roulette, ThePublishedHalfSpaces) {
  EXPECT_NEAR(reflected_straight_up(0.5), 0.115226, 1e-5);
  EXPECT_NEAR(reflected_straight_up(0.99), 0.752721, 1e-4);
}

// A slab of optical thickness 100 whose albedo is 0.999 is a half-space to e^-11: free paths of 1/100, a
// diffusion length of 1/√(3 · 0.001) of them. In closed form and marched.
TEST(Roulette, KeepsWhatAThickBrightSlabReflects) {
  const double truth = reflected_straight_up(0.999);
  for (const bool marched : {false, true}) {
    const Slab row{0, 0.999f, 100, truth, 0};
    SceneBuilder builder =
        slab(row, SlabView::reflection,
             marched ? Density([](const Point& p) { return p.y * 0.f + 1.f; }) : Density{});
    builder.image(8, 8, marched ? 2 : 16).step(0.02).bounces(1 << 20);
    expect_truth(measure(builder.scene).whole(), truth, 2e-4, 0.02, marched ? "marched" : "closed form");
  }
}

// Nothing is lost in white surroundings, however long it takes.
TEST(Roulette, KeepsTheWhiteFurnaceOfAThickBall) {
  SceneBuilder builder;
  builder.image(8, 8, 16).bounces(1 << 20).orthographic({0, 0, 5}, {0, 0, 0}, 2).environment(1);
  builder.volume(scene::Sphere{{}, 1}, builder.constant({.sigma_t = Rgb(50), .phase = hg(0.5f)}));
  expect_truth(measure(builder.scene).whole(), 1, 1e-5, 0.02, "ball");
}

// Shadow rays through a hundred and more segments, of which the first may be opaque: the mean of e^-tau by
// every estimator, however dark it is.
TEST(Roulette, KeepsTheMeanOfDarkTransmittances) {
  for (const float density : {1.5f, 30.f, 60.f})
    for (const auto& [name, method] : all_transmittances()) {
      if (render::by_ratio(method)) continue;  // takes no segments
      KnownDensity known{"layer",
                         [=](const Point& p) { return p.x * 0.f + density; },
                         scene::Box{{0, -1, -1}, {1, 1, 1}},
                         {-1, 0, 0},
                         {0, 0, 0},
                         density,
                         0};
      const TransmittanceMeasure m = measure_transmittance(known, method, 0.005, 1 << 17);
      EXPECT_NEAR(m.mean, std::exp(-known.tau), 4 * m.standard_error + 1e-6 * m.mean) << density;
      EXPECT_LE(m.standard_error, 0.02 * m.mean) << density;
      EXPECT_LT(m.evaluations, density > 50 ? 150 : 1000) << "nothing was saved";
    }
}

}  // namespace
}  // namespace tyndall
