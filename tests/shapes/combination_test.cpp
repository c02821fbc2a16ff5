// Combined shapes against closed forms, and where faces of parts lie in one place.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/numerics.h"
#include "support/shape_cases.h"

namespace tyndall::shapes {
namespace UNNAMED {

using support::combined;

template <class S>
S as(const Shape& shape) {
  return std::get<S>(shape);
}

std::vector<Intervald> stays(const CombinedShape& s, const Vec3d& o, const Vec3d& d) {
  std::vector<Intervald> out;
  for (const Intervald& stay : s.inside(o, d)) out.push_back(stay);
  return out;
}

double length_inside(const CombinedShape& s, const Vec3d& o, const Vec3d& d) {
  double sum = 0;
  for (const Intervald& stay : s.inside(o, d)) sum += stay.hi - stay.lo;
  return sum;
}

// Lines along z through a square of 2 by 2 metres: the volume, to the error of so many lines.
double volume(const CombinedShape& s) {
  constexpr int grid = 500;
  double sum = 0;
  for (int i = 0; i < grid; ++i)
    for (int k = 0; k < grid; ++k)
      sum += length_inside(s, {2 * (i + 0.5) / grid - 1, 2 * (k + 0.5) / grid - 1, -5}, {0, 0, 1});
  return sum * 4 / (grid * grid);
}

TEST(Combinations, OfTwoBallsHaveTheVolumesOfLenses) {
  const double r = 0.6, apart = 0.5;
  const Sphere a{{0, -apart / 2, 0}, r}, b{{0, apart / 2, 0}, r};
  const double cap = r - apart / 2, ball = 4 * pi * r * r * r / 3,
               lens = 2 * pi * cap * cap * (3 * r - cap) / 3;
  EXPECT_NEAR(volume(as<Intersection>(combined<Intersection>({{a, {}}, {b, {}}}))), lens, 1e-4);
  EXPECT_NEAR(volume(as<Union>(combined<Union>({{a, {}}, {b, {}}}))), 2 * ball - lens, 2e-4);
  EXPECT_NEAR(volume(as<Difference>(combined<Difference>({{a, {}}, {b, {}}}))), ball - lens, 2e-4);
}

TEST(Combinations, OfShapesApartAreBoth) {
  const Sphere a{{-1, 0, 0}, 0.5}, b{{1, 0, 0}, 0.5};
  const auto both = as<Union>(combined<Union>({{a, {}}, {b, {}}}));
  const auto list = stays(both, {-5, 0.1, 0}, {1, 0, 0});
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0], a.inside({-5, 0.1, 0}, {1, 0, 0}));
  EXPECT_EQ(list[1], b.inside({-5, 0.1, 0}, {1, 0, 0}));
  EXPECT_TRUE(
      stays(as<Intersection>(combined<Intersection>({{a, {}}, {b, {}}})), {-5, 0.1, 0}, {1, 0, 0}).empty());
}

// A hole through a block whose ends are flush with its faces, and blocks side by side: nothing is left where
// faces lie in one place, whether the same numbers put them there or transforms do.
TEST(Combinations, FacesInOnePlaceLeaveNothing) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Box block{{-1, -0.3, -0.7}, {1, 0.3, 0.7}}, hole{{-0.2, -0.3, -0.2}, {0.2, 0.3, 0.2}};
  const Box left{{-1, -0.3, -0.7}, {0.1, 0.3, 0.7}}, right{{0.1, -0.3, -0.7}, {1, 0.3, 0.7}};
  const auto turned = [](const Box& box, const Vec3d& axis, double angle) {
    const Transform t = Transform::rotate(axis, angle) * Transform::translate({3, 1, -2});
    return CombinedPart(Shape{combined<Union>({{box, t}})}, inverse_of(t));
  };
  for (int i = 0; i < 3000; ++i) {
    const Vec3d axis{uniform(random), uniform(random), uniform(random) + 1.5},
        d{0.3 * uniform(random), 1, 0.3 * uniform(random)};
    const double angle = 3 * uniform(random);
    const Vec3d in_hole = Vec3d{0.1 * uniform(random), 0, 0.1 * uniform(random)}, o = in_hole - d * 2;
    EXPECT_TRUE(stays(as<Difference>(combined<Difference>({{block, {}}, {hole, {}}})), o, d).empty());
    EXPECT_TRUE(
        stays(as<Difference>(combined<Difference>({{block, {}}, turned(hole, axis, angle)})), o, d).empty());
    const Vec3d along{1, 0.2 * uniform(random), 0.2 * uniform(random)}, from = Vec3d{0.1, 0, 0} - along * 3;
    EXPECT_EQ(stays(as<Union>(combined<Union>({{left, {}}, {right, {}}})), from, along).size(), 1u);
    EXPECT_EQ(stays(as<Union>(combined<Union>({turned(right, axis, angle), {left, {}}})), from, along).size(),
              1u);
    EXPECT_TRUE(
        stays(as<Intersection>(combined<Intersection>({{left, {}}, turned(right, axis, angle)})), from, along)
            .empty());
  }
}

// What is met has the normal of the whole and the coordinates of the part.
TEST(Combinations, HitsAreThoseOfTheParts) {
  const Sphere outer{{0, 0, 0}, 1}, inner{{0, 0, 0}, 0.5};
  const auto shell = as<Difference>(combined<Difference>({{outer, {}}, {inner, {}}}));
  const Vec3d o{-3, 0.1, 0.2}, d{1, 0, 0};
  const auto first = shell.hit(o, d, 0, infinity);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->t, outer.hit(o, d, 0, infinity)->t);
  const auto second = shell.hit(o, d, first->t, infinity), of_inner = inner.hit(o, d, 0, infinity);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->t, of_inner->t);
  EXPECT_EQ(second->position, of_inner->position);
  EXPECT_EQ(second->normal, -of_inner->normal);
  EXPECT_EQ(second->uv.x, of_inner->uv.x);
  EXPECT_EQ(second->uv.y, of_inner->uv.y);
  EXPECT_FALSE(shell.hit(o, d, 0, first->t));
}

// Three hundred balls in three levels: the first hit is the nearest of all.
TEST(Combinations, OfManyPartsAreMetFirst) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Sphere> balls;
  std::vector<CombinedPart> groups;
  for (int i = 0; i < 20; ++i) {
    std::vector<CombinedPart> parts;
    for (int k = 0; k < 15; ++k) {
      balls.push_back({{uniform(random), uniform(random), uniform(random)}, 0.05});
      parts.emplace_back(balls.back(), Transform{});
    }
    groups.emplace_back(combined<Union>(std::move(parts)), Transform{});
  }
  const auto all = as<Union>(combined<Union>(std::move(groups)));
  EXPECT_EQ(all.parts->count, 300u);
  EXPECT_EQ(all.parts->depth, 2u);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d o{uniform(random), uniform(random), -4}, d{0.2 * uniform(random), 0.2 * uniform(random), 1};
    double nearest = infinity;
    for (const Sphere& ball : balls)
      if (const auto hit = ball.hit(o, d, 0, nearest)) nearest = hit->t;
    const auto hit = all.hit(o, d, 0, infinity);
    ASSERT_EQ(hit.has_value(), nearest < infinity);
    if (hit) {
      EXPECT_EQ(hit->t, nearest);
    }
    hits += hit.has_value();
  }
  EXPECT_GT(hits, 200);
}

}  // namespace UNNAMED
}  // namespace tyndall::shapes
