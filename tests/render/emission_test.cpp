// Media that emit, sampled as lights: the field that directions are drawn from, and that pictures stay what
// they are. Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "base/sampler.h"
#include "render/lights/emission_grid.h"
#include "support/measure.h"
#include "support/scene_builder.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

const Density blob = [](const Point& p) { return max(1.f - length(p) * 2.f, 0); };

// A small fire and some smoke in a room, all of whose light is the fire's.
SceneBuilder fire_in_a_room() {
  SceneBuilder b;
  b.image(8, 8, 16).step(0.08).bounces(4).perspective({0, 0.3, 2.5}, {0, 0, 0}, 50);
  const MediumColors fire{Rgb(3), Rgb(0.3f), Rgb(30, 15, 4)}, smoke{Rgb(0.3f), Rgb(0.9f), {}, hg(0.5f)};
  b.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, b.shader(fire, blob), Transform::translate({0.3, 0.2, 0}))
      .volume(scene::Box{{-2, -1, -2}, {2, 2, 2}}, b.constant(smoke))
      .surface(scene::Plane{{0, -0.8, 0}, {0, 1, 0}}, Rgb(0.6f, 0.5f, 0.4f))
      .surface(scene::Plane{{0, 0, -1.5}, {0, 0, 1}}, Rgb(0.8f))
      .surface(scene::Sphere{{-0.6, -0.4, 0.3}, 0.3}, Rgb(0.9f));
  return b;
}

TEST(EmissionGrids, DensityIsThatOfItsDirections) {
  SceneBuilder b = fire_in_a_room();
  b.volume(scene::Sphere{{-1, 1, 0.5}, 0.2}, b.constant({Rgb(1), Rgb(0), Rgb(20)}));  // a second one
  const compile::CompiledScene world = compile::compile(b.scene);
  const auto field = render::EmissionGrids::of(world);
  ASSERT_TRUE(field);
  const Sampler random(1, 0, 0, 0, 0);
  for (const Vec3d& in_world : {Vec3d{3, 1, 2}, Vec3d{0.3, 0.2, 0}, Vec3d{0, -0.8, 0.1}}) {
    const Vec3d x = in_world - world.origin;
    auto number = [&, k = 0]() mutable { return random.independent(7, k++); };
    // 1/pdf of drawn directions is the solid angle in which they can be; 4 pi when seen from within.
    double whole = 0, drawn = 0, first = 0, second = 0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
      const double z = 2.0 * number() - 1, phi = 2 * pi * number(), r = std::sqrt(1 - z * z);
      const double pdf = field->pdf(x, {r * std::cos(phi), r * std::sin(phi), z});
      whole += pdf * 4 * pi / count;
      first += pdf * 4 * pi * z / count;
    }
    for (int i = 0; i < count; ++i) {
      const auto d = field->sample(x, number(), number(), number(), number());
      if (!d) continue;
      EXPECT_NEAR(length(d->direction), 1, 1e-12);
      drawn += 1.0 / count;
      second += d->direction.z / count;
    }
    EXPECT_NEAR(whole, 1, 0.05) << in_world.x;
    EXPECT_NEAR(drawn, 1, 1e-3) << in_world.x;
    EXPECT_NEAR(second, first, 0.05) << in_world.x;
  }
}

TEST(EmissionGrids, IsNoneWithoutLight) {
  SceneBuilder b;
  b.volume(scene::Sphere{{}, 1}, b.constant({Rgb(1), Rgb(0.5f)})).environment(1);
  EXPECT_FALSE(render::EmissionGrids::of(compile::compile(b.scene)));
}

// A small fire in a huge box of dark medium is found.
TEST(EmissionGrids, FindsASmallFire) {
  SceneBuilder b;
  const Density spark = [](const Point& p) { return max(1.f - length(p), 0); };
  b.volume(scene::Box{{-20, -20, -20}, {20, 20, 20}}, b.shader({Rgb(1), Rgb(0), Rgb(20)}, spark));
  const compile::CompiledScene world = compile::compile(b.scene);
  const auto field = render::EmissionGrids::of(world);
  ASSERT_TRUE(field);
  const Vec3d x = Vec3d{10, 0, 0} - world.origin;
  EXPECT_GT(field->pdf(x, {-1, 0, 0}), 10);  // the ball's solid angle is 0.03
  EXPECT_EQ(field->pdf(x, normalize(Vec3d{-1, 0.3, 0})), 0);
}

TEST(SampledEmission, IsThePictureWithoutIt) {
  for (const int light_samples : {1, 3}) {
    scene::Scene scene = fire_in_a_room().scene;
    scene.settings.light_samples = light_samples;
    render::RenderOptions without;
    without.emission_sampling = false;
    scene::Scene longer = scene;
    longer.settings.samples *= 4;
    expect_same(measure(scene).whole(), measure(longer, without).whole(), 0, 0.03, "sampled against met");
  }
}

TEST(SampledEmission, IsOnePictureByEveryMethod) {
  const SceneBuilder b = fire_in_a_room();
  const Estimate truth = measure_reference(b.scene, 3.4, 1 << 12);
  for (const Way& way : ways()) {
    scene::Scene scene = b.scene;
    if (way.method == render::Method::tracking) scene.settings.samples *= 8;
    // A step of 0.08 in a fire of slope 6/m: at most (0.5)²/8 of the light that passes through all of it.
    const double allowance = way.unbiased ? 0 : 0.005 * truth.mean.y;
    expect_same(measure(scene, way.options()).whole(), truth, allowance, 0.05, way.name);
  }
}

// Everything shines as a black body of radiance 1: emission is absorption, what surfaces do not reflect they
// emit.
TEST(SampledEmission, KeepsTheFurnace) {
  SceneBuilder b;
  b.image(8, 8, 16).step(0.1).perspective({0.2, 0.1, 0.3}, {1, 0, 0}, 70).environment(1);
  const MediumColors hot{Rgb(4), Rgb(0.6f), Rgb(4 * 0.4f), hg(0.3f)};
  b.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, b.shader(hot, blob))
      .volume(scene::Sphere{{0.5, 0, 0}, 1}, b.constant({Rgb(1), Rgb(0.5f), Rgb(0.5f)}))
      .surface(scene::Sphere{{1, 0.1, 0.2}, 0.3}, Rgb(0.7f), Rgb(0.3f));
  expect_truth(measure(b.scene).whole(), 1, 1e-3, 0.01, "furnace");
}

// Fire seen through a surface that lets a half of the light through, and lit by it.
TEST(SampledEmission, PassesSurfacesThatLetThrough) {
  SceneBuilder b = fire_in_a_room();
  scene::ConstantSurface gauze;
  gauze.parameters.base_color = Rgb(0.5f);
  gauze.opacity = 0.5f;
  b.surface(scene::Quad{{0.3, -0.4, 0}, {1, 0, 0}, {0, 0, 1}}, gauze);
  render::RenderOptions without;
  without.emission_sampling = false;
  scene::Scene longer = b.scene;
  longer.settings.samples *= 4;
  expect_same(measure(b.scene).whole(), measure(longer, without).whole(), 0, 0.03, "through gauze");
}

}  // namespace
}  // namespace tyndall
