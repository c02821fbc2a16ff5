// Laws of the shapes, over the whole family: intervals are where points are inside, hits are their ends and
// lie on the surface with an outward normal, boxes hold them and are no larger than they must be, areas and
// draws from them are those that straight lines meet.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "base/numerics.h"
#include "optics/emitter.h"
#include "support/shape_cases.h"

namespace tyndall::shapes {
namespace UNNAMED {

using support::depth_in;
using support::describe;
using support::for_closed_shapes;
using support::shape_cases;

struct Rays {
  std::mt19937_64 random{7};
  std::uniform_real_distribution<double> uniform{-1, 1};
  Vec3d vector() { return {uniform(random), uniform(random), uniform(random)}; }
  Vec3d unit() {
    for (;;)
      if (const Vec3d v = vector(); length(v) < 1 && length(v) > 0.01) return normalize(v);
  }
  // Every fourth direction is along an axis.
  Vec3d direction(int i) {
    if (i % 4 == 0) return {i % 3 == 0 ? 1.0 : 0.0, i % 3 == 1 ? -1.0 : 0.0, i % 3 == 2 ? 1.0 : 0.0};
    return vector() * (i % 5 + 0.2);
  }
};

template <class S>
std::vector<Intervald> intervals(const S& s, const Vec3d& o, const Vec3d& d, double t_max) {
  std::vector<Intervald> out;
  for_each_interval(s.inside(o, d), t_max, [&](const Intervald& i) { out.push_back(i); });
  return out;
}

std::optional<ShapeHit> hit(const Shape& shape, const Vec3d& o, const Vec3d& d, double t_min) {
  return std::visit(
      [&](const auto& s) -> std::optional<ShapeHit> {
        if constexpr (Analytic<std::decay_t<decltype(s)>>) return s.hit(o, d, t_min, infinity);
        return std::nullopt;
      },
      shape);
}

bool holds(const std::vector<Intervald>& all, double t) {
  return std::any_of(all.begin(), all.end(), [&](const Intervald& i) { return i.contains(t); });
}

// The shape as an emitter, if it can be one.
std::optional<optics::Emitter> emitter(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> std::optional<optics::Emitter> {
        using S = std::decay_t<decltype(s)>;
        if constexpr (Faceted<S>)
          return optics::Emitter(optics::EmitterTriangles{s.triangles()}, {});
        else if constexpr (Sampled<S>)
          return optics::Emitter(Shape{s}, {});
        else
          return std::nullopt;
      },
      shape);
}

TEST(Shapes, EveryKindIsAmongTheCases) {
  std::set<std::size_t> kinds;
  for (const Shape& shape : shape_cases()) kinds.insert(shape.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<Shape> - 2);  // meshes and curves: tests/compile
}

TEST(Shapes, CasesAreSound) {
  for (const Shape& shape : shape_cases())
    std::visit(
        [](const auto& s) {
          if constexpr (requires { s.validate(); }) {
            EXPECT_TRUE(s.validate().empty()) << s.keyword;
          }
        },
        shape);
}

TEST(Shapes, IntervalsAreWherePointsAreInside) {
  for_closed_shapes([](const auto& s) {
    Rays rays;
    int inside_points = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3d o = rays.vector() * 1.5, d = rays.direction(i);
      const std::vector<Intervald> all = intervals(s, o, d, 3);
      for (int k = 0; k < 30; ++k) {
        const double t = 0.1 * k + 0.05, deep = depth_in(s, o + d * t);
        if (std::abs(deep) < 1e-12) continue;
        EXPECT_EQ(holds(all, t), deep > 0) << s.keyword << " " << deep;
        EXPECT_EQ(s.depth(o + d * t) > 0, deep > 0) << s.keyword << " " << deep;
        inside_points += deep > 0;
      }
    }
    EXPECT_GT(inside_points, 0);
  });
}

TEST(Shapes, HitsAreTheEndsOfIntervals) {
  for_closed_shapes([](const auto& s) {
    Rays rays;
    const Bounds box = s.bounds();
    for (int i = 0; i < 4000; ++i) {
      const Vec3d o = rays.vector() * 1.5, d = rays.direction(i);
      double after = 0;
      for (const Intervald& interval : intervals(s, o, d, infinity))
        for (const double end : {interval.lo, interval.hi}) {
          if (!(end > 0)) continue;  // the ray starts inside
          const auto found = s.hit(o, d, after, infinity);
          ASSERT_TRUE(found) << s.keyword;
          ASSERT_EQ(found->t, end) << s.keyword;
          after = end;
          EXPECT_NEAR(length(found->position - (o + d * end)), 0, 1e-13) << s.keyword;
          EXPECT_NEAR(depth_in(s, found->position), 0, 1e-14) << s.keyword;
          const Vec3d n = normalize(found->normal);
          EXPECT_LT(depth_in(s, found->position + n * 1e-7), 0) << s.keyword;
          if (std::abs(dot(n, normalize(d))) > 1e-7) {
            EXPECT_EQ(dot(n, d) < 0, end == interval.lo) << s.keyword;
          }
          for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(found->position[axis], box.lo[axis] - 1e-14) << s.keyword;
            EXPECT_LE(found->position[axis], box.hi[axis] + 1e-14) << s.keyword;
          }
          for (const double coordinate : {found->uv.x, found->uv.y}) {
            EXPECT_GE(coordinate, -1e-12) << s.keyword;
            EXPECT_LE(coordinate, 1 + 1e-12) << s.keyword;
          }
        }
      EXPECT_FALSE(s.hit(o, d, after, infinity)) << s.keyword;
    }
  });
}

// The same place has the same coordinates, whichever ray finds it.
TEST(Shapes, CoordinatesBelongToPlaces) {
  for (const Shape& shape : shape_cases()) {
    Rays rays;
    for (int i = 0; i < 1000; ++i) {
      const Vec3d o = rays.vector() * 2;
      const auto a = hit(shape, o, rays.direction(i), 0);
      if (!a) continue;
      const Vec3d n = normalize(a->normal), d = normalize(rays.unit() * 0.7 - n);
      const auto b = hit(shape, a->position - d * 1e-3, d, 0);
      if (!b || length(a->position - b->position) > 1e-12) continue;
      for (const double off : {a->uv.x - b->uv.x, a->uv.y - b->uv.y})
        EXPECT_NEAR(off - std::round(off), 0, 1e-9) << describe(shape);
    }
  }
}

Shape scaled(const Shape& shape, double scale);

template <class S>
Shape scaled_as(S s, double scale) {
  if constexpr (std::is_base_of_v<CombinedShape, S>) {
    std::vector<CombinedPart> parts;
    for (const CombinedPart& part : s.parts->list) {
      Transform place = part.placed ? part.placed->outer_from_part : Transform{};
      place.t = place.t * scale;
      parts.emplace_back(scaled(part.shape, scale), place);
    }
    return support::combined<S>(std::move(parts));
  } else {
    S::fields([&](auto member, const FieldInfo&) {
      if constexpr (requires { s.*member *= scale; })
        s.*member *= scale;
      else if constexpr (std::is_same_v<std::decay_t<decltype(s.*member)>, Vec3d>)
        s.*member = s.*member * scale;
    });
    return s;
  }
}
Shape scaled(const Shape& shape, double scale) {
  return std::visit([&](const auto& s) { return scaled_as(s, scale); }, shape);
}

// From a micrometre to ten thousand kilometres: all lengths a times as long, all else the same.
TEST(Shapes, AreTheSameAtEveryScale) {
  for (const Shape& shape : shape_cases())
    for (const double scale : {1e-6, 1e7}) {
      const Shape resized = scaled(shape, scale);
      Rays rays;
      int hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3d o = rays.vector() * 1.5, d = rays.direction(i);
        const auto a = hit(shape, o, d, 0), b = hit(resized, o * scale, d, 0);
        if (!a && !b) continue;
        ++hits;
        // At the very rim the two may differ.
        if (a && std::abs(dot(normalize(a->normal), normalize(d))) < 1e-4) continue;
        ASSERT_EQ(a.has_value(), b.has_value()) << describe(shape);
        EXPECT_NEAR(b->t / scale, a->t, 1e-9 * (1 + a->t)) << describe(shape);
        EXPECT_LT(length(b->position / scale - a->position), 1e-9) << describe(shape);
        EXPECT_LT(length(normalize(b->normal) - normalize(a->normal)), 1e-6) << describe(shape);
      }
      EXPECT_GT(hits, 0) << describe(shape);
    }
}

// Lines that touch the surface or miss it by down to a rounding: what is entered is left, and a place that is
// inside by more than rounding is met.
TEST(Shapes, GrazingRaysMissNothingAndMeetNothingTwice) {
  for_closed_shapes([](const auto& s) {
    const auto surface = emitter(Shape{s});
    if (!surface) return;  // combinations: their parts are asked
    Rays rays;
    std::mt19937_64 random(8);
    std::uniform_real_distribution<float> uniform;
    for (int i = 0; i < 4000; ++i) {
      const SurfacePoint at = surface->sample(uniform(random), uniform(random));
      const double off = (i % 2 == 0 ? 1 : -1) * std::pow(10.0, -3 - 13 * double(uniform(random)));
      const Vec3d d = normalize(cross(at.normal, rays.unit())), p = at.position + at.normal * off;
      for (const double away : {0.0, 3.0, 1e3}) {
        const Vec3d o = p - d * away;
        const std::vector<Intervald> all = intervals(s, o, d, infinity);
        const double deep = depth_in(s, p);
        if (std::abs(deep) > 1e-14 * (10 + away)) {
          EXPECT_EQ(holds(all, away), deep > 0) << s.keyword << " " << deep << " from " << away;
        }
        double after = 0;
        int met = 0;
        for (auto found = s.hit(o, d, after, infinity); found; found = s.hit(o, d, after, infinity)) {
          ASSERT_GT(found->t, after) << s.keyword;
          after = found->t;
          ++met;
        }
        int ends = 0;
        for (const Intervald& interval : all) {
          ends += 1 + (interval.lo > 0);
          EXPECT_GT(depth_in(s, o + d * (0.5 * (interval.lo + interval.hi))), -1e-14 * (10 + away))
              << s.keyword;
        }
        EXPECT_EQ(met, ends) << s.keyword;
      }
    }
  });
}

// Boxes hold the shape and are no larger than they must be: points come near every face.
TEST(Shapes, BoundsAreTight) {
  for (const Shape& shape : shape_cases()) {
    const auto surface = emitter(shape);
    if (!surface) continue;
    const Bounds box = std::visit(
        [](const auto& s) {
          if constexpr (Bounded<std::decay_t<decltype(s)>>) return s.bounds();
          return Bounds{};
        },
        shape);
    const Ball ball = std::visit(
        [](const auto& s) {
          if constexpr (Analytic<std::decay_t<decltype(s)>>) return s.ball();
          return Ball{};
        },
        shape);
    std::mt19937_64 random(9);
    std::uniform_real_distribution<float> uniform;
    Vec3d lo(infinity), hi(-infinity);
    for (int i = 0; i < 60000; ++i) {
      const Vec3d p = surface->sample(uniform(random), uniform(random)).position;
      EXPECT_LE(length(p - ball.center), ball.radius * (1 + 1e-12)) << describe(shape);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], p[axis]);
        hi[axis] = std::max(hi[axis], p[axis]);
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(lo[axis], box.lo[axis], 0.02) << describe(shape);
      EXPECT_NEAR(hi[axis], box.hi[axis], 0.02) << describe(shape);
      EXPECT_GE(lo[axis], box.lo[axis] - 1e-14) << describe(shape);
      EXPECT_LE(hi[axis], box.hi[axis] + 1e-14) << describe(shape);
    }
  }
}

// Lines that fill space evenly cross a surface evenly over its area, and a surface of area A within a ball of
// radius r on average A / (2 pi r²) times (Cauchy and Crofton). So areas and draws are compared with hits,
// which know nothing of them: cells of a grid over the box, χ² of two samples, at six standard deviations.
// Seed 10.
TEST(Shapes, AreDrawnEvenlyOverTheirArea) {
  for (const Shape& shape : shape_cases()) {
    const auto surface = emitter(shape);
    if (!surface) continue;
    constexpr int lines = 60000, grid = 4;
    const Vec3d middle = surface->center();
    const double radius = surface->radius();
    const auto cell = [&](const Vec3d& p) {
      std::size_t index = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        index = index * grid + static_cast<std::size_t>(std::clamp(
                                   int(((p - middle)[axis] / radius + 1) / 2 * grid), 0, grid - 1));
      return index;
    };
    std::vector<double> drawn(grid * grid * grid), met(drawn.size());
    Rays rays;
    std::mt19937_64 random(10);
    std::uniform_real_distribution<float> uniform;
    double crossings = 0, squares = 0;
    for (int i = 0; i < lines; ++i) {
      const Vec3d d = rays.unit();
      const auto frame = Frame<double>::around(d);
      const auto [x, y] = disk_point(uniform(random), uniform(random));
      const Vec3d o = middle + (frame.x * x + frame.y * y) * radius - d * (2 * radius);
      int here = 0;
      double after = 0;
      for (auto found = hit(shape, o, d, after); found; found = hit(shape, o, d, after)) {
        ++met[cell(found->position)];
        after = found->t;
        ++here;
      }
      crossings += here;
      squares += here * here;
    }
    const double mean = crossings / lines, error = std::sqrt((squares / lines - sqr(mean)) / lines);
    EXPECT_NEAR(surface->area() / (2 * pi * sqr(radius)), mean, 4 * error) << describe(shape);
    const double draws = crossings;
    for (int i = 0; i < draws; ++i) ++drawn[cell(surface->sample(uniform(random), uniform(random)).position)];
    // Crossings of one line are not independent of each other: at most four, so the statistic at most so
    // much.
    double chi2 = 0, cells = 0;
    for (std::size_t i = 0; i < met.size(); ++i) {
      if (met[i] + drawn[i] < 20) continue;
      chi2 += sqr(met[i] - drawn[i]) / (met[i] + drawn[i]);
      ++cells;
    }
    EXPECT_GT(cells, 3) << describe(shape);
    EXPECT_LT(chi2, cells + 6 * std::sqrt(2 * cells)) << describe(shape);
  }
}

TEST(Shapes, DisksAreHitWithinTheirRadius) {
  const Disk disk{{0.1, -0.2, 0.3}, {1, 2, -1}, 0.8};
  Rays rays;
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d o = rays.vector() * 1.5, d = rays.vector();
    const double t = dot(disk.center - o, disk.normal) / dot(d, disk.normal);
    const double off = length(o + d * t - disk.center);
    if (std::abs(off - disk.radius) < 1e-12) continue;
    const auto found = disk.hit(o, d, 0, infinity);
    ASSERT_EQ(found.has_value(), t > 0 && off < disk.radius);
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(length(found->position - (o + d * t)), 0, 1e-12);
    EXPECT_GT(dot(found->normal, disk.normal), 0);
  }
  EXPECT_GT(hits, 100);
}

}  // namespace UNNAMED
}  // namespace tyndall::shapes
