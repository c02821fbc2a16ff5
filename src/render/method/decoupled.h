// Decoupled ray marching (Kulla and Fajardo, EGSR 2012): the whole march of a ray is kept, and light is taken
// anywhere on it.
//
// Strategies for direct light are joint in (t, y). A: y on the light, t by a strategy that aims at it. B: t
// by density, y on the light. C: t by density, direction by the phase function, meeting y. A and B are mixed
// sample by sample (distance_mixture.h); C, the path's own continuation, is weighted against the light
// samples by the balance heuristic.
#pragma once

#include <string_view>

#include "render/distance/distance_mixture.h"
#include "render/method/medium_ray.h"

namespace tyndall::render {

class DecoupledMarching {
 public:
  static constexpr std::string_view name = "decoupled";
  static constexpr MethodTraits traits{.many_light_samples = true, .guides = true};
  explicit DecoupledMarching(Distance distance) : distance_(distance) {}

  void request(const compile::CompiledScene&, const PropagationRequest& r) { queue_.add(r, r.may_end_early); }
  void propagate(const compile::CompiledScene& world, ThreadContext& thread) { queue_.run(world, thread); }
  void prepare_light(const compile::CompiledScene& world, const Rgb& throughput,
                     std::span<const ScatteringOrder> orders, MediumRay& ray) const;
  void sample_light(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows);
  void sample_aimed_light(const LitRay&, const LightRequest&, ShadowBatch&) {}
  double pdf_light(const LitRay& ray, const LightHit& hit);
  Scattering scatter(const MediumRay& ray, float u, double volume_probability) const {
    return scatter_by_density(ray.light, u, volume_probability);
  }

 private:
  Distance distance_;
  MarchQueue queue_;
  DistanceMixture mixture_;
};

}  // namespace tyndall::render
