#include "render/method/tracking.h"

namespace tyndall::render {

void Tracking::request(const compile::CompiledScene& world, const PropagationRequest& r) {
  // The light is chosen first, so that the free path knows a point to be aimed at.
  find_volumes(world, r.ray, r.kind, r.out->march);
  begin_light(world, r.throughput, r.orders, *r.out);
  light_.aim(r.numbers.point(Decision::aimed), *r.out);
  requests_.push_back(
      {r.numbers.bits(Decision::free_path, 0), r.throughput, &r.out->march, &r.out->free_path});
}

}  // namespace tyndall::render
