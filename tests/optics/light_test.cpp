// Laws of the lights: what is drawn follows the density that is told, the power given is the power that
// leaves, and a ray's reached parts are those that light reaches.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "optics/light_sampling.h"

namespace tyndall::optics {
namespace {

struct Case {
  std::string name;
  Light light;
};

// Every light that has a place, of power 7 W.
std::vector<Case> placed_lights() {
  const Rgb power(7.0f);
  std::vector<Case> list;
  list.push_back({"point", PointLight{{0.1, 0.2, -0.3}, power, {}}});
  for (const double angle : {5.0, 60.0, 90.0, 130.0})
    for (const double blend : {0.0, 0.4, 1.0})
      list.push_back({"spot " + std::to_string(angle) + " " + std::to_string(blend),
                      SpotLight{{0.1, 0, 0.2}, {1, 2, -0.5}, {angle * pi / 180}, blend, power, {}}});
  list.push_back({"sphere", SphereLight{{0.2, 0, 0.1}, 0.7, power, {}, true}});
  list.push_back({"quad", QuadLight{{0, 0.2, 0}, {0.3, 0, 0.5}, {0.8, 0.1, 0}, power, {}, true}});
  list.push_back({"disk", DiskLight{{0, 0.2, 0}, {1, 3, -2}, 0.6, power, {}, true}});
  return list;
}

// Where a ray meets the light's surface, and the normal there; written anew, apart from the renderer's
// queries.
struct Met {
  Vec3d y, normal;
};
std::optional<Met> meets(const Light& light, const Vec3d& x, const Vec3d& w) {
  if (const auto* s = std::get_if<SphereLight>(&light)) {
    const double b = dot(x - s->center, w), c = length_squared(x - s->center) - sqr(s->radius);
    if (b * b < c || b > 0) return {};
    const Vec3d y = x + w * (-b - std::sqrt(b * b - c));
    return Met{y, normalize(y - s->center)};
  }
  const auto* q = std::get_if<QuadLight>(&light);
  const auto* d = std::get_if<DiskLight>(&light);
  const Vec3d center = q ? q->center : d->center, normal = normalize(q ? cross(q->u, q->v) : d->normal);
  const double t = dot(center - x, normal) / dot(w, normal);
  if (!(t > 0)) return {};
  const Vec3d y = x + w * t, off = y - center;
  if (d) return length(off) < d->radius ? std::optional(Met{y, normal}) : std::nullopt;
  const double n = length(cross(q->u, q->v));
  if (std::abs(dot(cross(off, q->v), normal)) > n || std::abs(dot(cross(q->u, off), normal)) > n) return {};
  return Met{y, normal};
}

// Pearson's statistic of drawn directions in cells around the way to the light, against the integral of the
// density.
TEST(Lights, DrawWithTheDensityTheyTell) {
  constexpr int rows = 6, columns = 8, draws = 20000, fine = 250;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const Case& c : placed_lights()) {
    if (is_delta(c.light)) continue;
    for (const Vec3d x : {Vec3d(0.5, 3, -1.5), Vec3d(2, 1.2, -0.2), Vec3d(-0.9, 6, -3), Vec3d(30, 90, -60)}) {
      const bool square = std::holds_alternative<QuadLight>(c.light);
      const Vec3d middle = sample_pivot(c.light, square ? 0.5f : 0.0f, 0.5f)->position;
      const Frame<double> frame = Frame<double>::around(normalize(middle - x));
      // 1 - cos of a cone that holds the light: no point of it is farther than 1.5 from its middle.
      const double sine = std::min(1.0, 1.5 / length(middle - x)),
                   m_max = sine < 1 ? 1 - std::sqrt(1 - sine * sine) : 2;
      std::vector<double> expected(rows * columns), found(rows * columns);
      double inside = 0;
      for (int i = 0; i < rows * fine; ++i)
        for (int j = 0; j < columns * fine; ++j) {
          const double m = m_max * (i + 0.5) / (rows * fine), phi = 2 * pi * (j + 0.5) / (columns * fine);
          const double s = std::sqrt(m * (2 - m));
          const Vec3d w = frame.world({s * std::cos(phi), s * std::sin(phi), 1 - m});
          const auto met = meets(c.light, x, w);
          if (!met) continue;
          const double share =
              pdf_light(c.light, x, w, met->y, met->normal) * 2 * pi * m_max / (rows * columns * fine * fine);
          expected[static_cast<std::size_t>(i / fine * columns + j / fine)] += draws * share;
          inside += share;
        }
      EXPECT_NEAR(inside, 1, 0.002) << c.name;  // the edge of the light crosses cells
      for (int k = 0; k < draws; ++k) {
        const float u0 = uniform(random), u1 = uniform(random);
        const auto drawn = sample_light(c.light, x, *sample_pivot(c.light, u0, u1), u0, u1);
        ASSERT_TRUE(drawn) << c.name;
        const auto met = meets(c.light, x, drawn->direction);
        ASSERT_TRUE(met || std::holds_alternative<SphereLight>(c.light)) << c.name;
        if (met) {
          EXPECT_NEAR(pdf_light(c.light, x, drawn->direction, met->y, met->normal) / drawn->pdf_solid_angle,
                      1, 1e-9);
          EXPECT_NEAR(length(met->y - x) / drawn->distance, 1, 1e-6) << c.name;
        }
        const Vec3d local = frame.local(drawn->direction);
        const double m = length_squared(drawn->direction - frame.z) / 2, phi = std::atan2(local.y, local.x);
        const int row = std::min(rows - 1, static_cast<int>(m / m_max * rows));
        const int column = static_cast<int>(std::floor(phi / (2 * pi) * columns + columns)) % columns;
        found[static_cast<std::size_t>(row * columns + column)] += 1;
      }
      double chi2 = 0;
      int cells = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] < 10) continue;
        chi2 += sqr(found[i] - expected[i]) / expected[i];
        ++cells;
      }
      // Six standard deviations of the statistic above its mean.
      EXPECT_LT(chi2, cells + 6 * std::sqrt(2.0 * cells)) << c.name << " from " << x.y;
    }
  }
}

// The flux through a sphere around the light, from the samples that a scene's points would take.
TEST(Lights, EmitThePowerGiven) {
  constexpr int points = 60000;
  const double radius = 5, golden = pi * (3 - std::sqrt(5.0));
  for (const Case& c : placed_lights()) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<float> uniform(0, 1);
    double flux = 0;
    for (int i = 0; i < points; ++i) {
      const double z = 1 - (2 * i + 1.0) / points, r = std::sqrt(1 - z * z);
      const Vec3d outward{r * std::cos(golden * i), r * std::sin(golden * i), z};
      const float u0 = uniform(random), u1 = uniform(random);
      const Vec3d x = outward * radius;
      const auto drawn = sample_light(c.light, x, *sample_pivot(c.light, u0, u1), u0, u1);
      if (drawn)
        flux += drawn->radiance_over_pdf.x * -dot(drawn->direction, outward) * 4 * pi * sqr(radius) / points;
    }
    // A cone of 5 degrees holds 114 of the points; its rim is met by their spacing.
    EXPECT_NEAR(flux, 7, c.name.starts_with("spot 5") ? 0.35 : 0.07) << c.name;
  }
}

TEST(Lights, ReachThePartsTheyTell) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const Case& c : placed_lights()) {
    int reached_points = 0, dark_points = 0;
    for (int ray = 0; ray < 2000; ++ray) {
      const Vec3d origin{3 * uniform(random), 3 * uniform(random), 3 * uniform(random)};
      const Vec3d direction = normalize(Vec3d{uniform(random), uniform(random), uniform(random)});
      const double t_max = ray % 2 ? 4 : infinity;
      const ReachedParts reached = reached_parts(c.light, {}, origin, direction, t_max);
      double before = 0;
      for (int i = 0; i < reached.count; ++i) {
        EXPECT_LE(before, reached.parts[i].lo) << c.name;
        EXPECT_FALSE(reached.parts[i].empty()) << c.name;
        before = reached.parts[i].hi;
      }
      EXPECT_LE(before, t_max) << c.name;
      for (int k = 0; k < 20; ++k) {
        const double t = 4 * (k + 0.5) / 20;
        bool in_part = false, near_edge = false;
        for (int i = 0; i < reached.count; ++i) {
          in_part |= reached.parts[i].contains(t);
          near_edge |= std::abs(reached.parts[i].lo - t) < 1e-9 || std::abs(reached.parts[i].hi - t) < 1e-9;
        }
        const auto drawn =
            sample_light(c.light, origin + direction * t, *sample_pivot(c.light, 0.3f, 0.6f), 0.3f, 0.6f);
        const bool lit = drawn && !is_black(drawn->radiance_over_pdf);
        if (!near_edge) {
          EXPECT_EQ(lit, in_part) << c.name << " at " << t;
        }
        ++(in_part ? reached_points : dark_points);
      }
      // A light is not chosen for a ray that its cone misses.
      if (reached.count == 0 && std::holds_alternative<SpotLight>(c.light)) {
        EXPECT_EQ(importance(c.light, origin, direction, 0, t_max), 0) << c.name;
      }
    }
    EXPECT_GT(reached_points, 0) << c.name;
    EXPECT_EQ(dark_points > 0, c.name != "point") << c.name;
  }
}

// Rays through the apex of a cone, along its axis and across it.
TEST(Lights, ReachThroughTheApex) {
  const Light spot = SpotLight{{0, 0, 0}, {0, 0, -1}, {30 * pi / 180}, 0, Rgb(1), {}};
  ReachedParts reached = reached_parts(spot, {}, {0, 0, 2}, {0, 0, -1}, 10);
  ASSERT_EQ(reached.count, 1);
  EXPECT_EQ(reached.parts[0], (Intervald{2, 10}));
  reached = reached_parts(spot, {}, {0, 0, -3}, {0, 0, 1}, 10);
  ASSERT_EQ(reached.count, 1);
  EXPECT_EQ(reached.parts[0], (Intervald{0, 3}));
  EXPECT_EQ(reached_parts(spot, {}, {-1, 0, 0}, {1, 0, 0}, 10).count, 0);
  const Light wide = SpotLight{{0, 0, 0}, {0, 0, -1}, {150 * pi / 180}, 0, Rgb(1), {}};
  // Across the dark cone behind the light: lit before it and after it.
  reached = reached_parts(wide, {}, {-5, 0, 1}, {1, 0, 0}, 10);
  ASSERT_EQ(reached.count, 2);
  EXPECT_NEAR(reached.parts[0].hi, 5 - std::tan(30 * pi / 180), 1e-12);
  EXPECT_NEAR(reached.parts[1].lo, 5 + std::tan(30 * pi / 180), 1e-12);
}

// Full inside, falling without a jump, nothing at the rim.
TEST(Spots, FadeSmoothlyToTheRim) {
  const SpotCone spot = cone(SpotLight{{0, 0, 0}, {0, 0, -1}, {40 * pi / 180}, 0.5, {}, Rgb(2)});
  const auto share = [&](double degrees) {
    const double a = degrees * pi / 180;
    return spot.share({std::sin(a), 0, -std::cos(a)});
  };
  EXPECT_EQ(spot.intensity, Rgb(2));
  EXPECT_EQ(share(0), 1);
  EXPECT_EQ(share(19.99), 1);
  EXPECT_EQ(share(40.01), 0);
  for (double a = 20; a < 40; a += 0.5) {
    EXPECT_GE(share(a), share(a + 0.5));
    EXPECT_NEAR(share(a), share(a + 0.5), 0.08);
  }
}

}  // namespace
}  // namespace tyndall::optics
