// Laws of environment pictures: where a direction looks, and that directions are drawn as told.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/numerics.h"
#include "optics/sky.h"

namespace tyndall::optics {
namespace UNNAMED {

struct Picture {
  SkyRadiance radiance;
  Transform world_from_picture{};
  Rgb radiance_in(const Vec3d& direction) const {
    return sky_radiance(radiance, world_from_picture, direction);
  }
  Sky sky() const { return {radiance, world_from_picture}; }
};

Picture sky_of(int width, int height, const std::function<Rgb(int x, int y)>& texel) {
  Picture picture;
  picture.radiance.color = Rgb(1);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> texels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) texels.push_back(texel(x, y)[c]);
    picture.radiance.picture[c] = make_plane("sky", width, height, std::move(texels));
  }
  return picture;
}

// A dim pattern with suns of a few texels, one of them at the seam, and black regions.
Picture sunny(int width, int height) {
  return sky_of(width, height, [&](int x, int y) {
    const int size = 1 + width / 30;  // of the suns, across
    if (x < size && y == height / 2) return Rgb(300, 200, 100);
    if (x >= width / 3 && x < width / 3 + size && y == height - 2) return Rgb(1000);
    if (y < height / 4) return Rgb(0);
    return Rgb(0.2f + 0.1f * static_cast<float>(x % 5), 0.3f, -0.5f);
  });
}

// The middle of the picture is -z, its top +y, its right three quarters +x; rotations turn it about y.
TEST(Sky, ShowsItsPictureTheRightWayRound) {
  Picture picture =
      sky_of(8, 4, [](int x, int y) { return Rgb(static_cast<float>(x), static_cast<float>(y), 1); });
  EXPECT_NEAR(picture.radiance_in({0, 0, -1}).x, 3.5, 1e-5);
  EXPECT_NEAR(picture.radiance_in({0, 0, -1}).y, 1.5, 1e-5);
  EXPECT_NEAR(picture.radiance_in({1, 0, 0}).x, 5.5, 1e-5);
  EXPECT_NEAR(picture.radiance_in({-1, 0, 0}).x, 1.5, 1e-5);
  EXPECT_NEAR(picture.radiance_in({0, 1, 0}).y, 3, 1e-5);
  EXPECT_NEAR(picture.radiance_in({0, -1, 0}).y, 0, 1e-5);
  picture.world_from_picture = Transform::rotate({0, 1, 0}, pi / 2);  // what was at -z is at -x
  EXPECT_NEAR(picture.radiance_in({-1, 0, 0}).x, 3.5, 1e-5);
  picture.world_from_picture = Transform::rotate({1, 0, 0}, pi / 2);  // then -z goes to +y
  EXPECT_NEAR(picture.radiance_in({0, 1, 0}).x, 3.5, 1e-5);
}

// Pearson's statistic over cells of equal solid angle that have nothing to do with the picture's own.
TEST(Sky, DrawsWithTheDensityItTells) {
  for (const auto& [width, height] : {std::pair{16, 8}, {37, 19}, {2101, 9}}) {
    Picture picture = sunny(width, height);
    picture.world_from_picture = Transform::rotate({1, 2, 0}, 0.7) * Transform::rotate({0, 1, 0}, 1);
    const Sky sky = picture.sky();
    constexpr int rows = 12, columns = 20, fine = 60, draws = 40000;
    std::vector<double> expected(rows * columns), found(rows * columns);
    double whole = 0, radiance = 0;
    for (int i = 0; i < rows * fine; ++i)
      for (int j = 0; j < columns * fine; ++j) {
        const double z = 1 - 2 * (i + 0.5) / (rows * fine), phi = 2 * pi * (j + 0.5) / (columns * fine);
        const double r = std::sqrt(1 - z * z), solid_angle = 4 * pi / (rows * fine * columns * fine);
        const Vec3d w{r * std::cos(phi), r * std::sin(phi), z};
        const double share = sky.pdf(w) * solid_angle;
        expected[static_cast<std::size_t>(i / fine * columns + j / fine)] += draws * share;
        whole += share;
        const Rgb l = picture.radiance_in(w);
        radiance += (double{l.x} + l.y + l.z) / 3 * solid_angle;
      }
    EXPECT_NEAR(whole, 1, 0.01);
    EXPECT_NEAR(radiance / sky.total(), 1, 0.02) << width;
    std::mt19937_64 random(4);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (int k = 0; k < draws; ++k) {
      const Sky::Drawn drawn = sky.sample(uniform(random), uniform(random));
      EXPECT_NEAR(length(drawn.direction), 1, 1e-12);
      EXPECT_NEAR(sky.pdf(drawn.direction) / drawn.pdf_solid_angle, 1, 1e-6);
      const double phi = std::atan2(drawn.direction.y, drawn.direction.x);
      const int row = std::clamp(static_cast<int>((1 - drawn.direction.z) / 2 * rows), 0, rows - 1);
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
    // Six standard deviations above the mean, and what the grid's own error in `expected` adds.
    EXPECT_LT(chi2, cells + 6 * std::sqrt(2.0 * cells) + 0.02 * draws / cells) << width;
  }
}

// The mean of radiance over density is the integral of the radiance, without noise where the picture is
// smooth.
TEST(Sky, SamplesGiveItsIrradiance) {
  const Picture picture = sunny(64, 32);
  const Sky sky = picture.sky();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  double sum = 0;
  constexpr int draws = 100000;
  for (int k = 0; k < draws; ++k) {
    const Sky::Drawn drawn = sky.sample(uniform(random), uniform(random));
    const Rgb l = picture.radiance_in(drawn.direction);
    sum += (l.x + l.y + l.z) / (3 * drawn.pdf_solid_angle);
  }
  EXPECT_NEAR(sum / draws / sky.total(), 1, 0.01);
}

}  // namespace
}  // namespace tyndall::optics
