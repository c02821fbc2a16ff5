// White surroundings: what does not absorb cannot be seen, and an absorbing ball is as dark as published.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "support/law_scenes.h"
#include "support/measure.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

// A row of docs/verification.md through the march: step chosen so that the bias bound (step · variation)²/8
// of each path is nothing, as the density is constant; only the shader path differs.
TEST(SphereInWhiteEnvironment, PublishedRowThroughAShader) {
  const WhiteSphere row = white_sphere_rows[7];
  SceneBuilder builder = white_sphere(row);
  builder.image(32, 32, 16).step(0.1);
  MediumColors ball;
  ball.sigma_t = Rgb(static_cast<float>(row.tau));
  ball.albedo = Rgb(static_cast<float>(row.albedo));
  builder.scene.volumes.clear();
  builder.volume(scene::Sphere{{}, 1}, builder.shader(ball, [](const Point& p) { return p.x.like(1); }));
  expect_truth(measure(builder.scene).whole(), white_sphere_square(row), 5e-6, 0.005, "shader");
}

// Every block of 8×8 pixels is 1 to 4 standard errors. Free paths, pass-through and shadow transmittance
// come from marches of one expectation, so it holds at any step.
void expect_white(const SceneBuilder& builder, double power, const std::string& what) {
  const Measurement measurement = measure(builder.scene);
  for (int y = 0; y + 8 <= measurement.height; y += 8)
    for (int x = 0; x + 8 <= measurement.width; x += 8)
      expect_truth(measurement.region(x, y, x + 8, y + 8), 1, 1e-6, power,
                   what + ", block " + std::to_string(x) + "," + std::to_string(y));
}

SceneBuilder furnace() {
  SceneBuilder builder;
  builder.image(24, 24, 64).step(0.2).perspective({0, 0, 4}, {0, 0, 0}, 40).environment(1);
  return builder;
}

MediumColors white(float sigma_t, float g) {
  MediumColors colors;
  colors.sigma_t = Rgb(sigma_t);
  colors.phase = g == 0 ? isotropic() : hg(g);
  return colors;
}

TEST(WhiteFurnace, Homogeneous) {
  for (const float sigma_t : {0.3f, 3.f}) {
    SceneBuilder builder = furnace();
    builder.volume(scene::Sphere{{}, 1}, builder.constant(white(sigma_t, 0)));
    expect_white(builder, 0.01, "sigma_t " + std::to_string(sigma_t));
  }
}

TEST(WhiteFurnace, HenyeyGreenstein) {
  for (const float g : {0.85f, -0.6f}) {
    SceneBuilder builder = furnace();
    builder.volume(scene::Sphere{{}, 1}, builder.constant(white(3, g)));
    expect_white(builder, 0.01, "g " + std::to_string(g));
  }
}

// At the middles of their parameters' ranges.
TEST(WhiteFurnace, EveryPhaseFunction) {
  for (const optics::PhaseInfo& function : optics::phase_functions()) {
    MediumColors colors = white(3, 0);
    colors.phase.kind = function.kind;
    for (std::size_t k = 0; k < function.parameters.size(); ++k)
      colors.phase.parameters[k].value =
          static_cast<float>((function.parameters[k].lowest + function.parameters[k].highest) / 2);
    SceneBuilder builder = furnace();
    builder.volume(scene::Sphere{{}, 1}, builder.constant(colors));
    expect_white(builder, 0.01, std::string(function.keyword));
  }
}

const Density lumpy = [](const Point& p) {
  return max(cos(p.x * 5.f) * cos(p.y * 4.f) * cos(p.z * 6.f) + 0.3f, 0);
};

TEST(WhiteFurnace, Heterogeneous) {
  for (const double step : {0.2, 0.05}) {
    SceneBuilder builder = furnace();
    builder.step(step).volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, builder.shader(white(8, 0.5f), lumpy));
    expect_white(builder, 0.01, "step " + std::to_string(step));
  }
}

TEST(WhiteFurnace, OverlappingVolumesAndACameraInside) {
  SceneBuilder builder = furnace();
  builder.perspective({0.2, 0.1, 0.3}, {1, 0, 0}, 70)
      .volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, builder.shader(white(4, 0.3f), lumpy))
      .volume(scene::Sphere{{0.5, 0, 0}, 1}, builder.constant(white(1, -0.4f)),
              Transform::rotate({1, 2, 3}, 0.7) * Transform::scale({1, 0.5, 1.5}));
  expect_white(builder, 0.01, "overlap");
}

// Colours of extinction, all of albedo 1: each channel is white.
TEST(WhiteFurnace, ChromaticExtinction) {
  SceneBuilder builder = furnace();
  MediumColors colors = white(1, 0);
  colors.sigma_t = Rgb(0.5f, 1, 2);
  builder.volume(scene::Sphere{{}, 1}, builder.constant(colors));
  expect_white(builder, 0.02, "chromatic");
}

// Dense enough that paths are long and roulette, where it acts, must not change the mean. With a perfect
// reflector inside.
TEST(WhiteFurnace, DenseWithASurfaceInside) {
  SceneBuilder builder = furnace();
  builder.volume(scene::Sphere{{}, 1}, builder.constant(white(20, 0)))
      .surface(scene::Sphere{{0, 0, 0}, 0.8}, Rgb(1))
      .surface(scene::Box{{-1.2, -1.4, -1}, {1.2, -1.1, 1}}, Rgb(1));
  expect_white(builder, 0.01, "dense");
}

// A closed box whose walls reflect ρ and emit 1 - ρ, with a medium that only scatters: radiance 1 everywhere.
TEST(LambertianBox, IsWhiteInside) {
  for (const float rho : {0.5f, 0.8f})
    for (const bool marched : {false, true}) {
      SceneBuilder builder;
      builder.image(24, 24, 32).step(0.2).perspective({0.2, -0.3, 0.4}, {1, 0.5, -1}, 60);
      builder.surface(scene::Box{{-1, -1, -1}, {1, 1, 1}}, Rgb(rho), Rgb(1 - rho));
      const MediumColors colors = white(marched ? 4.f : 1.f, 0.4f);
      builder.volume(scene::Box{{-2, -2, -2}, {2, 2, 2}},
                     marched ? builder.shader(colors, lumpy) : builder.constant(colors));
      expect_white(builder, 0.01, "rho " + std::to_string(rho) + (marched ? " marched" : ""));
    }
}

}  // namespace UNNAMED
}  // namespace tyndall
