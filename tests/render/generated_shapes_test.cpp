// Shapes that are made into meshes, as what closed shapes may be: filled with a medium, of glass, shining.
// Over the family. Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "support/found_by_chance.h"
#include "support/generated_cases.h"
#include "support/measure.h"
#include "support/scene_builder.h"

namespace tyndall::render {
namespace UNNAMED {

using support::expect_truth;
using support::generated_cases;
using support::GeneratedCase;
using support::measure;
using support::SceneBuilder;

scene::Mesh add_to(SceneBuilder& builder, const GeneratedCase& c) {
  builder.scene.meshes.push_back(support::made(c.shape).mesh);
  return scene::Mesh{scene::MeshId(builder.scene.meshes.size() - 1)};
}

SceneBuilder white_room() {
  SceneBuilder builder;
  builder.image(8, 8, 16).orthographic({3, 2, 4}, {0, 0, 0}, 4).environment(1);
  return builder;
}

// Four rays a pixel through a fine grid, cut into short pieces.
double mean_absorbed(const GeneratedCase& c, double sigma) {
  const Transform world_from_camera = *Transform::look_at({3, 2, 4}, {0, 0, 0}, {0, 1, 0});
  constexpr int grid = 64, pieces = 400;
  constexpr double length = 8;  // around the middle
  double sum = 0;
  for (int i = 0; i < grid; ++i)
    for (int j = 0; j < grid; ++j) {
      const Vec3d o =
          world_from_camera.point({4 * ((i + 0.5) / grid - 0.5), 4 * ((j + 0.5) / grid - 0.5), 0});
      int inside = 0;
      for (int k = 0; k < pieces; ++k)
        inside += c.depth(o - world_from_camera.z * (1.4 + length * (k + 0.5) / pieces)) > 0;
      sum += std::exp(-sigma * length * inside / pieces);
    }
  return sum / (grid * grid);
}

TEST(GeneratedShapes, AbsorbAsTheirLengthsInside) {
  support::MediumColors black;
  black.sigma_t = Rgb(0.7f);
  black.albedo = {};
  for (const GeneratedCase& c : generated_cases()) {
    // Those whose depth takes long are as those of other lathes.
    if (!c.depth || c.shape.index() == 3) continue;
    SceneBuilder builder = white_room();
    builder.volume(add_to(builder, c), builder.constant(black));
    expect_truth(measure(builder.scene).whole(), mean_absorbed(c, 0.7), 2e-3, 0.01, c.name);
  }
}

// White media and clear glass in a white room cannot be seen.
TEST(GeneratedShapesSlow, AreInvisibleInAWhiteRoom) {
  support::MediumColors white;
  white.sigma_t = Rgb(3);
  scene::ConstantSurface glass;
  glass.parameters.transmission = 1;
  glass.parameters.base_color = Rgb(1);
  for (const GeneratedCase& c : generated_cases()) {
    SceneBuilder filled = white_room(), clear = white_room();
    filled.volume(add_to(filled, c), filled.constant(white));
    expect_truth(measure(filled.scene).whole(), 1, 1e-5, 0.02, c.name + " of a white medium");
    clear.surface(add_to(clear, c), glass);
    expect_truth(measure(clear.scene).whole(), 1, 1e-3, 0.02, c.name + " of glass");
  }
}

// As lights that are sampled, and as surfaces that glow and are hit by chance.
TEST(GeneratedShapes, ShineTheSameWhicheverWayTheyAreFound) {
  for (const GeneratedCase& c : generated_cases()) {
    SceneBuilder sampled, hit;
    for (SceneBuilder* b : {&sampled, &hit}) {
      b->image(4, 4, 64).perspective({0, 1, 5}, {0, 0.5, 0}, 40).bounces(2);
      b->surface(scene::Plane{{0, -1.2, 0}, {0, 1, 0}}, Rgb(0.6f));
      b->surface(add_to(*b, c), Rgb(0.2f), Rgb(5, 3, 1));
    }
    support::glow_unsampled(hit, 0.2f, Rgb(5, 3, 1));
    support::expect_same(measure(sampled.scene).whole(), measure(hit.scene).whole(), 0, 0.05, c.name);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
