// Direct light along a marched ray and on surfaces (transport §3).
//
// Strategies are joint in (t, y). A: y on the light, t equi-angular about it. B: t by density, y on the
// light. C: t by density, direction by the phase function, meeting y. A and B are mixed sample by sample; C,
// the path's own continuation, is weighted against `light_samples` of them by the balance heuristic.
#pragma once

#include <optional>
#include <span>

#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "optics/light_sampling.h"
#include "render/flight.h"
#include "render/higher_orders.h"
#include "render/light_choice.h"
#include "render/march.h"
#include "render/render.h"
#include "render/surface.h"
#include "render/transmittance.h"

namespace tyndall::render {

struct Worker;

// A ray with what is needed to say with which density (t, y) would be drawn from it for direct light.
class LightStrategies {
 public:
  // Keeps references: the march must stay as it is, but for its pool, which need not outlive this call for
  // what `pdf` asks. `orders` of scattering are added to the first; none where paths are followed further.
  void set(const compile::CompiledScene& world, const March& march, const Rgb& throughput, Method method,
           Distance distance, std::span<const ScatteringOrder> orders);
  bool empty() const { return !march_->scatters() || lights_.empty(); }

  // Adds the shadow rays of one sample (light, strategy, t, light u, light v in `point`) to the worker's
  // batch, their contribution multiplied by `weight`. `continues` tells whether strategy C competes, with
  // probability `volume_probability` of continuing in the volume; `samples` of these samples are taken.
  // Of distant lights only `share_of_distant` counts; with `distant_alone` no others do, nor higher orders.
  void sample(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight, bool continues,
              double volume_probability, int samples, Worker& worker);
  void set_distant(float share, bool alone) {
    share_of_distant_ = share;
    distant_alone_ = alone;
  }

  // Density [1/m/sr] with which `sample` draws the point at t of segment i and the direction from there to
  // `y` on the light's surface with this normal.
  double pdf(std::uint32_t light, std::uint32_t segment, double t, const Vec3d& direction, const Vec3d& y,
             const Vec3d& normal, Worker& worker) const;
  const LightChoice& lights() const { return lights_; }
  const DensityDistribution& density() const { return *density_; }

  // Of methods that fly (flight_light.cpp): `aim` before the flight chooses a light and the point of the ray,
  // `sample_aimed` after it adds the shadow ray from there; `sample` takes light where the flight collided.
  void aim(const SobolPoint& point, Flight& flight, Worker& worker);
  void sample_aimed(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight, bool continues,
                    Worker& worker);

 private:
  // A light, and how it is seen from the ray.
  struct Aim {
    std::uint32_t light = 0;
    std::optional<optics::Pivot> pivot;
    double choice = 0;  // probability of the light
  };
  Aim choose(const SobolPoint& point, float& u_rest) const;
  bool aims() const { return method_ == Method::tracking && distance_ != Distance::density; }
  // Density of aiming at t for the light through this pivot, and that of taking it at a collision.
  struct FlightDensities {
    double aimed = 0, collision = 0;
  };
  FlightDensities flight_densities(const Aim& aim, double t, double collision, Worker& worker) const;
  void sample_collision(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight, bool continues,
                        Worker& worker);
  // One more ray from the point at t, for one of the strategies of a flight.
  void add_flight_ray(const Aim& aim, const SobolPoint& point, double t, const Rgb& weight,
                      double own_density, const FlightDensities& densities, double collision, bool continues,
                      std::uint32_t shadow_seed, Worker& worker);
  void sample_steps(const SobolPoint& point, std::uint32_t shadow_seed, const Rgb& weight, bool continues,
                    double volume_probability, Worker& worker);
  double step_at(std::uint32_t segment) const;
  // Light drawn at x, in a segment. `carried` to the camera but for the phase function; `share` is the MIS
  // weight, `share_of_higher` that without strategy C, which brings the first order alone.
  struct Arrival {
    const optics::LightSample& drawn;
    std::uint32_t light = 0;
    Vec3d x;
    std::uint32_t segment = 0;
    Rgb carried;
    double share = 1, share_of_higher = 1;
  };
  // Adds its shadow ray. The worker's phase is that of the segment.
  void add_ray(const Arrival& arrival, std::uint32_t shadow_seed, Worker& worker) const;

  const compile::CompiledScene* world_ = nullptr;
  const March* march_ = nullptr;
  std::optional<DensityDistribution> density_;
  LightChoice lights_;
  PhaseMixture typical_phase_;  // of the product
  Rgb throughput_;
  Method method_ = Method::decoupled;
  Distance distance_ = Distance::mis;
  std::span<const ScatteringOrder> orders_;
  float share_of_distant_ = 1;
  bool distant_alone_ = false;
  const Flight* flight_ = nullptr;
};

// The shadow ray from a point to what was drawn of a light.
ShadowRay shadow_ray(const compile::CompiledScene& world, const Vec3d& from, double time,
                     const optics::LightSample& light, std::uint32_t index, const Rgb& contribution,
                     std::uint32_t seed);

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
