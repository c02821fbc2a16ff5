// Distances to round solids against the distance to their profile, piece by piece.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "run.h"

namespace tyndall::eval {
namespace UNNAMED {

struct ProfilePoint {
  double r, y;
};

double to_segment(ProfilePoint p, ProfilePoint a, ProfilePoint b) {
  const double dr = b.r - a.r, dy = b.y - a.y, square = dr * dr + dy * dy;
  const double t = square > 0 ? std::clamp(((p.r - a.r) * dr + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0;
  return std::hypot(p.r - a.r - t * dr, p.y - a.y - t * dy);
}

// Of a cone of height 2 along y from -1, whose radius goes from a to b.
double to_cone(double a, double b, ProfilePoint p) {
  const ProfilePoint corners[] = {{0, -1}, {a, -1}, {b, 1}, {0, 1}};
  double distance = 1e9;
  for (std::size_t i = 0; i < 3; ++i)
    distance = std::min(distance, to_segment(p, corners[i], corners[i + 1]));
  const bool inside = std::fabs(p.y) < 1 && p.r < a + (b - a) * (p.y + 1) / 2;
  return inside ? -distance : distance;
}

TEST(Solids, ConesAndCylindersAreTheirProfiles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range(-3, 3);
  for (const auto& [a, b] : {std::pair{0.7, 0.7}, {1.5, 0.0}, {0.4, 1.1}, {0.0, 0.9}})
    for (int i = 0; i < 60; ++i) {
      const double x = range(random), y = range(random), z = range(random);
      const double expected = to_cone(a, b, {std::hypot(x, z), y});
      const std::string place = fmt::format("({}, {}, {}), (0, -1, 0), (0, 1, 0), {}", x, y, z, a);
      SceneText cone(fmt::format("let result = sd_cone({}, {})", place, b));
      EXPECT_NEAR(cone.scene().as_number(), expected, 1e-9) << place << ", " << b;
      if (a != b) continue;
      SceneText cylinder(fmt::format("let result = sd_cylinder({})", place));
      EXPECT_NEAR(cylinder.scene().as_number(), expected, 1e-9) << place;
    }
}

// Never steeper than distances are, and of the first order at the surface.
TEST(Solids, AnEllipsoidIsExactAtItsSurface) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> range(-1, 1);
  for (int i = 0; i < 60; ++i) {
    const Vec3d d = normalize(Vec3d{range(random), range(random), range(random) + 0.01});
    const Vec3d surface{1.5 * d.x, 0.5 * d.y, 0.8 * d.z};
    const Vec3d normal = normalize(Vec3d{d.x / 1.5, d.y / 0.5, d.z / 0.8});
    for (const double step : {-1e-3, 1e-3}) {
      const Vec3d p = surface + normal * step;
      SceneText text(fmt::format("let result = sd_ellipsoid(({}, {}, {}), (1.5, 0.5, 0.8))", p.x, p.y, p.z));
      EXPECT_NEAR(text.scene().as_number(), step, 2e-5);
    }
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::eval
