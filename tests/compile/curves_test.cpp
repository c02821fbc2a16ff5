// Rays against tubes along splines: held against spheres strung densely along the same splines.
#include "compile/geometry/curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "base/numerics.h"
#include "compile/compiled_scene.h"
#include "compile/geometry/merge_curves.h"

namespace tyndall::compile {
namespace UNNAMED {

// How far pieces may lie from the spline, in radii: twice what the cutting allows, as the radius goes
// straight too.
constexpr double off = 0.12;

scene::StrandSet strand(std::vector<Vec3d> points, std::vector<double> radii) {
  const auto count = static_cast<std::uint32_t>(points.size());
  return {std::move(points), std::move(radii), {0, count}};
}

// Spheres along a strand, by the textbook's form of the spline.
struct Beads {
  std::vector<Vec3d> centers;
  std::vector<double> radii;

  explicit Beads(const scene::StrandSet& s) {
    const auto last = static_cast<int>(s.points.size()) - 1;
    const auto p = [&](int i) {
      const auto at = [&](int k) { return s.points[static_cast<std::size_t>(k)]; };
      return i < 0 ? at(0) * 2.0 - at(1) : i > last ? at(last) * 2.0 - at(last - 1) : at(i);
    };
    for (int i = 0; i < last; ++i)
      for (int k = 0; k <= 1000; ++k) {
        const double u = k / 1000.0, u2 = u * u, u3 = u2 * u;
        centers.push_back((p(i - 1) * (-u + 2 * u2 - u3) + p(i) * (2 - 5 * u2 + 3 * u3) +
                           p(i + 1) * (u + 4 * u2 - 3 * u3) + p(i + 2) * (u3 - u2)) *
                          0.5);
        radii.push_back(s.radii[static_cast<std::size_t>(i)] * (1 - u) +
                        s.radii[static_cast<std::size_t>(i) + 1] * u);
      }
  }
  // The distance to the tube, below 0 inside, and the radius nearby.
  std::pair<double, double> distance(const Vec3d& x) const {
    double least = infinity, radius = 0;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const double d = length(x - centers[i]) - radii[i];
      if (d < least) least = d, radius = radii[i];
    }
    return {least, radius};
  }
};

CompiledCurves compiled(const scene::StrandSet& set) {
  const std::array<const scene::StrandSet*, 1> sets{&set};
  return CompiledCurves(sets);
}

scene::StrandSet wavy() {
  return strand({{0, 0, 0}, {0.3, 0.5, 0.1}, {-0.2, 0.9, 0.3}, {0.1, 1.4, -0.2}, {0.6, 1.5, 0}},
                {0.05, 0.06, 0.04, 0.03, 0.01});
}

void expect_like_beads(const scene::StrandSet& s, const Vec3d& offset, double scale) {
  scene::StrandSet placed = s;
  for (Vec3d& p : placed.points) p = offset + p * scale;
  for (double& r : placed.radii) r *= scale;
  const CompiledCurves curves = compiled(placed);
  const Beads beads(s);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  // What the offset's own digits leave, in the strand's space.
  const double digits = 1e-15 * length(offset) / scale;
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d towards = {0.2 + 0.6 * uniform(random), 0.75 + 0.9 * uniform(random), 0.4 * uniform(random)};
    const Vec3d direction = normalize(Vec3d{uniform(random), uniform(random), uniform(random)});
    const Vec3d origin = towards - direction * 3.0;
    // Walks up to the tube.
    double t = 0, deepest = infinity;
    for (int step = 0; step < 400 && t < 6; ++step) {
      const auto [d, r] = beads.distance(origin + direction * t);
      deepest = std::min(deepest, d / r);
      if (d < -0.5 * r) break;
      t += std::max(d, 0.05 * r);
    }
    const auto hit = curves.intersect(offset + origin * scale, direction * scale, 6);
    EXPECT_TRUE(hit || deepest >= -2 * off) << i;
    EXPECT_TRUE(!hit || deepest <= 2 * off) << i;
    if (!hit) continue;
    ++met;
    const Vec3d at = origin + direction * hit->t;
    const auto [d, r] = beads.distance(at);
    EXPECT_LE(std::abs(d), off * r + digits) << i;
    EXPECT_LE(length((hit->position - offset) / scale - at), 1e-9 + 10 * digits) << i;
    EXPECT_LT(dot(hit->normal, direction), 0);
    EXPECT_GE(hit->uv.y, 0);
    EXPECT_LE(hit->uv.y, 1);
  }
  EXPECT_GT(met, 100);
}

TEST(Curves, AreTubesAlongTheirSplines) { expect_like_beads(wavy(), {}, 1); }
TEST(Curves, MayBeTiny) { expect_like_beads(wavy(), {}, 1e-6); }
TEST(Curves, MayBeFarAway) { expect_like_beads(wavy(), {1e7, -1e7, 3e6}, 1); }

TEST(Curves, StraightOnesAreCylinders) {
  const CompiledCurves curves =
      compiled(strand({{0, 0, 0}, {0, 0, 1}, {0, 0, 3}, {0, 0, 4}}, {0.2, 0.2, 0.2, 0.2}));
  EXPECT_EQ(curves.pieces(), 3u);
  const scene::Cylinder cylinder{{0, 0, 0}, {0, 0, 4}, 0.2};
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d towards = {0.3 * uniform(random), 0.3 * uniform(random), 2 + uniform(random)};
    const Vec3d origin = {3 * uniform(random), 3, 2 + 0.5 * uniform(random)};
    const Vec3d direction = towards - origin;
    const auto one = curves.intersect(origin, direction, 10), other = cylinder.hit(origin, direction, 0, 10);
    ASSERT_EQ(one.has_value(), other.has_value()) << i;
    if (!one) continue;
    ++met;
    ASSERT_NEAR(one->t, other->t, 1e-12);
    ASSERT_NEAR(dot(normalize(one->normal), normalize(other->normal)), 1, 1e-9);
  }
  EXPECT_GT(met, 5000);
}

// Light that is let through a hair must meet it once, wherever its pieces meet.
TEST(Curves, AreEnteredOnceByALineAcross) {
  std::vector<Vec3d> points;
  for (int i = 0; i <= 8; ++i) points.push_back({std::sin(i * 0.2), std::cos(i * 0.2), 0});
  const CompiledCurves curves = compiled(strand(points, std::vector<double>(9, 0.02)));
  EXPECT_GT(curves.pieces(), 8u);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const double angle = 0.05 + 1.5 * uniform(random), r = 0.985 + 0.03 * uniform(random);
    const Vec3d origin = {r * std::sin(angle), r * std::cos(angle), 1}, direction = {0, 0, -1};
    int entries = 0;
    for (double t = 0; entries < 4;) {
      const auto hit = curves.intersect(origin + direction * t, direction, 10);
      if (!hit) break;
      ++entries;
      t += hit->t + 1e-9;
    }
    ASSERT_EQ(entries, 1) << i;
  }
}

TEST(Curves, WithoutThicknessCannotBeMet) {
  const CompiledCurves curves = compiled(strand({{0, 0, 0}, {0, 1, 0}}, {0, 0}));
  EXPECT_FALSE(curves.intersect({0, 0.5, 1}, {0, 0, -1}, 10));
}

// Random short hairs of one set, or of one set each with a shape each.
scene::Scene hairs(bool one_by_one, scene::MaterialId material) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  scene::Scene scene;
  scene::StrandSet all{{}, {}, {0}};
  for (int i = 0; i < 50; ++i) {
    scene::StrandSet one{{}, {}, {0, 3}};
    for (int k = 0; k < 3; ++k) one.points.push_back({unit(random), unit(random), unit(random)});
    one.radii.assign(3, 0.02);
    all.points.insert(all.points.end(), one.points.begin(), one.points.end());
    all.radii.insert(all.radii.end(), one.radii.begin(), one.radii.end());
    all.begin.push_back(static_cast<std::uint32_t>(all.points.size()));
    if (one_by_one) scene.strand_sets.push_back(std::move(one));
  }
  if (!one_by_one) scene.strand_sets.push_back(std::move(all));
  for (std::size_t i = 0; i < scene.strand_sets.size(); ++i)
    scene.shapes.push_back({scene::Curves{scene::StrandSetId(i)}, {}, material});
  return scene;
}

// Hairs that a loop makes one by one are the same curves as one list of them.
TEST(StrandGroups, OneByOneIsAsOneList) {
  const auto loop = group_strands(hairs(true, scene::MaterialId(0)), {}),
             list = group_strands(hairs(false, scene::MaterialId(0)), {});
  ASSERT_EQ(loop.size(), 50u);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(loop[0].pieces(), list[0].pieces());
  for (std::size_t i = 1; i < loop.size(); ++i) EXPECT_EQ(loop[i].pieces(), 0u);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d origin{unit(random), unit(random), -1};
    const Vec3d direction{unit(random) - 0.5, unit(random) - 0.5, 1};
    const auto a = loop[0].intersect(origin, direction, infinity),
               b = list[0].intersect(origin, direction, infinity);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    ++met;
    EXPECT_EQ(a->t, b->t);
    EXPECT_EQ(a->uv.x, 0.5);  // the only strand of its set
    EXPECT_EQ(a->uv.y, b->uv.y);
  }
  EXPECT_GT(met, 200);
}

// What differs, moves or glows stays by itself.
TEST(StrandGroups, JoinsOnlyWhatIsAlike) {
  scene::Scene scene = hairs(true, scene::MaterialId(0));
  scene.shapes[10].material = scene::MaterialId(1);
  scene.shapes[20].world_from_object = Transform::translate({1, 0, 0});
  scene.shapes[30].visible = false;
  scene.motion.shapes.push_back({40, {}, {}, {}});
  std::vector<std::uint32_t> glows(scene.shapes.size(), no_index);
  glows[45] = 0;
  const auto curves = group_strands(scene, glows);
  std::vector<std::size_t> heads;
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (curves[i].pieces() > 0) heads.push_back(i);
  EXPECT_EQ(heads, (std::vector<std::size_t>{0, 10, 11, 20, 21, 30, 31, 40, 41, 45, 46}));
}

}  // namespace
}  // namespace tyndall::compile
