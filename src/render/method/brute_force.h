// Brute-force ray marching (Perlin and Hoffert 1989): light is taken at every step of the march.
#pragma once

#include <string_view>

#include "render/distance/distance_mixture.h"
#include "render/method/medium_ray.h"

namespace tyndall::render {

class BruteForceMarching {
 public:
  static constexpr std::string_view name = "brute-force";
  static constexpr MethodTraits traits{.always_jitters = true};
  explicit BruteForceMarching(Distance) {}

  void request(const compile::CompiledScene&, const PropagationRequest& r) { queue_.add(r, false); }
  void propagate(const compile::CompiledScene& world, ThreadContext& thread) { queue_.run(world, thread); }
  void prepare_light(const compile::CompiledScene& world, const Rgb& throughput,
                     std::span<const ScatteringOrder> orders, MediumRay& ray) const {
    begin_light(world, throughput, orders, ray);
    ray.light.density.emplace(ray.march, throughput);
  }
  void sample_light(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) const;
  void sample_aimed_light(const LitRay&, const LightRequest&, ShadowBatch&) {}
  double pdf_light(const LitRay& ray, const LightHit& hit) const;
  Scattering scatter(const MediumRay& ray, float u, double volume_probability) const {
    return scatter_by_density(ray.light, u, volume_probability);
  }

 private:
  MarchQueue queue_;
};

}  // namespace tyndall::render
