// Many lights, chosen by the tree: the same picture as the sum of those of few, which are weighed one by one.
#include <gtest/gtest.h>

#include <cmath>

#include "base/numerics.h"
#include "compile/lights/light_tree.h"
#include "support/measure.h"
#include "support/scene_builder.h"
#include "support/ways.h"

namespace tyndall::render {
namespace UNNAMED {

using support::SceneBuilder;

SceneBuilder mist() {
  SceneBuilder builder;
  builder.image(4, 4, 128).perspective({0, 1, 5}, {0, 0.5, 0}, 40).bounces(2);
  support::MediumColors fog;
  fog.sigma_t = Rgb(0.2f);
  fog.albedo = Rgb(0.8f);
  builder.volume(scene::Box{{-3, -1, -3}, {3, 3, 3}}, builder.constant(fog))
      .surface(scene::Plane{{0, -0.5, 0}, {0, 1, 0}}, Rgb(0.6f));
  return builder;
}

Vec3d place(int i) {
  return {-2 + 4 * (i * 0.37 - std::floor(i * 0.37)), 0.3 + 0.1 * i,
          -2 + 4 * (i * 0.71 - std::floor(i * 0.71))};
}

// Lights that cast no shadow on each other.
scene::Light small_light(int i) {
  const Rgb power(static_cast<float>(1 + i % 4));
  if (i % 3 == 0) return scene::PointLight{place(i), power, {}};
  if (i % 3 == 1) return scene::SpotLight{place(i), {0, 0, 0}, {0.4}, 0.3, power, {}};
  return scene::DistantLight{{0.1 * i, -1, 0}, Rgb(0.05f), {}};
}

TEST(ManyLights, AreTheSumOfFew) {
  SceneBuilder all = mist();
  support::Estimate wanted;
  Vec3d variance;
  for (int first = 0; first < 18; first += 6) {
    SceneBuilder part = mist();
    for (int i = first; i < first + 6; ++i) {
      part.light(small_light(i));
      all.light(small_light(i));
    }
    ASSERT_EQ(compile::compile(part.scene).light_tree, nullptr);
    const support::Estimate estimate = support::measure(part.scene).whole();
    for (std::size_t c = 0; c < 3; ++c) {
      wanted.mean[c] += estimate.mean[c];
      variance[c] += sqr(estimate.standard_error[c]);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) wanted.standard_error[c] = std::sqrt(variance[c]);
  ASSERT_NE(compile::compile(all.scene).light_tree, nullptr);
  support::expect_same(support::measure(all.scene).whole(), wanted, 0, 0.03, "the default");
  RenderOptions tracking;
  tracking.method = Method::tracking;
  support::expect_same(support::measure(all.scene, tracking).whole(), wanted, 0, 0.06, "tracking");
}

// Lights that rays hit: whether sampled or hit, each counts once.
TEST(ManyLights, AreTheSameByEveryDistance) {
  SceneBuilder all = mist();
  for (int i = 0; i < 20; ++i) {
    const Rgb power(static_cast<float>(1 + i % 4));
    if (i % 2 == 0)
      all.light(scene::AreaLight{scene::Sphere{place(i), 0.1}, power, {}});
    else
      all.light(scene::AreaLight{scene::Quad{place(i), {0.2, 0, 0}, {0, 0, 0.2}}, power, {}});
  }
  RenderOptions density;
  density.distance = Distance::density;
  const support::Estimate wanted = support::measure(all.scene, density).whole();
  for (const auto& [name, distance] : support::all_distances()) {
    if (distance == density.distance) continue;
    RenderOptions options;
    options.distance = distance;
    support::expect_same(support::measure(all.scene, options).whole(), wanted, 0, 0.05, name);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
