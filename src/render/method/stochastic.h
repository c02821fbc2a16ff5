// Stochastic ray marching: a ray is marched, then followed to a drawn optical depth of its march (Lafortune
// and Willems 1996).
#pragma once

#include <string_view>
#include <vector>

#include "render/method/free_path_light.h"
#include "render/method/medium_ray.h"

namespace tyndall::render {

class StochasticMarching : public FreePathMethod {
 public:
  static constexpr std::string_view name = "stochastic";
  static constexpr MethodTraits traits{};
  explicit StochasticMarching(Distance distance) : FreePathMethod(distance, false) {}

  void request(const compile::CompiledScene&, const PropagationRequest& r) {
    queue_.add(r, false);
    requests_.push_back(r);
  }
  void propagate(const compile::CompiledScene& world, ThreadContext& thread);

 private:
  MarchQueue queue_;
  std::vector<PropagationRequest> requests_;
};

}  // namespace tyndall::render
