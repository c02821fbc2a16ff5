#include "render/light_met.h"

#include "optics/light_sampling.h"
#include "render/worker.h"

namespace tyndall::render {

float weight_of_met_light(const compile::CompiledScene& world, int light_samples, const PathState& s,
                          std::uint32_t light, const Vec3d& y, const Vec3d& normal, Worker& worker) {
  // The path was at depth - 1 when it was scattered towards this light.
  const int samples = s.depth == 1 ? light_samples : 1;
  switch (s.origin.kind) {
    case PathOrigin::Kind::camera:
    case PathOrigin::Kind::delta:
      return 1;
    case PathOrigin::Kind::volume: {
      const double p =
          s.origin.strategies->pdf(light, s.origin.segment, s.origin.t, s.ray.direction, y, normal, worker);
      return static_cast<float>(1 - balance(samples, p, s.origin.pdf));
    }
    case PathOrigin::Kind::surface: {
      const double solid_angle = optics::pdf_light(*compile::LightAt(world, light, s.ray.time),
                                                   s.origin.position, s.ray.direction, y, normal);
      if (solid_angle == 0) return 1;
      worker.surface_lights.set(world, s.origin.position, s.ray.direction, 0, 0, s.ray.time);
      const double p = worker.surface_lights.probability(light) * solid_angle;
      return static_cast<float>(1 - balance(samples, p, s.origin.pdf));
    }
  }
  return 1;
}

}  // namespace tyndall::render
