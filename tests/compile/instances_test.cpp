// A scene of instances is the scene with its instances written out: the same hits, shadows and stays.
#include <gtest/gtest.h>

#include <random>

#include "base/numerics.h"
#include "compile/compiled_scene.h"

namespace tyndall::compile {
namespace UNNAMED {

constexpr double close = 1e-11;  // rounding of two maps against that of their product, in a scene of 10 m

struct Random {
  std::mt19937_64 bits{11};
  std::uniform_real_distribution<double> uniform{-1, 1};
  double operator()() { return uniform(bits); }
  Vec3d vector() { return {(*this)(), (*this)(), (*this)()}; }
  // Turned, stretched, sometimes mirrored.
  Transform transform(double spread) {
    return Transform::translate(vector() * spread) * Transform::rotate(vector(), 3 * (*this)()) *
           Transform::scale({0.6 + 0.4 * (*this)(), (*this)() > 0 ? 0.5 : -0.7, 0.8});
  }
};

scene::ShapeInstance shape(const scene::Shape& shape, const Transform& placed, scene::MaterialId material,
                           bool visible) {
  scene::ShapeInstance s;
  s.shape = shape;
  s.world_from_object = placed;
  s.material = material;
  s.visible = visible;
  return s;
}

// Prototypes within prototypes, with few and with many things, materials of their own and inherited, an
// infinite one.
scene::Scene instanced(Random& random) {
  scene::Scene s;
  s.camera = scene::PerspectiveCamera{};
  for (const float grey : {0.1f, 0.2f, 0.3f, 0.4f}) add_diffuse(s, Rgb(grey));
  const scene::MediumId medium = add_constant_medium(s, {Rgb(0.5f), Rgb(1), {}, {}});
  const scene::Shape shapes[] = {
      scene::Sphere{{0.1, 0, 0}, 0.5}, scene::Box{{-0.3, -0.2, -0.4}, {0.4, 0.5, 0.1}},
      scene::Cylinder{{0, -0.5, 0}, {0.1, 0.6, 0}, 0.2}, scene::Disk{{0, 0, 0}, {0, 1, 1}, 0.7},
      scene::Quad{{0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0.2}}};
  for (const int things : {2, 30, 5}) {
    scene::Prototype p;
    for (int i = 0; i < things; ++i)
      p.shapes.push_back(shape(shapes[i % 5], random.transform(1),
                               i % 2 ? scene::MaterialId(std::size_t{1}) : scene::MaterialId(), i % 7 != 0));
    scene::Volume v;
    v.shape = shapes[things % 3];
    v.world_from_medium = random.transform(1);
    v.world_from_shape = v.world_from_medium * random.transform(0.2);
    v.medium = medium;
    p.volumes.push_back(v);
    for (std::size_t inner = 0; inner < s.prototypes.size(); ++inner)
      for (int i = 0; i < 6; ++i)
        p.instances.push_back({scene::PrototypeId(inner),
                               random.transform(1),
                               i % 2 ? scene::MaterialId(std::size_t{2}) : scene::MaterialId(),
                               i != 3,
                               {}});
    s.prototypes.push_back(p);
  }
  scene::Prototype ground;
  ground.shapes.push_back(shape(scene::Plane{{0, -4, 0}, {0, 1, 0}}, {}, {}, true));
  s.prototypes.push_back(ground);
  for (std::size_t p = 0; p < s.prototypes.size(); ++p)
    for (int i = 0; i < (p == 3 ? 1 : 8); ++i)
      s.instances.push_back({scene::PrototypeId(p),
                             p == 3 ? Transform{} : random.transform(4),
                             scene::MaterialId(std::size_t{3}),
                             i % 4 != 1,
                             {}});
  for (int i = 0; i < 12; ++i)
    s.shapes.push_back(shape(shapes[i % 5], random.transform(4), scene::MaterialId(std::size_t{0}), true));
  s.lights.push_back({scene::AreaLight{scene::Sphere{{1, 2, 3}, 0.5}, Rgb(1), {}}, {}});
  return s;
}

void expect_close(const Vec3d& a, const Vec3d& b) { EXPECT_LT(length(a - b), close); }

TEST(Instances, AreTheirPrototypesWrittenOut) {
  Random random;
  const scene::Scene s = instanced(random);
  const CompiledScene instances = compile(s), written = compile(scene::expanded(s));
  EXPECT_EQ(instances.volumes.size(), written.volumes.size());
  ASSERT_GT(written.scene.shapes.size(), 1000u);
  int hits = 0, misses = 0;
  std::vector<VolumeInterval> a_stays, b_stays;
  for (int i = 0; i < 6000; ++i) {
    const Ray ray{random.vector() * 6, normalize(random.vector()), i % 5 ? infinity : 2.0};
    const RayKind kind = i % 2 ? RayKind::camera : RayKind::scattered;
    const auto a = instances.closest_hit(ray, kind), b = written.closest_hit(ray, kind);
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    EXPECT_EQ(instances.occluded(ray), written.occluded(ray));
    EXPECT_EQ(instances.occluded(ray, 0), written.occluded(ray, 0));
    instances.volume_intervals(ray, kind, a_stays);
    written.volume_intervals(ray, kind, b_stays);
    ASSERT_EQ(a_stays.size(), b_stays.size());
    for (std::size_t k = 0; k < a_stays.size(); ++k) {
      EXPECT_EQ(a_stays[k].volume, b_stays[k].volume);
      EXPECT_NEAR(a_stays[k].t0, b_stays[k].t0, close);
      EXPECT_NEAR(a_stays[k].t1, b_stays[k].t1, close);
    }
    if (!a) {
      ++misses;
      continue;
    }
    ++hits;
    EXPECT_NEAR(a->t, b->t, close);
    expect_close(a->position, b->position);
    expect_close(a->normal, b->normal);
    expect_close(a->position_object, b->position_object);
    expect_close(a->normal_object, b->normal_object);
    EXPECT_NEAR(a->uv.x, b->uv.x, close);
    EXPECT_NEAR(a->uv.y, b->uv.y, close);
    EXPECT_EQ(a->material, b->material);
    EXPECT_EQ(a->light, b->light);
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 100);
}

// Far from the origin the maps lose digits, but no more than the coordinates have.
TEST(Instances, HoldFarAway) {
  scene::Scene s;
  s.camera = scene::PerspectiveCamera{{}, {1e7, 0, 5}, {1e7, 0, 0}, {0, 1, 0}};
  add_diffuse(s, Rgb(0.5f));
  scene::Prototype ball;
  ball.shapes.push_back(
      shape(scene::Sphere{}, Transform::scale(Vec3d(0.5)), scene::MaterialId(std::size_t{0}), true));
  s.prototypes.push_back(ball);
  for (int i = 0; i < 20; ++i)
    s.instances.push_back(
        {scene::PrototypeId(std::size_t{0}), Transform::translate({1e7 + 2 * i, 0, 0}), {}, true, {}});
  const CompiledScene world = compile(s);
  for (int i = 0; i < 20; ++i) {
    const auto hit = world.closest_hit({{2.0 * i, 0, 0}, {0, 0, -1}, infinity}, RayKind::camera);
    ASSERT_TRUE(hit) << i;
    EXPECT_NEAR(hit->t, 4.5, 1e-8);
  }
}

}  // namespace
}  // namespace tyndall::compile
