// Lights of any shape, and shapes that glow: the same light whichever way it is found.
#include <gtest/gtest.h>

#include "support/found_by_chance.h"
#include "support/measure.h"
#include "support/scene_builder.h"
#include "support/ways.h"

namespace tyndall::render {
namespace UNNAMED {

using support::SceneBuilder;

SceneBuilder fog_and_floor() {
  SceneBuilder builder;
  builder.image(4, 4, 64).perspective({0, 1, 5}, {0, 0.5, 0}, 40).bounces(2);
  support::MediumColors fog;
  fog.sigma_t = Rgb(0.3f);
  fog.albedo = Rgb(0.8f);
  builder.volume(scene::Box{{-3, -1, -3}, {3, 3, 3}}, builder.constant(fog))
      .surface(scene::Plane{{0, -0.5, 0}, {0, 1, 0}}, Rgb(0.6f));
  return builder;
}

// A roof of two slopes, which hides a part of itself from some points.
scene::Mesh add_roof(scene::Scene& scene) {
  scene::TriangleMesh mesh;
  mesh.points = {{-0.5, 1, -0.5}, {-0.5, 1, 0.5}, {0, 1.6, -0.5},
                 {0, 1.6, 0.5},   {0.5, 1, -0.5}, {0.5, 1, 0.5}};
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
  scene.meshes.push_back(mesh);
  return scene::Mesh{scene::MeshId(scene.meshes.size() - 1)};
}

TEST(MeshLights, ShineAsTheQuadThatTheyAre) {
  SceneBuilder a = fog_and_floor(), b = fog_and_floor();
  a.quad_light({0.3, 1.5, 0}, {0.5, 0, 0.1}, {0, 0, 0.5}, Rgb(20));
  scene::TriangleMesh mesh;
  mesh.points = {{-0.2, 1.5, -0.6}, {0.8, 1.5, -0.4}, {0.8, 1.5, 0.6}, {-0.2, 1.5, 0.4}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  b.scene.meshes.push_back(mesh);
  b.light(scene::AreaLight{scene::Mesh{scene::MeshId(0)}, Rgb(20), {}});
  support::expect_same(support::measure(a.scene).whole(), support::measure(b.scene).whole(), 0, 0.03,
                       "quad and mesh");
}

TEST(GlowingShapes, AreTheSameWhicheverWayTheyAreFound) {
  const std::vector<scene::Shape> shapes = {scene::Sphere{{0.2, 1.2, 0}, 0.5},
                                            scene::Box{{-0.4, 0.8, -0.4}, {0.6, 1.5, 0.5}},
                                            scene::Cylinder{{-0.5, 1, 0}, {0.5, 1.3, 0.2}, 0.3},
                                            scene::Cone{{-0.5, 1, 0}, {0.5, 1.3, 0.2}, 0.4, 0.1},
                                            scene::Torus{{0.1, 1.2, 0}, {0.3, 1, 0.5}, 0.4, 0.2},
                                            scene::Mesh{}};
  for (const bool stretched : {false, true})
    for (scene::Shape shape : shapes) {
      SceneBuilder sampled = fog_and_floor(), hit = fog_and_floor();
      if (std::holds_alternative<scene::Mesh>(shape)) {
        shape = add_roof(sampled.scene);
        add_roof(hit.scene);
      }
      sampled.surface(shape, Rgb(0.2f), Rgb(5, 3, 1));
      hit.surface(shape, Rgb(0.2f), Rgb(5, 3, 1));
      if (stretched)
        for (SceneBuilder* b : {&sampled, &hit})
          b->scene.shapes.back().world_from_object =
              Transform{{1.2, 0.1, 0}, {0, 0.7, 0.2}, {0, 0, 1}, {0, 0.2, 0}};
      support::glow_unsampled(hit, 0.2f, Rgb(5, 3, 1));
      const compile::CompiledScene a = compile::compile(sampled.scene), b = compile::compile(hit.scene);
      EXPECT_EQ(a.lights.size(), 1u);
      EXPECT_EQ(b.lights.size(), 0u);
      support::expect_same(support::measure(sampled.scene).whole(), support::measure(hit.scene).whole(), 0,
                           0.05, "shape " + std::to_string(shape.index()));
    }
}

// One-sided, and partly hidden by itself: every way to draw the distance, and every method, finds the same.
TEST(MeshLights, AreTheSameByEveryMethod) {
  SceneBuilder builder = fog_and_floor();
  builder.scene.settings.samples = 128;
  const scene::Mesh roof = add_roof(builder.scene);
  builder.light(scene::AreaLight{roof, {}, Rgb(4, 3, 2)});
  RenderOptions density;
  density.distance = Distance::density;
  const support::Estimate wanted = support::measure(builder.scene, density).whole();
  for (const auto& [name, distance] : support::all_distances()) {
    if (distance == density.distance) continue;
    RenderOptions options;
    options.distance = distance;
    support::expect_same(support::measure(builder.scene, options).whole(), wanted, 0, 0.05, name);
  }
  for (const auto& [name, method] : support::all_methods()) {
    if (method == density.method) continue;
    RenderOptions options;
    options.method = method;
    support::expect_same(support::measure(builder.scene, options).whole(), wanted, 0, 0.05, name);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
