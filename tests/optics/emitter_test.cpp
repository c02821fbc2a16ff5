// Laws of emitters: points are drawn as their density tells, and the power given leaves them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "optics/emitter.h"

namespace tyndall::optics {
namespace UNNAMED {

const Transform skewed{{1, 0.3, 0}, {-0.2, 2, 0.1}, {0, 0.4, -0.5}, {3, 1, -2}};

EmitterTriangles tetrahedron() {
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1};
  return {{{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}, {a, a, b}}, {}};
}

struct Case {
  std::string name;
  EmitterSurface surface;
};
std::vector<Case> cases() {
  return {{"triangles", tetrahedron()},
          {"sphere", shapes::Sphere{{0.5, 0, 0}, 0.7}},
          {"disk", shapes::Disk{{0, 1, 0}, normalize(Vec3d(1, 2, 0)), 0.6}},
          {"cylinder", shapes::Cylinder{{0, 0, 0}, {0.4, 1, 0}, 0.3}},
          {"cone", shapes::Cone{{0, 0, 0}, {0.4, 1, 0}, 0.5, 0.1}},
          {"torus", shapes::Torus{{0.1, 0, 0}, {0.4, 1, 0}, 0.5, 0.3}}};
}

// The area of the part of a small ball's neighbourhood is what 1/pdf says: the mean of 1/pdf over samples is
// the whole area, for maps that keep shapes exactly, and each sample's own density holds under any map.
TEST(Emitters, AreDrawnOverTheirWholeArea) {
  for (const Case& c : cases()) {
    for (const bool keeps_shape : {true, false}) {
      const Transform placed =
          keeps_shape ? Transform{Vec3d(0, 2, 0), Vec3d(-2, 0, 0), Vec3d(0, 0, -2), {1, 2, 3}} : skewed;
      const Emitter emitter(c.surface, placed);
      std::mt19937_64 random(6);
      std::uniform_real_distribution<float> uniform(0, 1);
      double area = 0;
      Vec3d flux;
      constexpr int draws = 20000;
      for (int i = 0; i < draws; ++i) {
        const shapes::SurfacePoint p = emitter.sample(uniform(random), uniform(random));
        EXPECT_NEAR(length(p.normal), 1, 1e-9);
        EXPECT_LE(length(p.position - emitter.center()), emitter.radius() * (1 + 1e-9)) << c.name;
        area += 1 / emitter.pdf_area(p.normal) / draws;
        flux += p.normal / (emitter.pdf_area(p.normal) * draws);
      }
      if (keeps_shape || c.name == "triangles") {
        EXPECT_NEAR(area / emitter.area(), 1, 1e-6) << c.name;
      }
      // The area vectors of a closed surface sum to nothing, however it is stretched.
      if (c.name != "disk") {
        EXPECT_LT(length(flux), 0.05 * area) << c.name << (keeps_shape ? "" : " skewed");
      }
    }
  }
}

// A stretched sphere: the density times the element of area, over cells of the sphere it is the image of.
TEST(Emitters, StretchedSpheresFollowTheirDensity) {
  const Emitter emitter(shapes::Sphere{{0, 0, 0}, 1}, skewed);
  constexpr int rows = 6, columns = 10, draws = 30000;
  std::vector<double> found(rows * columns), expected(rows * columns);
  const Transform back = *skewed.inverse();
  std::mt19937_64 random(7);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int i = 0; i < draws; ++i) {
    const Vec3d o = back.point(emitter.sample(uniform(random), uniform(random)).position);
    const int row = std::clamp(static_cast<int>((o.z + 1) / 2 * rows), 0, rows - 1);
    const int column =
        static_cast<int>(std::floor(std::atan2(o.y, o.x) / (2 * pi) * columns + columns)) % columns;
    found[static_cast<std::size_t>(row * columns + column)] += 1;
  }
  constexpr int fine = 60;
  for (int i = 0; i < rows * fine; ++i)
    for (int j = 0; j < columns * fine; ++j) {
      const auto at = [&](double di, double dj) {
        const double z = 2 * (i + di) / (rows * fine) - 1, phi = 2 * pi * (j + dj) / (columns * fine);
        const double r = std::sqrt(std::max(0.0, 1 - z * z));
        return skewed.point({r * std::cos(phi), r * std::sin(phi), z});
      };
      // The element's two triangles in the world.
      const Vec3d a = at(0, 0), b = at(0, 1), c = at(1, 1), d = at(1, 0);
      const Vec3d n1 = cross(b - a, c - a), n2 = cross(c - a, d - a);
      for (const Vec3d& n : {n1, n2})
        if (length(n) > 0)
          expected[static_cast<std::size_t>(i / fine * columns + j / fine)] +=
              draws * emitter.pdf_area(normalize(n)) * length(n) / 2;
    }
  double chi2 = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) chi2 += sqr(found[i] - expected[i]) / expected[i];
  // Six standard deviations of the statistic above its mean.
  EXPECT_LT(chi2, rows * columns + 6 * std::sqrt(2.0 * rows * columns));
}

}  // namespace
}  // namespace tyndall::optics
