// `multiple_scattering: approximate`: what it must leave alone, and what its orders are.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "support/law_scenes.h"
#include "support/measure.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

// Lumpy fog that overlaps an even one, above a floor, under lights of several kinds.
scene::Scene overlapping_fog(float albedo) {
  SceneBuilder b;
  b.image(8, 8, 16).step(0.1).bounces(1000).perspective({0, 0.3, 5}, {0, 0, 0}, 40);
  const Density lumps = [](const Point& p) {
    return max(cos(p.x * 5.f) * cos(p.y * 4.f) * cos(p.z * 6.f) + 0.3f, 0);
  };
  b.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, b.shader({Rgb(5, 4, 3), Rgb(albedo), {}, hg(0.6f)}, lumps))
      .volume(scene::Sphere{{0.4, 0.2, 0}, 1}, b.constant({Rgb(0.7f), Rgb(0.8f * albedo), {}, hg(-0.3f)}))
      .point_light({2, 2, 1}, Rgb(15))
      .sphere_light({-1.5, 1.5, 1}, 0.3, Rgb(60))
      .environment(0.3f);
  return b.scene;
}

scene::ApproximateScattering approximation(int real, int orders) {
  scene::ApproximateScattering a;
  a.real = real;
  a.orders = orders;
  return a;
}

Estimate measured(scene::Scene scene, const scene::ApproximateScattering& a, const Way& way = ways()[0]) {
  scene.settings.multiple_scattering.approximate = a;
  if (way.method == render::Method::brute_force) scene.settings.samples /= 4;
  return measure(scene, way.options()).whole();
}

TEST(ApproximateScattering, OfNoOrdersFollowsSoManyBounces) {
  scene::Scene scene = overlapping_fog(0.95f);
  for (const int real : {0, 2}) {
    const Estimate approximate = measured(scene, approximation(real, 0));
    scene.settings.bounces = real;
    expect_same(approximate, measure(scene).whole(), 0, 0.02, "real " + std::to_string(real));
    scene.settings.bounces = 1000;
  }
}

TEST(ApproximateScattering, AfterAllScatteringsIsTheFullSolution) {
  const scene::Scene scene = overlapping_fog(0.9f);
  expect_same(measured(scene, approximation(1000, 8)), measure(scene).whole(), 0, 0.02, "real 1000");
}

TEST(ApproximateScattering, WithoutContributionIsNone) {
  const scene::Scene scene = overlapping_fog(0.95f);
  scene::ApproximateScattering none = approximation(1, 8);
  none.contribution = 0;
  expect_same(measured(scene, none), measured(scene, approximation(1, 0)), 0, 0.02, "contribution 0");
}

TEST(ApproximateScattering, LeavesWhatDoesNotScatter) {
  SceneBuilder b;
  b.image(8, 8, 4).step(0.1).perspective({0, 0.3, 5}, {0, 0, 0}, 40).environment(0.3f);
  b.volume(scene::Sphere{{}, 1}, b.constant({.sigma_t = Rgb(2), .albedo = Rgb(0)}))
      .surface(scene::Plane{{0, -1.1, 0}, {0, 1, 0}}, Rgb(0.6f))
      .sphere_light({-1.5, 1.5, 1}, 0.3, Rgb(60));
  const Measurement full = measure(b.scene);
  b.scene.settings.multiple_scattering.approximate = approximation(0, 8);
  const Measurement approximate = measure(b.scene);
  for (int i = 0; i < seed_count; ++i)
    EXPECT_EQ(approximate.films[i].image().pixels, full.films[i].image().pixels);
}

// Homogeneous fog about a point light, scattered once: order k is the integral of sigma_s T(t) (b albedo)^k
// p_k T(r)^(a^k) / r² over the ray, here by the midpoint rule.
TEST(ApproximateScattering, OrdersAreSingleScatteringInThinnerFog) {
  const Airlight row{0.8, 1, 2, 4, {}};
  constexpr double g = 0.6, albedo = 0.7;
  scene::ApproximateScattering a = approximation(0, 3);
  a.extinction = 0.4, a.contribution = 0.6, a.anisotropy = 0.3;
  double truth = 0;
  constexpr int points = 20000;
  for (int i = 0; i < points; ++i) {
    const double dt = row.T / points, t = (i + 0.5) * dt, r = std::hypot(row.D, row.zl - t);
    const double one_minus_cos = 1 - (row.zl - t) / r;  // light travels from the lamp, the ray towards it
    for (int k = 0; k <= a.orders; ++k)
      truth += dt * albedo * row.sigma_t * std::exp(-row.sigma_t * (t + r * std::pow(a.extinction, k))) *
               std::pow(a.contribution * albedo, k) *
               optics::hg_eval(static_cast<float>(g * std::pow(a.anisotropy, k)),
                               static_cast<float>(one_minus_cos)) /
               (r * r);
  }
  for (const Way& way : ways()) {
    SceneBuilder builder;
    look_along_z(builder);
    builder.image(16, 16, 16)
        .step(0.1)
        .volume(scene::Box{{-40, -40, -40}, {40, 40, 40}},
                builder.constant({Rgb(static_cast<float>(row.sigma_t)),
                                  Rgb(static_cast<float>(albedo)),
                                  {},
                                  hg(static_cast<float>(g))}))
        .surface(scene::Plane{{0, 0, row.T}, {0, 0, -1}}, Rgb(0))
        .point_light({row.D, 0, row.zl}, Rgb(1));
    expect_truth(measured(builder.scene, a, way), truth, 1e-6 * truth, 0.01, way.name);
  }
}

TEST(ApproximateScattering, IsOnePictureByEveryMethod) {
  const scene::Scene scene = overlapping_fog(0.95f);
  const Estimate truth = measured(scene, approximation(1, 4));
  for (const Way& way : ways())
    expect_same(measured(scene, approximation(1, 4), way), truth, way.unbiased ? 0.005 * truth.mean.y : 0.002,
                0.04, way.name);
}

}  // namespace UNNAMED
}  // namespace tyndall
