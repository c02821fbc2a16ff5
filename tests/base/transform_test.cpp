// Affine maps: inverses, order of products, turns, normals.
#include "base/transform.h"

#include <gtest/gtest.h>

#include "base/numerics.h"

namespace tyndall {
namespace UNNAMED {

void expect_near(const Vec3d& a, const Vec3d& b, double tolerance = 1e-12) {
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

const Transform skewed =
    Transform::translate({3, -2, 5}) * Transform::rotate({1, 2, -0.5}, 0.7) * Transform::scale({2, 0.1, -3});

TEST(Transform, InverseUndoes) {
  const Transform inverse = *skewed.inverse();
  expect_near(inverse.point(skewed.point({0.3, 0.7, -4})), {0.3, 0.7, -4});
  expect_near(inverse.vector(skewed.vector({0.3, 0.7, -4})), {0.3, 0.7, -4});
}

TEST(Transform, FlattenedSpaceHasNoInverse) {
  EXPECT_FALSE(Transform::scale({1, 0, 1}).inverse().has_value());
  EXPECT_FALSE(Transform::scale({1e-200, 1e-200, 1e-200}).inverse().has_value());
}

TEST(Transform, ProductAppliesTheRightOneFirst) {
  const Transform t = Transform::translate({1, 0, 0}) * Transform::scale({2, 2, 2});
  expect_near(t.point({1, 1, 1}), {3, 2, 2});
}

TEST(Transform, TurnsCounterClockwiseSeenFromTheAxisTip) {
  expect_near(Transform::rotate({0, 1, 0}, pi / 2).point({0, 0, 1}), {1, 0, 0});
  expect_near(Transform::rotate({0, 0, 7}, pi / 2).point({1, 0, 0}), {0, 1, 0});
}

TEST(Transform, NormalsStayPerpendicularAndOnTheirSide) {
  const Vec3d u{1, 2, 0.5}, v{-0.3, 1, 4}, n = cross(u, v), outside = n;
  const Vec3d mapped = skewed.normal(n);  // skewed mirrors
  EXPECT_NEAR(dot(mapped, skewed.vector(u)), 0, 1e-11);
  EXPECT_NEAR(dot(mapped, skewed.vector(v)), 0, 1e-11);
  EXPECT_GT(dot(mapped, skewed.vector(outside)), 0);
}

TEST(Transform, LookAtLooksAlongMinusZ) {
  const Transform t = *Transform::look_at({1, 2, 3}, {1, 2, -7}, {0, 1, 0});
  expect_near(t.vector({0, 0, -1}), {0, 0, -1});
  expect_near(t.vector({1, 0, 0}), {1, 0, 0});
  EXPECT_FALSE(Transform::look_at({0, 0, 0}, {0, 2, 0}, {0, 1, 0}).has_value());
}

// The frame of Duff et al. is orthonormal for every direction, also straight down.
TEST(Frame, IsOrthonormal) {
  for (const Vec3d& z : {Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, normalize(Vec3d{1, 2, -3}), Vec3d{1, 0, 0}}) {
    const Frame<double> f = Frame<double>::around(z);
    EXPECT_NEAR(dot(f.x, f.y), 0, 1e-14);
    EXPECT_NEAR(dot(f.x, f.z), 0, 1e-14);
    EXPECT_NEAR(length(f.x), 1, 1e-14);
    expect_near(cross(f.x, f.y), f.z, 1e-14);
  }
}

}  // namespace
}  // namespace tyndall
