// Surfaces in whole scenes: white ones in a white room, bodies of glass that overlap, opacity.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include <random>

#include "support/measure.h"
#include "support/scene_builder.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

scene::ConstantSurface glass(float roughness = 0, float ior = 1.5f) {
  scene::ConstantSurface s;
  s.parameters.base_color = Rgb(1);
  s.parameters.transmission = 1;
  s.parameters.roughness = roughness;
  s.ior = ior;
  return s;
}

SceneBuilder white_room() {
  SceneBuilder builder;
  builder.image(8, 8, 16).orthographic({0, 0, 5}, {0, 0, 0}, 2.2).environment(1);
  return builder;
}

MediumColors white_medium() {
  MediumColors colors;
  colors.sigma_t = Rgb(2);
  return colors;
}

// Allowances are the tables' error at all angles of a sphere and over the bounces inside it; none where
// nothing is tabulated.
TEST(SurfaceScenes, WhiteBallsInAWhiteRoom) {
  struct Row {
    const char* name;
    scene::ConstantSurface surface;
    double allowance;
  };
  std::vector<Row> rows{{"clear glass", glass(), 1e-6}, {"frosted glass", glass(0.5f), 0.01}};
  scene::ConstantSurface metal;
  metal.parameters.base_color = Rgb(1);
  metal.parameters.metallic = 1;
  rows.push_back({"mirror", metal, 1e-6});
  metal.parameters.roughness = 0.6f;
  rows.push_back({"rough metal", metal, 0.005});
  scene::ConstantSurface gloss;
  gloss.parameters.base_color = Rgb(1);
  gloss.parameters.specular = 1;
  gloss.parameters.roughness = 0.3f;
  rows.push_back({"gloss", gloss, 0.005});
  for (const Row& row : rows) {
    SceneBuilder builder = white_room();
    builder.surface(scene::Sphere{{}, 1}, row.surface);
    expect_truth(measure(builder.scene).whole(), 1, row.allowance, 0.01, row.name);
  }
}

// Glass of milk that absorbs nothing: as bright as the room.
TEST(SurfaceScenes, BallOfWhiteMilkInGlass) {
  SceneBuilder builder = white_room();
  builder.volume(scene::Sphere{{}, 1}, builder.constant(white_medium())).bounded_by(glass());
  expect_truth(measure(builder.scene).whole(), 1, 1e-6, 0.01, "milk");
}

// Milk reaches into the wall of its glass, which is of higher priority.
TEST(SurfaceScenes, NestedBodiesStayWhite) {
  SceneBuilder builder = white_room();
  builder.surface(scene::Sphere{{}, 1}, glass(), 1)
      .volume(scene::Sphere{{0.3, 0, 0}, 0.9}, builder.constant(white_medium()))
      .bounded_by(glass(0, 1.33f), 0)
      .surface(scene::Sphere{{-0.4, 0, 0}, 0.3}, glass(0, 2.4f), 2);
  expect_truth(measure(builder.scene).whole(), 1, 1e-6, 0.01, "nested");
}

// A body of the same glass inside another, of higher or lower priority, cannot be seen: every pixel is the
// same path by path.
TEST(SurfaceScenes, ABodyInsideOneOfItsOwnKindIsNotThere) {
  const auto picture = [](std::optional<double> inner) {
    SceneBuilder builder;
    builder.image(16, 16, 4).perspective({0, 0.5, 4}, {0, 0, 0}, 35).environment(0.2f);
    builder.sphere_light({1, 3, 1}, 0.5, Rgb(50)).surface(scene::Sphere{{}, 1}, glass(), 1);
    builder.surface(scene::Plane{{0, -1.5, 0}, {0, 1, 0}}, Rgb(0.4f));
    if (inner) builder.surface(scene::Sphere{{0.1, 0, 0}, 0.5}, glass(), *inner);
    return render::render(compile::compile(builder.scene), {});
  };
  const auto alone = picture({}), lower = picture(0.0);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(alone.film.mean(x, y)[c], lower.film.mean(x, y)[c], 1e-4f * alone.film.mean(x, y)[c]);
}

// A volume without a boundary and with a priority leaves room for glass above it: absorbing fog around a
// clear ball, looked through the middle.
TEST(SurfaceScenes, FogGivesWayToGlass) {
  MediumColors black;
  black.albedo = Rgb(0);
  black.sigma_t = Rgb(1);
  for (const bool gives_way : {true, false}) {
    SceneBuilder builder;
    builder.image(2, 2, 64).orthographic({0, 0, 5}, {0, 0, 0}, 1e-6).environment(1);
    builder.volume(scene::Box{{-2, -2, -2}, {2, 2, 2}}, builder.constant(black));
    if (gives_way) builder.scene.volumes.back().priority = -1;
    builder.surface(scene::Sphere{{}, 1}, glass(0, 1.0f));
    const double depth = gives_way ? 2 : 4;
    expect_truth(measure(builder.scene).whole(), std::exp(-depth), 1e-6, 0.01, "fog");
  }
}

// Sheets of opacity 1/2 and 1/4 before a white room, one black and one emitting: closed form. Fog between
// them.
TEST(SurfaceScenes, OpacityMultipliesWhatIsBehind) {
  scene::ConstantSurface half, quarter;
  half.parameters.base_color = quarter.parameters.base_color = Rgb(0);
  half.opacity = 0.5f;
  quarter.opacity = 0.25f;
  SceneBuilder builder;
  builder.image(2, 2, 4).orthographic({0, 0, 5}, {0, 0, 0}, 1e-6).environment(1);
  MediumColors black;
  black.albedo = Rgb(0);
  black.sigma_t = Rgb(0.25f);
  builder.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, builder.constant(black))
      .surface(scene::Quad{{0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}}, half)
      .surface(scene::Quad{{0, 0, -0.5}, {1, 0, 0}, {0, 1, 0}}, quarter);
  const render::RenderResult result = render::render(compile::compile(builder.scene), {});
  EXPECT_NEAR(result.film.mean(0, 0).x, 0.5 * 0.75 * std::exp(-0.5), 1e-6);
}

// Shadows take the same share: a floor lit through a sheet of opacity 0.4.
TEST(SurfaceScenes, OpacityLightensShadows) {
  const auto floor = [](bool sheet) {
    scene::ConstantSurface gauze;
    gauze.parameters.base_color = Rgb(0);
    gauze.opacity = 0.4f;
    SceneBuilder builder;
    builder.image(2, 2, 4).bounces(0).orthographic({0, 1, 0}, {0, 0, 0}, 1e-3, {0, 0, 1});
    builder.point_light({0, 4, 0}, Rgb(10)).surface(scene::Plane{{0, 0, 0}, {0, 1, 0}}, Rgb(0.5f));
    if (sheet) builder.surface(scene::Quad{{0, 2, 0}, {1, 0, 0}, {0, 0, 1}}, gauze);
    return render::render(compile::compile(builder.scene), {}).film.mean(0, 0).x;
  };
  EXPECT_NEAR(floor(true), 0.6f * floor(false), 1e-6f);
}

// White gauze of opacity 1/2 around fog in a white room: nothing absorbs, all is white.
TEST(SurfaceScenes, WhiteGauzeAroundFog) {
  scene::ConstantSurface gauze;
  gauze.parameters.base_color = Rgb(1);
  gauze.opacity = 0.5f;
  SceneBuilder builder = white_room();
  builder.volume(scene::Sphere{{}, 1}, builder.constant(white_medium()))
      .surface(scene::Sphere{{}, 0.8}, gauze)
      .surface(scene::Quad{{0, 0, 0}, {0.7, 0.2, 0}, {0, 0.5, 0.3}}, gauze);
  expect_truth(measure(builder.scene).whole(), 1, 1e-6, 0.01, "gauze");
}

// Strands that stand about at random within a ball of radius 0.8, of half their opacity.
SceneBuilder& add_hair(SceneBuilder& builder, const Rgb& reflectance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-0.45, 0.45);
  const auto point = [&] { return Vec3d{uniform(random), uniform(random), uniform(random)}; };
  scene::StrandSet hair{{}, {}, {0}};
  for (int strand = 0; strand < 60; ++strand) {
    for (int i = 0; i < 4; ++i) hair.points.push_back(point()), hair.radii.push_back(0.02);
    hair.begin.push_back(static_cast<std::uint32_t>(hair.points.size()));
  }
  builder.scene.strand_sets.push_back(std::move(hair));
  scene::ConstantSurface material;
  material.parameters.base_color = reflectance;
  material.parameters.specular = 0;
  material.opacity = 0.5f;
  return builder.surface(scene::Curves{scene::StrandSetId(std::size_t{0})}, material);
}

// White hair of opacity 1/2 in fog in a white room: nothing absorbs, all is white.
TEST(SurfaceScenes, WhiteHairInFog) {
  SceneBuilder builder = white_room();
  builder.volume(scene::Sphere{{}, 1}, builder.constant(white_medium()));
  expect_truth(measure(add_hair(builder, Rgb(1)).scene).whole(), 1, 1e-6, 0.01, "white hair");
}

// Hair that lets half of the light through, in smoke beside a lamp: the march, in whose distance pdf what is
// let through takes part, against null collisions, which stop at each hair or go on by chance.
TEST(SurfaceScenes, HairInSmokeIsTheSameByEveryMethod) {
  SceneBuilder builder;
  builder.image(12, 12, 32)
      .bounces(4)
      .perspective({0, 0, 4}, {0, 0, 0}, 28)
      .sphere_light({1, 1.2, 0.8}, 0.2, Rgb(60));
  builder.volume(scene::Box{{-2, -2, -2}, {2, 2, 2}}, builder.constant({Rgb(0.4f), Rgb(0.9f), {}, hg(0.4f)}));
  add_hair(builder, Rgb(0.7f, 0.4f, 0.2f));
  render::RenderOptions tracking;
  tracking.method = render::Method::tracking;
  tracking.transmittance = render::Transmittance::series;
  const auto marched = measure(builder.scene).whole(), tracked = measure(builder.scene, tracking).whole();
  expect_same(marched, tracked, 0, 0.03, "hair in smoke");
}

}  // namespace
}  // namespace tyndall
