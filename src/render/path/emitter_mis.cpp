#include "render/path/emitter_mis.h"

#include "optics/light_sampling.h"

namespace tyndall::render {

float mis_weight_of_light(const compile::CompiledScene& world, int light_samples, const PathState& s,
                          const EmitterPoint& hit, MediumSampler& media) {
  // The path was at depth - 1 when it was scattered towards this light.
  const int samples = s.depth == 1 ? light_samples : 1;
  // Rays that were sent for the light have it only where it can be sampled.
  const float counts = s.origin.shares.of(world.lights[hit.light]);
  switch (s.origin.kind) {
    case PathOrigin::Kind::camera:
    case PathOrigin::Kind::delta:
      return 1;
    case PathOrigin::Kind::volume: {
      const double p = media.pdf_light(*s.origin.light, {hit.light, s.origin.segment, s.origin.t,
                                                         s.ray.direction, hit.position, hit.normal});
      if (p == 0) return 1;
      return counts * static_cast<float>(1 - balance(samples, p, s.origin.pdf));
    }
    case PathOrigin::Kind::surface: {
      const double solid_angle = compile::LightAt(world, hit.light, s.ray.time)
                                     ->pdf(s.origin.position, s.ray.direction, hit.position, hit.normal);
      if (solid_angle == 0) return 1;
      const LightSelection lights(world, {s.origin.position, s.ray.direction, 0, s.ray.time}, 0, 0,
                                  s.origin.region);
      const double p = lights.probability(hit.light) * solid_angle;
      if (p == 0) return 1;
      return counts * static_cast<float>(1 - balance(samples, p, s.origin.pdf));
    }
  }
  return 1;
}

}  // namespace tyndall::render
