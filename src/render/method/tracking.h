// Unbiased free paths by null collisions (delta_tracking.h), which are aimed at lights too.
#pragma once

#include <string_view>
#include <vector>

#include "render/method/free_path_light.h"
#include "render/method/medium_ray.h"
#include "render/tracking/delta_tracking.h"

namespace tyndall::render {

class Tracking : public FreePathMethod {
 public:
  static constexpr std::string_view name = "tracking";
  // Rays that sum emission are marched, which is not what unbiased tracking is asked for.
  static constexpr MethodTraits traits{.samples_emission = false, .aims = true};
  explicit Tracking(Distance distance) : FreePathMethod(distance, true) {}

  void request(const compile::CompiledScene& world, const PropagationRequest& r);
  void propagate(const compile::CompiledScene& world, ThreadContext& thread) {
    tracker_.track(world, requests_, thread);
    requests_.clear();
  }

 private:
  DeltaTracker tracker_;
  std::vector<TrackingRequest> requests_;
};

}  // namespace tyndall::render
