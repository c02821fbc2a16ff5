// Distances to a light: samples follow the stated density, by maps that are monotone and smooth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "render/distance/distance_mixture.h"
#include "render/march/ray_march.h"
#include "support/scene_builder.h"

namespace tyndall::render {
namespace UNNAMED {

using support::SceneBuilder;

// Heterogeneous fog, clear fog that overlaps it, a gap and a third; the ray runs from z = 0 down to -7.
SceneBuilder fog() {
  SceneBuilder b;
  b.step(0.3).orthographic({0, 0, 0}, {0, 0, -1}, 1);
  b.volume(scene::Box{{-1, -1, -3}, {1, 1, -1}},
           b.shader({Rgb(2, 0.5f, 0), Rgb(0.9f, 0.5f, 0), {}, support::hg(0.6f)},
                    [](const support::Point& p) { return p.z * 0.5f + 2.0f; }));
  b.volume(scene::Box{{-1, -1, -4}, {1, 1, -2}},
           b.constant({.sigma_t = Rgb(0.1f, 1, 3), .albedo = Rgb(1, 0.5f, 0.8f)}));
  b.volume(scene::Box{{-1, -1, -7}, {1, 1, -5}}, b.constant({.sigma_t = Rgb(0.2f, 3, 0.2f)}));
  return b;
}

// Fog of one kind, from z = -1 to -7.
SceneBuilder even_fog(float sigma_t, const scene::PhaseLobe& phase = support::isotropic()) {
  SceneBuilder b;
  b.orthographic({0, 0, 0}, {0, 0, -1}, 1);
  b.volume(scene::Box{{-1, -1, -7}, {1, 1, -1}},
           b.constant({.sigma_t = Rgb(sigma_t), .albedo = Rgb(0.9f), .phase = phase}));
  return b;
}

scene::Light lamp(const Vec3d& position) {
  scene::PointLight point;
  point.position = position;
  point.intensity = Rgb(1);
  return point;
}

std::vector<scene::Light> lights() {
  std::vector<scene::Light> list;
  for (const double x : {0.0, 1e-7, 1e-3, 0.4, 3.0, 1e5})  // x = 0: on the ray's line, beyond the fog
    list.push_back(lamp({x, 0, x == 0 ? -9.0 : -2.6}));
  // The ray runs through it.
  list.emplace_back(scene::AreaLight{scene::Sphere{{0.1, 0, -6}, 0.4}, {}, Rgb(1)});
  // Shines on a part of the ray.
  list.emplace_back(scene::AreaLight{scene::Quad{{0.5, 0, -2}, {0.1, 0, 0}, {0, 0.3, 0.2}}, {}, Rgb(1)});
  scene::SpotLight spot;
  spot.position = {1, 0, -2};
  spot.to = {0, 0, -2.5};
  spot.angle.radians = 0.3;
  spot.intensity = Rgb(1);
  list.emplace_back(spot);
  return list;
}

// The ray through a scene with one light, and a mixture that is prepared for both.
struct LitMarch {
  compile::CompiledScene world;
  Rgb throughput;
  ThreadContext thread;
  RayMarcher marcher;
  March march;
  std::optional<DensityDistribution> density;
  std::optional<PhaseMixture> phase;
  std::optional<optics::Pivot> pivot;
  DistanceMixture mixture;

  LitMarch(SceneBuilder scene, const scene::Light& light, const Rgb& carried = Rgb(1),
           std::uint32_t seed = 77)
      : world(compile::compile(scene.light(light).scene)), throughput(carried) {
    marcher.march(world, {{{0, 0, 0}, {0, 0, -1}, 100}, compile::RayKind::camera, seed, &march}, thread);
    density.emplace(march, throughput);
    if (march.scatters()) phase.emplace(world, march, brightest_segment(march));
    pivot = world.lights[0].sample_pivot(0.3f, 0.8f);
  }
  bool prepare(Distance distance) {
    return mixture.prepare(distance,
                           {world.lights[0], march, throughput, *density, pivot, phase ? &*phase : nullptr});
  }
  double squared_distance(double t) const {
    return sqr(pivot->position.x) + sqr(pivot->position.y) + sqr(pivot->position.z + t);
  }
  // What is scattered towards the camera of a light that falls off with the inverse square alone.
  double known(const MarchPlace& at) const {
    return luminance(throughput * march.sigma_s_at(at.segment) * Rgb(at.transmittance)) /
           squared_distance(at.t);
  }
  // Calls visit(t, dt) for small parts of [lo, hi]; substituting z = c + D sinh(v) keeps the peak of a light
  // 1e-7 m away within reach of a sum.
  template <class Visit>
  void each_part(double lo, double hi, int count, Visit&& visit) const {
    const double scale = std::max(std::abs(pivot->position.x), 1e-8), c = -pivot->position.z;
    const double v0 = std::asinh((lo - c) / scale), v1 = std::asinh((hi - c) / scale);
    for (int k = 0; k < count; ++k) {
      const double v = v0 + (k + 0.5) / count * (v1 - v0);
      visit(c + scale * std::sinh(v), scale * std::cosh(v) * (v1 - v0) / count);
    }
  }
};

std::string named(const DistanceInfo& info, const scene::Light& light, const LitMarch& lit) {
  return std::string(info.name) + ", light " + std::to_string(light.index()) + " at x " +
         std::to_string(lit.pivot->position.x);
}

// The density integrates to one, and 100,000 samples fall into 60 cells as it says: χ² at a significance of
// 1e-6 (119 for 59 degrees of freedom) with a fixed seed. Every strategy that the command line offers.
TEST(DistanceMixture, SamplesFollowTheDensity) {
  for (const DistanceInfo& info : distance_infos)
    for (const scene::Light& light : lights()) {
      LitMarch lit(fog(), light, Rgb(0.3f, 1, 2));
      ASSERT_TRUE(lit.prepare(info.distance));
      const std::string what = named(info, light, lit);
      // Cells of equal probability would hide errors: equal widths, with finer ones about a near light.
      constexpr int cells = 60, draws = 100000, fine = 1000;
      std::vector<double> edges(cells + 1);
      for (int i = 0; i <= cells; ++i) edges[i] = 1 + 6.0 * i / cells;
      std::vector<double> expected(cells), found(cells);
      double total = 0;
      for (int i = 0; i < cells; ++i) {
        lit.each_part(edges[i], edges[i + 1], fine, [&](double t, double dt) {
          if (t < 4 || t > 5) expected[i] += lit.mixture.pdf(lit.march.place_at(t)) * dt;  // but for the gap
        });
        total += expected[i];
      }
      EXPECT_NEAR(total, 1, 2e-3) << what;
      for (std::uint32_t s = 0; s < draws; ++s) {
        const double t = lit.mixture.sample(Sampler(4, 0, 1, 2, s).independent(0, 0)).t;
        const auto after = std::upper_bound(edges.begin(), edges.end() - 1, t);
        ++found[static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - edges.begin() - 1, 0))];
      }
      double chi_squared = 0;
      for (int i = 0; i < cells; ++i) {
        if (expected[i] * draws < 5) continue;
        chi_squared += sqr(found[i] - expected[i] * draws) / (expected[i] * draws);
      }
      EXPECT_LT(chi_squared, 119) << what;
    }
}

// The distance never decreases with the number, and inverts the distribution: the error allowed is the
// rounding of t.
TEST(DistanceMixture, MapIsMonotoneAndContinuous) {
  for (const DistanceInfo& info : distance_infos)
    for (const scene::Light& light : lights()) {
      LitMarch lit(fog(), light, Rgb(0.3f, 1, 2));
      ASSERT_TRUE(lit.prepare(info.distance));
      constexpr int count = 1 << 13;
      double before = 0;
      for (int k = 0; k < count; ++k) {
        const float u = (static_cast<float>(k) + 0.5f) / count;
        const MarchPlace at = lit.mixture.sample(u);
        ASSERT_GE(at.t, before) << named(info, light, lit) << ", u " << u;
        const double first = lit.march.t0[at.segment], last = first + lit.march.dt[at.segment];
        ASSERT_TRUE(first <= at.t && at.t <= last) << named(info, light, lit) << ", u " << u;
        ASSERT_NEAR(lit.mixture.cdf(at), u, 1e-9 + 4e-16 * at.t * lit.mixture.pdf(at))
            << named(info, light, lit) << ", u " << u << ", t " << at.t;
        before = at.t;
      }
    }
}

// In even fog the density does not jump from cell to cell: the map has a continuous derivative. From number
// to number the density's logarithm changes no more than it does before or after.
TEST(DistanceMixture, MapIsSmoothInEvenFog) {
  for (const DistanceInfo& info : distance_infos)
    for (const double x : {0.2, 1.0, 10.0}) {
      LitMarch lit(even_fog(0.5f, support::hg(0.6f)), lamp({x, 0.1, -3}));
      ASSERT_TRUE(lit.prepare(info.distance));
      constexpr int count = 1 << 14;
      std::vector<double> changes(count);
      double before = lit.mixture.pdf(lit.mixture.sample(0));
      for (int k = 0; k < count; ++k) {
        const double pdf = lit.mixture.pdf(lit.mixture.sample((static_cast<float>(k) + 0.5f) / count));
        changes[k] = std::abs(std::log(pdf / before));
        before = pdf;
      }
      for (int k = 1; k + 1 < count; ++k)
        ASSERT_LE(changes[k], 1e-3 + 3 * std::max(changes[k - 1], changes[k + 1]))
            << info.name << ", lamp at " << x << ", number " << k;
    }
}

// Nothing that product sampling guesses at can make a sample too heavy: where light arrives by the inverse
// square, at least a 25th of the density that would follow it alone is there.
TEST(DistanceMixture, ProductHasBoundedWeights) {
  for (const scene::Light& light : lights()) {
    LitMarch lit(fog(), light);
    ASSERT_TRUE(lit.prepare(Distance::product));
    std::vector<Intervald> reached;
    lit_intervals(lit.world.lights[0], *lit.pivot, lit.march, nullptr, reached);
    double all = 0;
    for (const Intervald& interval : reached)
      lit.each_part(interval.lo, interval.hi, 40000,
                    [&](double t, double dt) { all += lit.known(lit.march.place_at(t)) * dt; });
    for (const Intervald& interval : reached)
      lit.each_part(interval.lo, interval.hi, 1000, [&](double t, double) {
        const MarchPlace at = lit.march.place_at(t);
        EXPECT_GE(lit.mixture.pdf(at), 0.04 * lit.known(at) / all) << named(distance_infos[3], light, lit);
      });
  }
}

// Variance of the mean of `count` Sobol' points, relative to the mean's square, over 256 scramblings: light
// of a lamp in even fog of isotropic scattering, whose transmittance is e^(-sigma_t r).
double relative_variance(LitMarch& lit, double sigma_t, std::uint32_t count) {
  constexpr std::uint64_t scramblings = 256;
  double sum = 0, sum_of_squares = 0;
  for (std::uint64_t scrambling = 0; scrambling < scramblings; ++scrambling) {
    double mean = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const MarchPlace at = lit.mixture.sample(sobol_point(i, scrambling)[2]);
      mean += lit.known(at) * std::exp(-sigma_t * std::sqrt(lit.squared_distance(at.t))) /
              (lit.mixture.pdf(at) * count);
    }
    sum += mean, sum_of_squares += sqr(mean);
  }
  return sum_of_squares * scramblings / sqr(sum) - 1;
}

// 16 times the points divide the variance by 64 at least, where independent numbers divide it by 16. Product
// sampling leaves the least.
TEST(DistanceMixture, LowDiscrepancyKeepsItsRate) {
  for (const double x : {0.1, 0.5, 2.0}) {
    LitMarch lit(even_fog(0.2f), lamp({x, 0, -3}));
    std::array<double, distance_infos.size()> few{};
    for (std::size_t k = 0; k < distance_infos.size(); ++k) {
      ASSERT_TRUE(lit.prepare(distance_infos[k].distance));
      few[k] = relative_variance(lit, 0.2, 16);
      EXPECT_LT(relative_variance(lit, 0.2, 256), few[k] / 64) << distance_infos[k].name << ", lamp at " << x;
    }
    EXPECT_LE(few[3], 1.1 * *std::min_element(few.begin(), few.end())) << x;
  }
}

// Sums over one equidistant rule of numbers: of what every strategy finds, against the density's own with
// many more of them.
void expect_one_sum(LitMarch& lit, const std::string& what, bool opaque = false) {
  const auto sum = [&](Distance distance, int count) {
    EXPECT_TRUE(lit.prepare(distance)) << what;
    double total = 0, before = 0;
    for (int k = 0; k < count; ++k) {
      const MarchPlace at = lit.mixture.sample((static_cast<float>(k) + 0.5f) / static_cast<float>(count));
      const double pdf = lit.mixture.pdf(at);
      EXPECT_TRUE(std::isfinite(at.t) && at.t >= before && std::isfinite(pdf)) << what << ", t " << at.t;
      before = at.t;
      if (pdf > 0) total += lit.known(at) / pdf / count;
    }
    return total;
  };
  const double truth = sum(Distance::density, 1 << 18);
  // What knows nothing of the fog does not find its first millimetre.
  for (const DistanceInfo& info : distance_infos) {
    if (opaque && info.distance == Distance::equiangular) continue;
    EXPECT_NEAR(sum(info.distance, 1 << 14), truth, 2e-3 * truth) << what << ", " << info.name;
  }
}

TEST(DistanceMixture, Extremes) {
  for (const float sigma_t : {1e-30f, 1e-6f, 1.0f, 1e3f, 1e6f})
    for (const double x : {1.0, 1e4, 1e9}) {
      LitMarch lit(even_fog(sigma_t), lamp({x, 0, -3}));
      expect_one_sum(lit, "sigma_t " + std::to_string(sigma_t) + ", lamp at " + std::to_string(x),
                     sigma_t > 100);
    }
  // What absorbs alone, between; what is hardly there; and nothing of one channel.
  SceneBuilder black = even_fog(0.3f);
  black.volume(scene::Box{{-1, -1, -9}, {1, 1, -8}}, black.constant({.sigma_t = Rgb(2), .albedo = Rgb(0)}));
  black.volume(scene::Box{{-1, -1, -10}, {1, 1, -10 + 1e-12}}, black.constant({.sigma_t = Rgb(1)}));
  black.volume(scene::Box{{-1, -1, -12}, {1, 1, -11}},
               black.constant({.sigma_t = Rgb(1, 0, 50), .albedo = Rgb(1, 0, 0.5f)}));
  LitMarch lit(black, lamp({0.5, 0, -9}));
  expect_one_sum(lit, "black between");
  SceneBuilder only_black;
  only_black.volume(scene::Box{{-1, -1, -9}, {1, 1, -8}},
                    only_black.constant({.sigma_t = Rgb(2), .albedo = Rgb(0)}));
  LitMarch none(only_black, lamp({0.5, 0, -9}));
  for (const DistanceInfo& info : distance_infos) EXPECT_FALSE(none.prepare(info.distance)) << info.name;
  // With the lamp on the ray, within the fog, the density stands in for what cannot be had.
  LitMarch on_ray(even_fog(0.5f), lamp({0, 0, -3}));
  for (const DistanceInfo& info : distance_infos) {
    ASSERT_TRUE(on_ray.prepare(info.distance)) << info.name;
    const MarchPlace at = on_ray.mixture.sample(0.3f);
    EXPECT_DOUBLE_EQ(on_ray.mixture.pdf(at), on_ray.density->pdf(at)) << info.name;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
