// Laws of the shapes that are made into meshes, over the whole family: they are closed, wound and shaded
// outwards, and are where their definitions say.
#include <gtest/gtest.h>

#include <random>

#include "compile/geometry/mesh.h"
#include "scene/validate.h"
#include "support/generated_cases.h"

namespace tyndall::generate {
namespace UNNAMED {

using support::generated_cases;
using support::GeneratedCase;
using support::made;

Vec3d area_of(const shapes::TriangleMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]) / 2;
}

double volume_of(const shapes::TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    sum += dot(mesh.points[mesh.triangles[t][0]], area_of(mesh, t)) / 3;
  return sum;
}

TEST(Generated, EveryKindHasACase) {
  std::set<std::size_t> kinds;
  for (const GeneratedCase& c : generated_cases()) kinds.insert(c.shape.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<Generated>);
}

TEST(Generated, AreValidAndClosedWithTheOutsideOutside) {
  for (const GeneratedCase& c : generated_cases()) {
    const Problems problems = std::visit([](const auto& s) { return s.validate(); }, c.shape);
    EXPECT_TRUE(problems.empty()) << c.name << ": " << problems[0].message;
    const Made result = made(c.shape);
    ASSERT_TRUE(result.problems.empty()) << c.name << ": " << result.problems[0].message;
    EXPECT_TRUE(scene::validate(result.mesh).empty()) << c.name;
    EXPECT_EQ(scene::open_edges(result.mesh), 0u) << c.name;
    EXPECT_GT(volume_of(result.mesh), 0.001) << c.name;
  }
}

// Smooth normals are of unit length and near those of the facets; uvs are within 0 and 1.
TEST(Generated, AreShadedAsTheyAreMade) {
  for (const GeneratedCase& c : generated_cases()) {
    const shapes::TriangleMesh mesh = made(c.shape).mesh;
    ASSERT_EQ(mesh.normals.size(), mesh.points.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3d area = area_of(mesh, t);
      if (length(area) < 1e-12) continue;
      for (const std::uint32_t i : mesh.triangles[t]) {
        EXPECT_NEAR(length(mesh.normals[i]), 1, 1e-9) << c.name;
        // A pole's facets are steeper than its normal by half a piece at most.
        EXPECT_GT(dot(mesh.normals[i], area / length(area)), std::cos(30 * pi / 180)) << c.name << " " << t;
        EXPECT_TRUE(mesh.uvs[i].x >= 0 && mesh.uvs[i].x <= 1 && mesh.uvs[i].y >= 0 && mesh.uvs[i].y <= 1)
            << c.name;
      }
    }
  }
}

TEST(Generated, AreInsideWhereTheirDefinitionsSay) {
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> uniform{-1, 1};
  for (const GeneratedCase& c : generated_cases()) {
    if (!c.depth) continue;
    const compile::CompiledMesh mesh{scene::SharedMesh(made(c.shape).mesh)};
    int inside = 0, outside = 0;
    for (int ray = 0; ray < 300; ++ray) {
      const Vec3d o{uniform(random), uniform(random), uniform(random)};
      const Vec3d d = normalize(Vec3d{uniform(random), uniform(random), uniform(random)});
      std::vector<Intervald> stays;
      mesh.inside(o, d, 4, stays);
      for (int k = 0; k < 40; ++k) {
        const double t = 2 * (k + 0.5) / 40;
        const double depth = c.depth(o + d * t);
        if (std::abs(depth) <= c.off) continue;
        const bool in =
            std::any_of(stays.begin(), stays.end(), [&](const Intervald& i) { return i.contains(t); });
        EXPECT_EQ(in, depth > 0) << c.name << " at depth " << depth;
        ++(depth > 0 ? inside : outside);
      }
    }
    EXPECT_GT(inside, 100) << c.name;
    EXPECT_GT(outside, 100) << c.name;
  }
}

// Hits are where the depth is 0, with the normal of it.
TEST(Generated, AreHitWhereTheirDefinitionsSay) {
  std::mt19937_64 random{6};
  std::uniform_real_distribution<double> uniform{-1, 1};
  for (const GeneratedCase& c : generated_cases()) {
    if (!c.depth) continue;
    const compile::CompiledMesh mesh{scene::SharedMesh(made(c.shape).mesh)};
    int hits = 0;
    for (int ray = 0; ray < 400; ++ray) {
      const Vec3d d = normalize(Vec3d{uniform(random), uniform(random), uniform(random)});
      const Vec3d o = Vec3d{uniform(random), uniform(random), uniform(random)} * 0.4 - d * 3;
      const auto hit = mesh.intersect(o, d, 10);
      if (!hit) continue;
      ++hits;
      EXPECT_LE(std::abs(c.depth(hit->position)), c.off + 1e-9) << c.name;
    }
    EXPECT_GT(hits, 100) << c.name;
  }
}

// Four turns of a spring that overlap are filled once: no farther than its radius from its path, and all of
// that.
TEST(Generated, ASweepThatMeetsItselfIsFilledOnce) {
  const auto cases = generated_cases();
  const auto spring =
      std::find_if(cases.begin(), cases.end(), [](const auto& c) { return c.name == "spring"; });
  const auto& sweep = std::get<Sweep>(spring->shape);
  const compile::CompiledMesh mesh{scene::SharedMesh(made(spring->shape).mesh)};
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> uniform{-1, 1};
  for (int ray = 0; ray < 300; ++ray) {
    const Vec3d o{uniform(random), uniform(random), uniform(random)};
    const Vec3d d = normalize(Vec3d{uniform(random), uniform(random), uniform(random)});
    std::vector<Intervald> stays;
    mesh.inside(o, d, 4, stays);
    const Vec3d p = o + d;
    double nearest = 1e9;
    for (int i = 0; i < 3000; ++i) {
      const double t = 0.005 * i;
      nearest = std::min(nearest, length(p - Vec3d{0.6 * std::cos(t), 0.1 * t - 0.75, 0.6 * std::sin(t)}));
    }
    const double depth = sweep.radius.values[0] - nearest;
    if (std::abs(depth) < 0.005) continue;
    const bool in =
        std::any_of(stays.begin(), stays.end(), [&](const Intervald& i) { return i.contains(1); });
    EXPECT_EQ(in, depth > 0) << depth;
  }
}

// A circle of few points is smooth, a square is not.
TEST(Generated, CornersAreEdgesAndBendsAreRound) {
  const auto normals = [](const Lathe& lathe, double height) {
    std::set<std::tuple<double, double>> found;  // across and up, rounded, at the points of that height
    const shapes::TriangleMesh mesh = lathe.make().mesh;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      if (mesh.points[i].y == height && mesh.points[i].z == 0 && mesh.points[i].x > 0)
        found.insert({std::round(mesh.normals[i].x * 100), std::round(mesh.normals[i].y * 100)});
    return found.size();
  };
  EXPECT_EQ(normals(Lathe{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, 1), 2u);
  EXPECT_EQ(normals(Lathe{{{0, 0}, {1, 0}, {1.1, 1}, {1.1, 2}, {0, 2}}}, 1), 1u);
  // Given twice, a point of a smooth line is a corner.
  EXPECT_EQ(normals(Lathe{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true}, 1), 1u);
  EXPECT_EQ(normals(Lathe{{{0, 0}, {1, 0}, {1, 1}, {1, 1}, {0, 1}}, true}, 1), 2u);
}

TEST(Generated, OpenOnesAreSheets) {
  EXPECT_GT(scene::open_edges(Lathe{{{0.5, 0}, {0.6, 1}}}.make().mesh), 0u);
  HeightField waves;
  waves.size = {1, 2};
  waves.height = [](const Pair<double>& uv) { return uv.x; };
  EXPECT_GT(scene::open_edges(waves.make().mesh), 0u);
}

// Letters have their holes: a line through the middle of an o meets nothing.
TEST(Generated, LettersHaveTheirHoles) {
  Text text;
  text.text = "o";
  text.align = Align::center;
  const shapes::TriangleMesh mesh = text.make().mesh;
  double low = 1e9, high = -1e9;
  for (const Vec3d& p : mesh.points) {
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  const compile::CompiledMesh compiled{scene::SharedMesh(mesh)};
  EXPECT_FALSE(compiled.intersect({0.001, (low + high) / 2, 2}, {0, 0, -1}, 10));
  EXPECT_TRUE(compiled.intersect({0.001, low + 0.03, 2}, {0, 0, -1}, 10));
}

}  // namespace UNNAMED
}  // namespace tyndall::generate
