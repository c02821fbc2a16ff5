// Product sampling of the distance to a light: samples follow the stated density.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "optics/light_sampling.h"
#include "render/distance.h"
#include "render/worker.h"
#include "support/scene_builder.h"

namespace tyndall::render {
namespace {

using support::SceneBuilder;

// Uneven fog, clear fog that overlaps it, a gap and a third; the ray runs from z = 0 down to -7.
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

std::vector<optics::Light> lights() {
  std::vector<optics::Light> list;
  for (const double x : {0.0, 1e-7, 1e-3, 0.4, 3.0, 1e5}) {
    optics::PointLight point;  // x = 0: on the ray's line, beyond the fog
    point.position = {x, 0, x == 0 ? -9.0 : -2.6};
    point.intensity = Rgb(1);
    list.emplace_back(point);
  }
  optics::SphereLight sphere;  // the ray runs through it
  sphere.center = {0.1, 0, -6};
  sphere.radius = 0.4;
  sphere.radiance = Rgb(1);
  list.emplace_back(sphere);
  optics::QuadLight quad;  // shines on a part of the ray
  quad.center = {0.5, 0, -2};
  quad.u = {0.1, 0, 0};
  quad.v = {0, 0.3, 0.2};
  quad.radiance = Rgb(1);
  list.emplace_back(quad);
  optics::SpotLight spot;
  spot.position = {1, 0, -2};
  spot.to = {0, 0, -2.5};
  spot.angle.radians = 0.3;
  spot.intensity = Rgb(1);
  list.emplace_back(spot);
  return list;
}

// The density integrates to one, and 200,000 samples fall into 60 cells as it says: χ² at a significance of
// 1e-6 (119 for 59 degrees of freedom) with a fixed seed. Every strategy that the command line offers.
TEST(DistanceMixture, SamplesFollowTheDensity) {
  for (const Distance distance : {Distance::mis, Distance::equiangular, Distance::product})
    for (const optics::Light& light : lights()) {
      const compile::CompiledScene w = compile::compile(fog().light(light).scene);
      Worker worker;
      March m;
      march(w, {{0, 0, 0}, {0, 0, -1}, 100}, compile::RayKind::camera, 77, worker, m);
      const Rgb throughput(0.3f, 1, 2);
      const DensityDistribution density(m, throughput);
      const auto pivot = optics::sample_pivot(light, 0.3f, 0.8f);
      PhaseMixture phase;
      phase.set(w, m, brightest_segment(m));
      const DistanceMixture mixture(w.lights[0], m, density, throughput, distance, pivot, phase, worker);
      ASSERT_TRUE(mixture.available());
      const std::string what = "strategy " + std::to_string(static_cast<int>(distance)) + ", light " +
                               std::to_string(light.index()) + " at x " + std::to_string(pivot->position.x);
      // Cells of equal probability would hide errors: equal widths, with finer ones about a near light.
      constexpr int cells = 60, draws = 200000, fine = 4000;
      std::vector<double> edges(cells + 1);
      for (int i = 0; i <= cells; ++i) edges[i] = 1 + 6.0 * i / cells;
      std::vector<double> expected(cells), found(cells);
      double total = 0;
      for (int i = 0; i < cells; ++i) {
        // Substituting z = -2.6 + D sinh(v) keeps the peak of the light 1e-7 m away within reach of the sum.
        const double scale = std::max(std::abs(pivot->position.x), 1e-8), c = -pivot->position.z;
        const double v0 = std::asinh((edges[i] - c) / scale), v1 = std::asinh((edges[i + 1] - c) / scale);
        for (int k = 0; k < fine; ++k) {
          const double v = v0 + (k + 0.5) / fine * (v1 - v0), t = c + scale * std::sinh(v);
          if (t > 4 && t < 5) continue;  // the gap
          expected[i] += mixture.pdf(m.place_at(t)) * scale * std::cosh(v) * (v1 - v0) / fine;
        }
        total += expected[i];
      }
      EXPECT_NEAR(total, 1, 2e-3) << what;
      for (std::uint32_t s = 0; s < draws; ++s) {
        const Sampler sampler(4, 0, 1, 2, s);
        const double t =
            mixture.sample(sampler.independent(0, 0), sampler.independent(1, 0), sampler.independent(2, 0)).t;
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

// Where light arrives at all, some is drawn: one density over another, both being of the same ray, is
// bounded.
TEST(DistanceMixture, ProductIsNeverFarBelowTheDensity) {
  for (const optics::Light& light : lights()) {
    const compile::CompiledScene w = compile::compile(fog().light(light).scene);
    Worker worker;
    March m;
    march(w, {{0, 0, 0}, {0, 0, -1}, 100}, compile::RayKind::camera, 5, worker, m);
    const DensityDistribution density(m, Rgb(1));
    PhaseMixture phase;
    phase.set(w, m, brightest_segment(m));
    const DistanceMixture mixture(w.lights[0], m, density, Rgb(1), Distance::product,
                                  optics::sample_pivot(light, 0.3f, 0.8f), phase, worker);
    for (double t = 1.001; t < 7; t += 0.01) {
      const MarchPlace at = m.place_at(t);
      EXPECT_GE(mixture.pdf(at), 0.04 * density.pdf(at)) << t;
    }
  }
}

}  // namespace
}  // namespace tyndall::render
