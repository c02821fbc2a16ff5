// Direct light along a marched ray and on surfaces (transport §3).
//
// Strategies are joint in (t, y). A: y on the light, t equi-angular about it. B: t by density, y on the
// light. C: t by density, direction by the phase function, meeting y. A and B are mixed sample by sample; C,
// the path's own continuation, is weighted against `light_samples` of them by the balance heuristic.
#pragma once

#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "render/march.h"
#include "render/render.h"
#include "render/surface.h"

namespace tyndall::render {

struct Worker;

// The lights with the probability of choosing each for one stretch of a ray (or a point: t0 = t1).
class LightChoice {
 public:
  void set(const compile::CompiledScene& world, const Vec3d& origin, const Vec3d& direction, double t0,
           double t1);
  bool empty() const { return total_ <= 0; }
  // The light for u in [0, 1); rescales u to be used again.
  std::uint32_t sample(float& u) const;
  double probability(std::uint32_t light) const { return weights_[light] / total_; }

 private:
  std::vector<double> weights_;
  double total_ = 0;
};

// A marched ray with what is needed to say with which density (t, y) would be drawn from it for direct light.
class LightStrategies {
 public:
  // Keeps references: the march must stay as it is.
  void set(const compile::CompiledScene& world, const March& march, const Rgb& throughput, Distance distance);
  bool empty() const { return !march_->scatters() || lights_.empty(); }

  // Adds the shadow ray of one sample (light, strategy, t, light u, light v in `point`) to the worker's
  // batch, its contribution multiplied by `weight`. `continues` tells whether strategy C competes, with
  // probability `volume_probability` of continuing in the volume; `samples` of these samples are taken.
  void sample(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight, bool continues,
              double volume_probability, int samples, Worker& worker);

  // Density [1/m/sr] with which `sample` draws the point at t of segment i and the direction from there to
  // `y` on the light's surface with this normal.
  double pdf(std::uint32_t light, std::uint32_t segment, double t, const Vec3d& direction, const Vec3d& y,
             const Vec3d& normal, Worker& worker) const;
  const DensityDistribution& density() const { return *density_; }

 private:
  const compile::CompiledScene* world_ = nullptr;
  const March* march_ = nullptr;
  std::optional<DensityDistribution> density_;
  LightChoice lights_;
  Rgb throughput_;
  Distance distance_ = Distance::mis;
};

// Adds the shadow ray of one light sample on a surface. Strategy C is here the surface's own sampling.
void sample_surface_light(const compile::CompiledScene& world, const SurfacePoint& surface,
                          const LightChoice& lights, const SobolPoint& point, std::uint32_t shadow_seed,
                          const Rgb& weight, bool continues, int samples, Worker& worker);

// Balance heuristic of `samples` draws with density p against one draw with density q: the weight of p.
inline double balance(double samples, double p, double q) {
  const double sum = samples * p + q;
  return sum > 0 ? samples * p / sum : 0.0;
}

}  // namespace tyndall::render
