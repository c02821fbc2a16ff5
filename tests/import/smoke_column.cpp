// The smoke of the gallery: a column that rises, curls and spreads, and the heat at its foot.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/vec.h"
#include "fixtures.h"

namespace tyndall::import {

namespace {

// Gradient noise of a lattice of whole coordinates, about in [-1, 1].
double noise(const Vec3d& p, std::uint32_t seed) {
  const auto cell = [](double x) { return static_cast<std::int32_t>(std::floor(x)); };
  const std::int32_t i = cell(p.x), j = cell(p.y), k = cell(p.z);
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const std::int32_t x = i + (corner & 1), y = j + (corner >> 1 & 1), z = k + (corner >> 2);
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(y) * 0xd8163841u ^
                      static_cast<std::uint32_t>(z) * 0xcb1ab31fu ^ seed * 0x9e3779b9u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    h ^= h >> 15;
    const auto slope = [&](int shift) { return static_cast<double>(h >> shift & 1023) / 511.5 - 1; };
    const Vec3d d{p.x - x, p.y - y, p.z - z};
    const double weight = fade(1 - std::fabs(d.x)) * fade(1 - std::fabs(d.y)) * fade(1 - std::fabs(d.z));
    sum += weight * (slope(0) * d.x + slope(10) * d.y + slope(20) * d.z);
  }
  return 1.5 * sum;
}

Vec3d noises(const Vec3d& p) { return {noise(p, 11), noise(p, 12), noise(p, 13)}; }

// Round tops and sharp folds, as of what boils: 0 in the folds.
double billows(const Vec3d& p, int octaves) {
  double sum = 0, weight = 1, all = 0, scale = 1;
  for (int octave = 0; octave < octaves; ++octave, weight *= 0.55, scale *= 2.07) {
    sum += weight * std::fabs(noise(p * scale, 20 + static_cast<std::uint32_t>(octave)));
    all += weight;
  }
  return sum / all;
}

double smooth(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

constexpr double voxel_size = 0.03, height = 3.6;

// What is at p [m]: density, and how near it is to the middle of the column.
struct Smoke {
  double density, core;
};
Smoke smoke_at(const Vec3d& p) {
  const double h = std::clamp(p.y / height, 0.0, 1.0);
  // The column leans, and is wound the more the higher it is.
  const Vec3d lean{0.42 * h * h + 0.10 * h * std::sin(5.5 * h + 0.6), 0, 0.12 * h * std::cos(4.2 * h)};
  const Vec3d turned = p - lean + noises(p * 1.15 + Vec3d{0, -0.7, 3}) * (0.34 * std::pow(h, 0.8)) +
                       noises(p * 3.1) * (0.09 * std::sqrt(h));
  const double radius = 0.07 + 0.40 * std::pow(h, 0.9);
  const double across = std::hypot(turned.x, turned.z) / radius;
  const double folds = billows(turned * 3.4 + Vec3d{0, -1.4 * p.y, 0} * 0.35, 5);
  const double shape = 1 - across * across + 1.5 * (folds - 0.22);
  const double ends = smooth(0, 0.035, h) * smooth(1, 0.72, h + 0.25 * (folds - 0.2));
  return {smooth(0.0, 0.75, shape) * ends * (1.15 - 0.6 * h), std::max(0.0, 1 - across)};
}

}  // namespace

std::vector<FixtureGrid> smoke_column() {
  FixtureGrid density;
  density.type = GridType::half;
  density.sparse = true;
  density.first = {-30, 0, -30};
  density.last = {44, 121, 36};
  density.local_from_index = Transform::scale({voxel_size, voxel_size, voxel_size});
  const auto place = [](int i, int j, int k) {
    return Vec3d{voxel_size * i, voxel_size * j, voxel_size * k};
  };
  // Few steps, so that the file stays small.
  density.value = [=](int i, int j, int k) {
    return std::round(96 * std::clamp(smoke_at(place(i, j, k)).density, 0.0, 1.0)) / 96;
  };
  FixtureGrid heat = density;
  heat.name = "heat";
  heat.last = {20, 40, 20};
  heat.first = {-20, 0, -20};
  heat.value = [=](int i, int j, int k) {
    const Smoke smoke = smoke_at(place(i, j, k));
    const double low = std::exp(-2.6 * voxel_size * j);
    return std::round(64 * std::clamp(smoke.density * smoke.core * low * 1.6, 0.0, 1.0)) / 64;
  };
  return {density, heat};
}

}  // namespace tyndall::import
