// The reference against the published truths, and the march against the reference.
// The reference's errors are those of its independent samples: 4 of them, two-sided significance 6e-5;
// seed 1.
#include <gtest/gtest.h>

#include "support/law_scenes.h"
#include "support/measure.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

TEST(Reference, Airlight) {
  for (const support::Airlight& row : airlight_rows)
    for (std::size_t i = 0; i < 3; ++i) {
      SceneBuilder builder = airlight(row, airlight_g[i]);
      builder.image(16, 16, 1);
      expect_truth(measure_reference(builder.scene, 1.001 * row.sigma_t, 2000), row.radiance[i],
                   1e-8 * row.radiance[i], 0.02,
                   "sigma_t " + std::to_string(row.sigma_t) + " g " + std::to_string(airlight_g[i]));
    }
}

TEST(Reference, Slabs) {
  for (const Slab& row : slab_rows)
    for (const SlabView view : {SlabView::reflection, SlabView::transmission}) {
      SceneBuilder builder = slab(row, view);
      builder.image(16, 16, 1);
      expect_truth(measure_reference(builder.scene, 1.001 * row.tau, 500),
                   view == SlabView::reflection ? row.R : row.T, 5e-6, 0.02, describe(row, view));
    }
}

TEST(Reference, KnownDensities) {
  for (const KnownDensity& known : known_densities()) {
    SceneBuilder builder = known_density(known);
    builder.image(16, 16, 1);
    expect_truth(measure_reference(builder.scene, 4, 500), std::exp(-known.tau), 1e-8, 0.02, known.name);
  }
}

TEST(Reference, SphereInWhiteEnvironment) {
  for (const WhiteSphere& row : white_sphere_rows)
    expect_truth(measure_reference(white_sphere(row).scene, 1.001 * row.tau, 500), white_sphere_square(row),
                 5e-6, 0.01, "tau " + std::to_string(row.tau) + " c " + std::to_string(row.albedo));
}

TEST(Reference, DistantLightOnASlab) {
  const Slab row{0, 0.9f, 1, 0.03096352, 0.02634742};
  for (const SlabView view : {SlabView::reflection, SlabView::transmission}) {
    SceneBuilder builder = slab(row, view);
    builder.scene.lights.clear();
    builder.image(16, 16, 1).bounces(0).distant_light({0, -1, 0}, Rgb(1));
    expect_truth(measure_reference(builder.scene, 1.001, 1000), view == SlabView::reflection ? row.R : row.T,
                 1e-8, 0.02, describe(row, view));
  }
}

// Emission with σa = 1: 1 - 1/e; growing with distance: 1 - 2/e.
TEST(Reference, Emission) {
  for (const bool growing : {false, true}) {
    SceneBuilder builder;
    builder.image(16, 16, 1).orthographic({-1, 0, 0}, {0, 0, 0}, 1e-6);
    MediumColors absorbing, glowing;
    absorbing.albedo = glowing.albedo = Rgb(0);
    glowing.sigma_t = Rgb(0);
    glowing.emission = Rgb(1);
    const scene::Box box{{0, -1, -1}, {1, 1, 1}};
    builder.volume(box, builder.constant(absorbing))
        .volume(box, growing ? builder.shader(glowing, [](const Point& p) { return p.x; })
                             : builder.constant(glowing));
    expect_truth(measure_reference(builder.scene, 1.5, 1000), 1 - (growing ? 2 : 1) * std::exp(-1), 1e-8,
                 0.02, "emission");
  }
}

// White surroundings stay white through colours of extinction, overlap and a reflector.
TEST(Reference, WhiteFurnace) {
  SceneBuilder builder;
  builder.image(16, 16, 1).perspective({0, 0, 4}, {0, 0, 0}, 40).environment(1);
  MediumColors chromatic, forward;
  chromatic.sigma_t = Rgb(0.5f, 1, 2);
  forward.phase = hg(0.8f);
  builder.volume(scene::Sphere{{}, 1}, builder.constant(chromatic))
      .volume(scene::Sphere{{0.3, 0, 0}, 1},
              builder.shader(forward, [](const Point& p) { return cos(p.x * 5.f) + 1.f; }))
      .surface(scene::Sphere{{0, 0, 0}, 0.4}, Rgb(1));
  expect_truth(measure_reference(builder.scene, 4, 400), 1, 0, 0.005, "white");
}

// Smoke with colours, a floor, two kinds of lights, and an environment.
SceneBuilder smoky_room(double step) {
  SceneBuilder builder;
  builder.image(16, 16, 32).bounces(3).step(step).perspective({0, 1, 4}, {0, 0.2, 0}, 45);
  MediumColors ball, fog;
  ball.sigma_t = Rgb(1, 1.5f, 2);
  ball.albedo = Rgb(0.9f, 0.8f, 0.6f);
  ball.phase = hg(0.5f);
  fog.sigma_t = Rgb(0.05f);
  const Density lumps = [](const Point& p) { return cos(p.x * 3.f) * cos(p.y * 3.f) + 1.f; };
  builder.surface(scene::Plane{{0, -1.1, 0}, {0, 1, 0}}, Rgb(0.6f, 0.5f, 0.4f))
      .volume(scene::Sphere{{}, 1}, builder.shader(ball, lumps))
      .volume(scene::Box{{-6, -2, -6}, {6, 6, 6}}, builder.constant(fog))
      .sphere_light({2, 3, 1}, 0.3, Rgb(100, 80, 60))
      .quad_light({-2, 2.5, 0}, {0.5, 0, 0}, {0, 0, 0.5}, Rgb(40))
      .environment(0.1f);
  return builder;
}

// The bound, stated before. The ball's extinction changes by at most 6 per metre squared, so over a chord of
// 2 m its total variation is at most 12, and an optical depth moves within a range of 12 Δ: by Hoeffding's
// lemma a transmittance is too large by at most exp((12 Δ)²/8) - 1 of itself. A path of 4 vertices has at
// most 8 of them.
double bias_bound(double step) { return std::expm1(8 * std::pow(12 * step, 2) / 8); }

TEST(MarchAgainstReference, WithinABoundThatFallsWithTheStep) {
  const Estimate reference = measure_reference(smoky_room(1).scene, 4.1, 2000);
  for (const double step : {0.05, 0.025, 0.0125}) {
    const Estimate march = measure(smoky_room(step).scene).whole();
    // 0.43, 0.094, 0.023 of the value.
    expect_same(march, reference, bias_bound(step) * reference.mean.x, 0.01, "step " + std::to_string(step));
  }
}

// Homogeneous media have closed forms: no bias at all is allowed.
TEST(MarchAgainstReference, ExactWhereHomogeneous) {
  SceneBuilder builder = smoky_room(1);
  MediumColors ball;
  ball.sigma_t = Rgb(0.5f, 1.5f, 4);
  ball.albedo = Rgb(0.99f, 0.8f, 0.6f);
  ball.phase = hg(-0.3f);
  builder.scene.volumes[0].medium = builder.constant(ball);
  const Estimate reference = measure_reference(builder.scene, 4.1, 2000);
  expect_same(measure(builder.scene).whole(), reference, 0, 0.01, "homogeneous");
}

}  // namespace
}  // namespace tyndall
