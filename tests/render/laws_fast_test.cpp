// A minute's worth of the laws: one row of each kind. The whole set is in tests/laws.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "support/law_scenes.h"
#include "support/measure.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

TEST(FastLaws, Airlight) {
  SceneBuilder builder = airlight(airlight_rows[0], airlight_g[1]);
  builder.image(16, 16, 4);
  expect_truth(measure(builder.scene).whole(), airlight_rows[0].radiance[1], 1e-9, 0.01, "airlight");
}

TEST(FastLaws, Slab) {
  for (const SlabView view : {SlabView::reflection, SlabView::transmission}) {
    const Slab& row = slab_rows[8];
    SceneBuilder builder = slab(row, view);
    builder.image(16, 16, 8);
    expect_truth(measure(builder.scene).whole(), view == SlabView::reflection ? row.R : row.T, 5e-6, 0.03,
                 describe(row, view));
  }
}

TEST(FastLaws, SphereInWhiteEnvironment) {
  const WhiteSphere& row = white_sphere_rows[7];
  SceneBuilder builder = white_sphere(row);
  builder.image(16, 16, 16);
  expect_truth(measure(builder.scene).whole(), white_sphere_square(row), 5e-6, 0.01, "sphere");
}

TEST(FastLaws, OpticalDepth) {
  for (const KnownDensity& known : known_densities()) {
    SceneBuilder builder = known_density(known);
    builder.image(16, 16, 1).step(0.01);
    const double truth = std::exp(-known.tau);
    const double bias = std::expm1(std::pow(0.01 * known.total_variation, 2) / 8);
    expect_truth(measure(builder.scene).whole(), truth, (bias + 1e-6) * truth, 0.01, known.name);
  }
}

TEST(FastLaws, WhiteFurnace) {
  SceneBuilder builder;
  builder.image(16, 16, 16).step(0.2).perspective({0.2, 0.1, 0.3}, {1, 0, 0}, 70).environment(1);
  MediumColors colors;
  colors.sigma_t = Rgb(4);
  colors.phase = hg(0.3f);
  builder
      .volume(scene::Box{{-1, -1, -1}, {1, 1, 1}},
              builder.shader(colors,
                             [](const Point& p) { return max(cos(p.x * 5.f) * cos(p.y * 4.f) + 0.3f, 0); }))
      .volume(scene::Sphere{{0.5, 0, 0}, 1}, builder.constant(colors));
  expect_truth(measure(builder.scene).whole(), 1, 1e-6, 0.01, "white");
}

TEST(FastLaws, MarchAgainstReference) {
  SceneBuilder builder;
  builder.image(8, 8, 32).bounces(3).perspective({0, 1, 4}, {0, 0.2, 0}, 45);
  MediumColors ball;
  ball.sigma_t = Rgb(0.5f, 1.5f, 4);
  ball.albedo = Rgb(0.99f, 0.8f, 0.6f);
  ball.phase = hg(0.5f);
  builder.surface(scene::Plane{{0, -1.1, 0}, {0, 1, 0}}, Rgb(0.6f, 0.5f, 0.4f))
      .volume(scene::Sphere{{}, 1}, builder.constant(ball))
      .sphere_light({2, 3, 1}, 0.3, Rgb(100, 80, 60))
      .quad_light({-2, 2.5, 0}, {0.5, 0, 0}, {0, 0, 0.5}, Rgb(40))
      .environment(0.1f);
  expect_same(measure(builder.scene).whole(), measure_reference(builder.scene, 4.1, 1000), 0, 0.02, "room");
}

}  // namespace
}  // namespace tyndall
