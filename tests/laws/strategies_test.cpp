// Every way of sampling gives the same picture: strategies, numbers of light samples, and media in three
// spellings.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "support/law_scenes.h"
#include "support/measure.h"
#include "support/scene_builder.h"

namespace tyndall::support {
namespace {

// Coloured fog with a forward phase over a floor, lit by one light; the camera stands inside the fog.
SceneBuilder foggy(const optics::Light& light, int bounces) {
  SceneBuilder b;
  b.image(8, 8, 64).bounces(bounces).perspective({0, 0, 6}, {0, 0, 0}, 35);
  b.volume(scene::Box{{-8, -2, -8}, {8, 8, 8}},
           b.constant({.sigma_t = Rgb(0.4f, 0.3f, 0.2f), .albedo = Rgb(0.8f), .phase = hg(0.6f)}));
  b.surface(scene::Plane{{0, -1, 0}, {0, 1, 0}}, Rgb(0.7f))
      .surface(scene::Sphere{{0.6, -0.4, 1}, 0.4}, Rgb(0.5f));
  b.light(light);
  return b;
}

optics::PointLight point() {
  optics::PointLight l;
  l.position = {-0.5, 0.4, 0.5};
  l.power = Rgb(60);
  return l;
}
optics::PointLight point_above() {
  optics::PointLight l;
  l.position = {-0.5, 16, 0.5};
  l.power = Rgb(20000);
  return l;
}
optics::SphereLight sphere() {
  optics::SphereLight l;
  l.center = {-0.5, 0.4, 0.5};
  l.radius = 0.3;
  l.power = Rgb(60);
  return l;
}
optics::QuadLight quad() {
  optics::QuadLight l;
  l.center = {-0.5, 1.2, 0.5};
  l.u = {0.4, 0, 0};
  l.v = {0.1, 0, 0.4};
  l.power = Rgb(60);
  return l;
}
optics::DistantLight disc() {
  optics::DistantLight l;
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
  const std::pair<const char*, optics::Light> lights[] = {{"point", point()},
                                                          {"point above", point_above()},
                                                          {"sphere", sphere()},
                                                          {"quad", quad()},
                                                          {"disc", disc()}};
  for (const auto& [name, light] : lights)
    for (const int bounces : {0, 2}) {
      const scene::Scene scene = foggy(light, bounces).scene;
      const Estimate mixed = measure(scene).whole();
      for (const render::Distance distance : {render::Distance::mis, render::Distance::density,
                                              render::Distance::equiangular, render::Distance::product}) {
        if (distance == render::Distance::density && std::string_view(name) == "point") continue;
        for (const int light_samples : {1, 4}) {
          scene::Scene other = scene;
          other.settings.light_samples = light_samples;
          other.settings.samples = light_samples == 1 ? 64 : 16;
          render::RenderOptions options;
          options.distance = distance;
          expect_same(measure(other, options).whole(), mixed, 0, 0.05,
                      std::string(name) + ", bounces " + std::to_string(bounces) + ", strategy " +
                          std::to_string(static_cast<int>(distance)) + ", light samples " +
                          std::to_string(light_samples));
        }
      }
    }
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

}  // namespace
}  // namespace tyndall::support
