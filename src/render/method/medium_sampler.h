// How paths go through media: the methods of `--method`.
//
// A method is a class of its own, named in `Methods`, that has
//
//   name, traits      its word on the command line, and what the rest of the renderer needs to know of it
//   request           notes a ray that is to go through media
//   propagate         takes all that were noted through them, together
//   prepare_light     readies direct light on a ray, where `propagate` did not
//   sample_light      adds the shadow rays of one sample of the light along a ray
//   sample_aimed_light  the same at a place that was chosen before the ray was followed
//   pdf_light         density [1/m/sr] with which sample_light samples what a path hit by itself
//   scatter           draws where the path is scattered, for a number in [0, 1)
//
// The path tracer knows none of them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>

#include "render/method/brute_force.h"
#include "render/method/decoupled.h"
#include "render/method/stochastic.h"
#include "render/method/tracking.h"

namespace tyndall::render {

using Methods = std::variant<DecoupledMarching, BruteForceMarching, StochasticMarching, Tracking>;
inline constexpr std::size_t method_count = std::variant_size_v<Methods>;

// In the order of `Methods`.
enum class Method : std::uint8_t { decoupled, brute_force, stochastic, tracking };

inline constexpr std::array<std::string_view, method_count> method_names =
    []<std::size_t... k>(std::index_sequence<k...>) {
  return std::array<std::string_view, method_count>{std::variant_alternative_t<k, Methods>::name...};
}
(std::make_index_sequence<method_count>());
inline constexpr std::array<MethodTraits, method_count> method_traits =
    []<std::size_t... k>(std::index_sequence<k...>) {
  return std::array<MethodTraits, method_count>{std::variant_alternative_t<k, Methods>::traits...};
}
(std::make_index_sequence<method_count>());
constexpr const MethodTraits& traits(Method method) {
  return method_traits[static_cast<std::size_t>(method)];
}

// One method with its memory, of one thread.
class MediumSampler {
 public:
  MediumSampler(Method method, Distance distance) : method_(make(method, distance)) {}

  void request(const compile::CompiledScene& world, const PropagationRequest& r) {
    std::visit([&](auto& m) { m.request(world, r); }, method_);
  }
  void propagate(const compile::CompiledScene& world, ThreadContext& thread) {
    std::visit([&](auto& m) { m.propagate(world, thread); }, method_);
  }
  void prepare_light(const compile::CompiledScene& world, const Rgb& throughput,
                     std::span<const ScatteringOrder> orders, MediumRay& ray) {
    std::visit([&](auto& m) { m.prepare_light(world, throughput, orders, ray); }, method_);
  }
  void sample_light(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) {
    std::visit([&](auto& m) { m.sample_light(ray, request, shadows); }, method_);
  }
  void sample_aimed_light(const LitRay& ray, const LightRequest& request, ShadowBatch& shadows) {
    std::visit([&](auto& m) { m.sample_aimed_light(ray, request, shadows); }, method_);
  }
  double pdf_light(const LitRay& ray, const LightHit& hit) {
    return std::visit([&](auto& m) { return m.pdf_light(ray, hit); }, method_);
  }
  Scattering scatter(const MediumRay& ray, float u, double volume_probability) const {
    return std::visit([&](const auto& m) { return m.scatter(ray, u, volume_probability); }, method_);
  }

 private:
  template <std::size_t k = 0>
  static Methods make(Method method, Distance distance) {
    if constexpr (k + 1 < method_count)
      if (static_cast<std::size_t>(method) != k) return make<k + 1>(method, distance);
    return Methods(std::in_place_index<k>, distance);
  }

  Methods method_;
};

}  // namespace tyndall::render
