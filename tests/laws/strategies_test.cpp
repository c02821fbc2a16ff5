// Every way of sampling gives the same picture: strategies, numbers of light samples, and media in three
// spellings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "support/law_scenes.h"
#include "support/measure.h"
#include "support/scene_builder.h"
#include "support/scene_text.h"
#include "support/ways.h"

namespace tyndall::support {
namespace UNNAMED {

// Coloured fog with a forward phase over a floor, lit by one light; the camera stands inside the fog.
SceneBuilder foggy(const scene::Light& light, int bounces, bool varies) {
  SceneBuilder b;
  b.image(8, 8, bounces > 0 ? 128 : 64).bounces(bounces).step(0.4).perspective({0, 0, 6}, {0, 0, 0}, 35);
  const MediumColors colors{.sigma_t = Rgb(0.4f, 0.3f, 0.2f), .albedo = Rgb(0.8f), .phase = hg(0.6f)};
  b.volume(
      scene::Box{{-8, -2, -8}, {8, 8, 8}},
      varies ? b.shader(colors, [](const Point& p) { return p.x * p.x * 0.3f + 0.2f; }) : b.constant(colors));
  b.surface(scene::Plane{{0, -1, 0}, {0, 1, 0}}, Rgb(0.7f))
      .surface(scene::Sphere{{0.6, -0.4, 1}, 0.4}, Rgb(0.5f));
  b.light(light);
  return b;
}

scene::PointLight point() {
  scene::PointLight l;
  l.position = {-0.5, 0.4, 0.5};
  l.power = Rgb(60);
  return l;
}
scene::PointLight point_above() {
  scene::PointLight l;
  l.position = {-0.5, 16, 0.5};
  l.power = Rgb(20000);
  return l;
}
scene::AreaLight sphere() { return {scene::Sphere{{-0.5, 0.4, 0.5}, 0.3}, Rgb(60), {}}; }
scene::AreaLight quad() { return {scene::Quad{{-0.5, 1.2, 0.5}, {0.4, 0, 0}, {0.1, 0, 0.4}}, Rgb(60), {}}; }
scene::AreaLight cylinder() {
  return {scene::Cylinder{{-0.7, 0.4, 0.5}, {-0.2, 0.6, 0.5}, 0.15}, Rgb(60), {}};
}
scene::DistantLight disc() {
  scene::DistantLight l;
  l.direction = {0.3, -1, -0.4};
  l.irradiance = Rgb(3);
  l.angle.radians = 0.3;
  return l;
}

// Density, equi-angular and mixed sampling, with one light sample and with four, have one mean: each against
// the mixture with one sample, to 4 standard errors. Around a point light within the medium the square of
// what density sampling gathers has no finite integral (1/d^4 over a volume), so it has no standard error to
// be judged by: it is compared with the light above the fog.
TEST(Strategies, Agree) {
  const std::pair<const char*, scene::Light> lights[] = {
      {"point", point()}, {"point above", point_above()}, {"sphere", sphere()},
      {"quad", quad()},   {"cylinder", cylinder()},       {"disc", disc()}};
  for (const auto& [name, light] : lights)
    for (const auto& [bounces, varies] : {std::pair{0, false}, {2, false}, {0, true}}) {
      const scene::Scene scene = foggy(light, bounces, varies).scene;
      const Estimate mixed = measure(scene).whole();
      for (const auto& [strategy, distance] : all_distances()) {
        if (distance == render::Distance::density && std::string_view(name) == "point") continue;
        for (const int light_samples : {1, 4}) {
          scene::Scene other = scene;
          other.settings.light_samples = light_samples;
          other.settings.samples = scene.settings.samples / light_samples;
          render::RenderOptions options;
          options.distance = distance;
          expect_same(measure(other, options).whole(), mixed, 0, 0.05,
                      fmt::format("{}, bounces {}, {} fog, strategy {}, light samples {}", name, bounces,
                                  varies ? "varying" : "even", strategy, light_samples));
        }
      }
    }
}

scene::Scene fog_of(const std::string& medium, bool fold) {
  resolve::Options options;
  options.shader.fold = fold;
  return scene_of(medium + R"(
render { resolution: (8, 8)  samples: 64  step: 0.1  bounces: 3 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 35deg }
volume { in: sphere { radius: 1 }  medium: fog }
light sphere { center: (2, 2, 2)  radius: 0.5  radiance: 100 }
light environment { radiance: 0.2 }
)",
                  options);
}

// One medium written as a constant, as a shader that folds to it, and as one that is computed at every point
// with folding off: one picture.
TEST(OneMedium, ThreeWaysOfWritingItOnePicture) {
  const auto computed = [](const std::string& half) {
    return fmt::format(R"(
medium fog() {{
  let half = smoothstep(0, 1, {})
  var sum = 0
  for i in 1..4 {{ sum = sum + i * half }}
  density = if sum > 4 then sum / 5 else sqrt(-1)
  albedo = mix((1, 1, 1), (0.8, 0.6, 0.4), half)
  extinction = (2, 1.5, 1)
  phase = hg(0.4)
}}
)",
                       half);
  };
  const scene::Scene written = fog_of(R"(
medium fog() { density = 1  albedo = (0.9, 0.8, 0.7)  extinction = (2, 1.5, 1)  phase = hg(0.4) }
)",
                                      true),
                     folded = fog_of(computed("0.5"), true), kept = fog_of(computed("0.5 + 0 * p.x"), false);
  EXPECT_TRUE(folded.media[0].full.lane_code.empty());
  EXPECT_FALSE(kept.media[0].full.lane_code.empty());
  const auto a = measure(written).whole(), b = measure(folded).whole();
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(b.mean[c], a.mean[c], 1e-5 * a.mean[c]) << c;
  expect_same(measure(kept).whole(), a, 0, 0.01, "computed at every point");
}

// One medium in closed form and the same as a shader that is marched: one picture (invariant 3).
TEST(OneMedium, TwoSpellingsOnePicture) {
  const auto lit = [](bool marched) {
    SceneBuilder b;
    b.image(8, 8, 64).step(0.1).bounces(3).perspective({0, 0, 5}, {0, 0, 0}, 35);
    const MediumColors colors{Rgb(2, 1.5f, 1), Rgb(0.9f, 0.8f, 0.7f), {}, hg(0.4f)};
    const scene::MediumId medium =
        marched ? b.shader(colors, [](const Point& p) { return p.x * 0.0f + 1.0f; }) : b.constant(colors);
    b.volume(scene::Sphere{{0, 0, 0}, 1}, medium).sphere_light({2, 2, 2}, 0.5, Rgb(100)).environment(0.2f);
    return measure(b.scene).whole();
  };
  expect_same(lit(true), lit(false), 0, 0.01, "marched against closed form");
}

}  // namespace UNNAMED
}  // namespace tyndall::support
