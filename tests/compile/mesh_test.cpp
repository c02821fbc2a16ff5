// Meshes against the shapes that they describe, without cracks, also for rays that meet corners and edges
// exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/numerics.h"
#include "compile/geometry/mesh.h"
#include "shapes/mesh_at.h"

namespace tyndall::compile {
namespace UNNAMED {

scene::TriangleMesh box_mesh(const Vec3d& lo, const Vec3d& hi) {
  scene::TriangleMesh m;
  for (int i = 0; i < 8; ++i)
    m.points.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

// An octahedron of radius 1, each side cut in four n times and blown up to the sphere.
scene::TriangleMesh sphere_mesh(int cuts) {
  scene::TriangleMesh m;
  m.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int cut = 0; cut < cuts; ++cut) {
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const auto middle = [&](std::uint32_t p, std::uint32_t q) {
        // Doubled points: they count as one by their places.
        m.points.push_back(normalize(m.points[std::min(p, q)] + m.points[std::max(p, q)]));
        return static_cast<std::uint32_t>(m.points.size() - 1);
      };
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    m.triangles = finer;
  }
  return m;
}

struct Random {
  std::mt19937_64 bits{5};
  std::uniform_real_distribution<double> uniform{-1, 1};
  Vec3d vector() { return {uniform(bits), uniform(bits), uniform(bits)}; }
};

double total(const std::vector<Intervald>& intervals_inside) {
  double sum = 0;
  for (const Intervald& stay : intervals_inside) sum += stay.length();
  return sum;
}

TEST(Meshes, ABoxOfTrianglesIsTheBox) {
  const scene::Box box{{-0.3, -0.5, 0.1}, {0.7, 0.2, 1.3}};
  const scene::TriangleMesh triangles = box_mesh(box.min, box.max);
  ASSERT_EQ(scene::open_edges(triangles), 0u);
  const CompiledMesh mesh(triangles);
  Random random;
  std::vector<Intervald> intervals_inside;
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d o = random.vector() * 2, d = random.vector() * (i % 3 + 0.1);
    const double t_max = i % 4 ? infinity : 1;
    intervals_inside.clear();
    mesh.inside(o, d, t_max, intervals_inside);
    const Intervald stay = box.inside(o, d).clipped_to({0, t_max});
    if (stay.length() > 1e-9 || !intervals_inside.empty()) {
      ASSERT_EQ(intervals_inside.size(), 1u);
      EXPECT_NEAR(intervals_inside[0].lo, stay.lo, 1e-10);
      EXPECT_NEAR(intervals_inside[0].hi, stay.hi, 1e-10);
    }
    const auto a = mesh.intersect(o, d, t_max), b = box.hit(o, d, 0, t_max);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ++hits;
    EXPECT_NEAR(a->t, b->t, 1e-10);
    EXPECT_LT(length(a->position - b->position), 1e-10);
    EXPECT_LT(length(normalize(a->normal) - b->normal), 1e-12);
  }
  EXPECT_GT(hits, 1000);
}

// Lines that meet corners and edges exactly: a box on whole numbers, origins and directions on whole numbers.
TEST(Meshes, EdgesAndCornersAreCrossedOnce) {
  const scene::Box box{{-2, -1, -3}, {1, 2, 2}};
  const scene::TriangleMesh triangles = box_mesh(box.min, box.max);
  const CompiledMesh mesh(triangles);
  std::mt19937 bits(3);
  std::uniform_int_distribution<int> whole(-5, 5);
  std::vector<Intervald> intervals_inside;
  int exact = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d o{double(whole(bits)), double(whole(bits)), double(whole(bits))};
    const Vec3d d{double(whole(bits)), double(whole(bits)), double(whole(bits))};
    if (length_squared(d) == 0) continue;
    // Lines within the plane of a side may count as in or out; the others have one answer.
    bool in_side = false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      in_side |= d[axis] == 0 && (o[axis] == box.min[axis] || o[axis] == box.max[axis]);
    if (in_side) continue;
    intervals_inside.clear();
    mesh.inside(o, d, infinity, intervals_inside);
    EXPECT_NEAR(total(intervals_inside), box.inside(o, d).clipped_to({0, infinity}).length(), 1e-12) << i;
    ++exact;
  }
  EXPECT_GT(exact, 10000);
}

// From inside, whatever the direction, the way out is met: towards corners, towards points of edges,
// anywhere.
TEST(Meshes, HaveNoCracks) {
  const scene::TriangleMesh triangles = sphere_mesh(3);
  const CompiledMesh mesh(triangles);
  Random random;
  const auto must_hit = [&](const Vec3d& o, const Vec3d& target) {
    const auto hit = mesh.intersect(o, target - o, infinity);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 1, 1e-12);
    EXPECT_GT(dot(hit->normal, target - o), 0);
  };
  for (const auto& triangle : triangles.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d o = random.vector() * 0.5;
      const Vec3d &a = triangles.points[triangle[i]], &b = triangles.points[triangle[(i + 1) % 3]];
      must_hit(o, a);
      must_hit(o, (a + b) * 0.5);
      must_hit(o, a * 0.3 + b * 0.7);
    }
}

TEST(Meshes, ASphereOfTrianglesIsNearlyTheSphere) {
  const scene::TriangleMesh triangles = sphere_mesh(5);
  ASSERT_EQ(triangles.triangles.size(), 8192u);
  ASSERT_EQ(scene::open_edges(triangles), 0u);
  const CompiledMesh mesh(triangles);
  Random random;
  std::vector<Intervald> intervals_inside;
  double of_mesh = 0, of_sphere = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d o = random.vector() * 1.5, d = normalize(random.vector());
    intervals_inside.clear();
    mesh.inside(o, d, 2, intervals_inside);
    ASSERT_LE(intervals_inside.size(), 1u);
    const double chord = scene::Sphere{}.inside(o, d).clipped_to({0, 2}).length();
    EXPECT_LE(total(intervals_inside), chord + 1e-12);  // it lies within the sphere
    of_mesh += total(intervals_inside);
    of_sphere += chord;
  }
  // Sides of length 0.05 lie up to 0.05²/6 below the sphere.
  EXPECT_NEAR(of_mesh / of_sphere, 1, 2e-3);
}

// Turned inside out it still has its inside; a doubled one too; a cavity is outside.
TEST(Meshes, CountTheirWinding) {
  scene::TriangleMesh turned = box_mesh({-1, -1, -1}, {1, 1, 1});
  scene::TriangleMesh hollow = turned, twice = turned;
  for (auto& triangle : turned.triangles) std::swap(triangle[1], triangle[2]);
  twice.triangles.insert(twice.triangles.end(), turned.triangles.begin(), turned.triangles.end());
  scene::TriangleMesh cavity = box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  hollow.points.insert(hollow.points.end(), cavity.points.begin(), cavity.points.end());
  for (const auto& [a, b, c] : cavity.triangles) hollow.triangles.push_back({a + 8, c + 8, b + 8});
  std::vector<Intervald> intervals_inside;
  CompiledMesh(turned).inside({0.1, 0.2, 0}, {0, 0, 1}, infinity, intervals_inside);
  ASSERT_EQ(intervals_inside.size(), 1u);
  EXPECT_EQ(intervals_inside[0], (Intervald{0, 1}));
  intervals_inside.clear();
  CompiledMesh(hollow).inside({0.1, 0.2, -5}, {0, 0, 1}, infinity, intervals_inside);
  ASSERT_EQ(intervals_inside.size(), 2u);
  constexpr double ulps = 1e-14;
  EXPECT_NEAR(intervals_inside[0].lo, 4, ulps);
  EXPECT_NEAR(intervals_inside[0].hi, 4.5, ulps);
  EXPECT_NEAR(intervals_inside[1].lo, 5.5, ulps);
  EXPECT_NEAR(intervals_inside[1].hi, 6, ulps);
  // A box and the same box turned over cancel.
  intervals_inside.clear();
  CompiledMesh(twice).inside({0.1, 0.2, -5}, {0, 0, 1}, infinity, intervals_inside);
  EXPECT_NEAR(total(intervals_inside), 0, ulps);
}

// Without a lid it is told to be open, and stays remain within the box and are numbers.
TEST(Meshes, OpenOnesAreToldAndHarmless) {
  scene::TriangleMesh open = box_mesh({-1, -1, -1}, {1, 1, 1});
  open.triangles.resize(10);
  EXPECT_EQ(scene::open_edges(open), 4u);
  scene::TriangleMesh badly_wound = box_mesh({-1, -1, -1}, {1, 1, 1});
  std::swap(badly_wound.triangles[0][0], badly_wound.triangles[0][1]);
  EXPECT_EQ(scene::open_edges(badly_wound), 3u);
  const CompiledMesh mesh(open);
  Random random;
  std::vector<Intervald> intervals_inside;
  for (int i = 0; i < 5000; ++i) {
    const Vec3d o = random.vector() * 3, d = random.vector();
    intervals_inside.clear();
    mesh.inside(o, d, infinity, intervals_inside);
    for (const Intervald& stay : intervals_inside) {
      EXPECT_FALSE(stay.empty());
      EXPECT_LE(max_component(o + d * stay.hi), 1 + 1e-9);
      EXPECT_GE(min_component(o + d * stay.hi), -1 - 1e-9);
    }
  }
}

TEST(Meshes, MixUvsAndNormalsOverTheirPoints) {
  scene::TriangleMesh one;
  one.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  one.uvs = {{0, 0}, {2, 0}, {0, 4}};
  one.normals = {{0, 0, 1}, {1, 0, 1}, {0, 0, 1}};
  const auto hit = CompiledMesh(one).intersect({0.25, 0.5, 1}, {0, 0, -2}, infinity);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 0.5);
  EXPECT_NEAR(hit->uv.x, 0.5, 1e-14);
  EXPECT_NEAR(hit->uv.y, 2, 1e-14);
  EXPECT_NEAR(hit->shading_normal.x, 0.25, 1e-14);
  EXPECT_GT(hit->normal.z, 0);
}

// The sphere's triangles swell and turn: at any time it is the mesh that stands as it is then.
TEST(Meshes, ThatDeformAreAtATimeAsTheyAreThen) {
  scene::TriangleMesh mesh = sphere_mesh(3);
  mesh.normals = mesh.points;
  for (int k = 1; k <= 4; ++k) {
    scene::MeshPose pose;
    for (const Vec3d& p : mesh.points) {
      const double angle = 0.2 * k + 0.1 * p.z;
      pose.points.push_back(Vec3d{p.x * std::cos(angle) - p.y * std::sin(angle),
                                  p.x * std::sin(angle) + p.y * std::cos(angle), p.z * (1 + 0.3 * k)} +
                            Vec3d{0.7 * k, 0, 0});
    }
    pose.normals = pose.points;
    mesh.later.push_back(std::move(pose));
  }
  const CompiledMesh moving(mesh);
  Random random;
  int hits = 0;
  for (int i = 0; i < 64; ++i) {
    const double time = i == 0 ? 0 : i == 1 ? 1 : (1 + random.uniform(random.bits)) / 2;
    const shapes::MeshAt now(mesh, time);
    scene::TriangleMesh frozen = mesh;
    frozen.later.clear();
    for (std::uint32_t k = 0; k < frozen.points.size(); ++k) {
      frozen.points[k] = now.point(k);
      frozen.normals[k] = now.normal(k);
    }
    const CompiledMesh still(frozen);
    for (int ray = 0; ray < 50; ++ray) {
      const Vec3d o = random.vector() * 4.0, d = Vec3d{1.4 * time * 2, 0, 0} + random.vector() - o;
      const auto a = moving.intersect(o, d, infinity, {}, time), b = still.intersect(o, d, infinity);
      ASSERT_EQ(a.has_value(), b.has_value()) << time;
      std::vector<Intervald> stays, wanted;
      moving.inside(o, d, infinity, stays, time);
      still.inside(o, d, infinity, wanted);
      ASSERT_EQ(stays.size(), wanted.size());
      for (std::size_t k = 0; k < stays.size(); ++k) EXPECT_EQ(stays[k].lo, wanted[k].lo);
      if (!a) continue;
      ++hits;
      EXPECT_EQ(a->t, b->t);
      EXPECT_EQ(a->part, b->part);
      EXPECT_EQ(a->normal, b->normal);
      EXPECT_EQ(a->shading_normal, b->shading_normal);
    }
  }
  EXPECT_GT(hits, 500);
}

}  // namespace
}  // namespace tyndall::compile
