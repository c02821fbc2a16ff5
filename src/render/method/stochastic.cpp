#include "render/method/stochastic.h"

namespace tyndall::render {

void StochasticMarching::propagate(const compile::CompiledScene& world, ThreadContext& thread) {
  queue_.run(world, thread);
  for (const PropagationRequest& r : requests_) {
    const SobolPoint u = r.numbers.point(Decision::distance);
    begin_light(world, r.throughput, r.orders, *r.out);
    light_.aim({}, *r.out);
    sample_free_path(r.out->march, r.throughput, u[0], u[1], r.out->free_path);
  }
  requests_.clear();
}

}  // namespace tyndall::render
