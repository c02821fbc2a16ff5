// Laws of rays against single shapes: stays are where points are inside, hits are the ends of stays, and lie
// on the surface with an outward normal.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/numerics.h"
#include "compile/shape_queries.h"

namespace tyndall::compile {
namespace {

// How far inside a point is, about [m]: negative outside. Written from the definitions, apart from the
// queries.
double depth(const scene::Sphere& s, const Vec3d& p) { return s.radius - length(p - s.center); }
double depth(const scene::Box& b, const Vec3d& p) {
  return std::min(min_component(p - b.min), min_component(b.max - p));
}
double depth(const scene::Cylinder& c, const Vec3d& p) {
  const Vec3d axis = normalize(c.to - c.from);
  const double along = dot(p - c.from, axis);
  const double across = length(p - c.from - axis * along);
  return std::min({along, length(c.to - c.from) - along, c.radius - across});
}

const scene::Shape closed_shapes[] = {
    scene::Sphere{{0.3, -0.2, 0.1}, 0.8},
    scene::Box{{-0.5, -1, 0.2}, {0.7, 0.4, 0.9}},
    scene::Cylinder{{0.1, -0.6, 0.2}, {0.4, 0.7, -0.5}, 0.5},
    scene::Cylinder{{0, 0, 0}, {0, 0, -1}, 0.7},
    scene::Cylinder{{-1, 0, 0}, {1, 0, 0}, 0.01},
};

struct Rays {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> uniform{-1, 1};
  Vec3d vector() { return {uniform(random), uniform(random), uniform(random)}; }
  // Every fourth direction is along an axis.
  Vec3d direction(int i) {
    if (i % 4 == 0) return {i % 3 == 0 ? 1.0 : 0.0, i % 3 == 1 ? -1.0 : 0.0, i % 3 == 2 ? 1.0 : 0.0};
    return vector() * (i % 5 + 0.2);
  }
};

TEST(Shapes, StaysAreWherePointsAreInside) {
  for (const scene::Shape& shape : closed_shapes)
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { depth(s, Vec3d{}); }) {
            Rays rays;
            int inside_points = 0;
            for (int i = 0; i < 4000; ++i) {
              const Vec3d o = rays.vector() * 1.5, d = rays.direction(i);
              const Intervald stay = inside(shape, o, d, 3);
              for (int k = 0; k < 30; ++k) {
                const double t = 0.1 * k + 0.05, deep = depth(s, o + d * t);
                if (std::abs(deep) < 1e-12) continue;
                EXPECT_EQ(stay.contains(t), deep > 0) << s.keyword << " " << deep;
                inside_points += deep > 0;
              }
            }
            EXPECT_GT(inside_points, 0);
          }
        },
        shape);
}

TEST(Shapes, HitsAreTheEndsOfStays) {
  for (const scene::Shape& shape : closed_shapes)
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { depth(s, Vec3d{}); }) {
            Rays rays;
            const Bounds box = *bounds(shape);
            for (int i = 0; i < 4000; ++i) {
              const Vec3d o = rays.vector() * 1.5, d = rays.direction(i);
              const Intervald stay = inside(shape, o, d, infinity);
              const auto hit = intersect(shape, o, d, infinity);
              ASSERT_EQ(hit.has_value(), !stay.empty());
              if (!hit) continue;
              EXPECT_EQ(hit->t, stay.lo > 0 ? stay.lo : stay.hi);
              EXPECT_NEAR(length(hit->position - (o + d * hit->t)), 0, 1e-13);
              EXPECT_NEAR(depth(s, hit->position), 0, 1e-14);
              const Vec3d n = normalize(hit->normal);
              EXPECT_LT(depth(s, hit->position + n * 1e-4), 0) << s.keyword;
              EXPECT_EQ(dot(n, d) < 0, stay.lo > 0) << s.keyword;
              for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(hit->position[axis], box.lo[axis] - 1e-14);
                EXPECT_LE(hit->position[axis], box.hi[axis] + 1e-14);
              }
              EXPECT_GE(hit->uv.x, -1e-12);
              EXPECT_LE(hit->uv.x, 1 + 1e-12);
              EXPECT_FALSE(intersect(shape, o, d, hit->t));
            }
          }
        },
        shape);
}

// The boxes are no larger than they must be: random hits come near every face.
TEST(Shapes, CylinderAndDiskBoundsAreTight) {
  const scene::Shape cylinder = scene::Cylinder{{0.1, -0.6, 0.2}, {0.4, 0.7, -0.5}, 0.5},
                     disk = scene::Disk{{0.1, 0, 0}, {1, 2, -1}, 0.8};
  for (const scene::Shape& shape : {cylinder, disk}) {
    Rays rays;
    const Bounds box = *bounds(shape);
    Vec3d lo(infinity), hi(-infinity);
    for (int i = 0; i < 60000; ++i) {
      const auto hit = intersect(shape, rays.vector() * 1.5, rays.vector(), infinity);
      if (!hit) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], hit->position[axis]);
        hi[axis] = std::max(hi[axis], hit->position[axis]);
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(lo[axis], box.lo[axis], 0.02);
      EXPECT_NEAR(hi[axis], box.hi[axis], 0.02);
      EXPECT_GE(lo[axis], box.lo[axis] - 1e-14);
      EXPECT_LE(hi[axis], box.hi[axis] + 1e-14);
    }
  }
}

TEST(Shapes, DisksAreHitWithinTheirRadius) {
  const scene::Disk disk{{0.1, -0.2, 0.3}, {1, 2, -1}, 0.8};
  Rays rays;
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d o = rays.vector() * 1.5, d = rays.vector();
    const double t = dot(disk.center - o, disk.normal) / dot(d, disk.normal);
    const double off = length(o + d * t - disk.center);
    if (std::abs(off - disk.radius) < 1e-12) continue;
    const auto hit = intersect(disk, o, d, infinity);
    ASSERT_EQ(hit.has_value(), t > 0 && off < disk.radius);
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(length(hit->position - (o + d * t)), 0, 1e-12);
    EXPECT_GT(dot(hit->normal, disk.normal), 0);
  }
  EXPECT_GT(hits, 100);
  EXPECT_TRUE(inside(disk, {0, 0, 0}, {0, 0, 1}, infinity).empty());
}

}  // namespace
}  // namespace tyndall::compile
