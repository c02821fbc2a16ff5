// Rays towards distant lights. Where a medium scatters forward, a path that happens to go towards a distant
// light brings tens of times what others bring, and most of a picture's noise is how many do. So from some
// places where a medium scatters a path, a second ray leaves in a direction that is drawn for that light,
// gathers what the light brings to it, and ends; the path, which goes on as ever, and it share that light by
// the balance heuristic (decision 15).
#pragma once

#include "base/inline_vector.h"
#include "compile/compiled_scene.h"
#include "render/lights/light_selection.h"
#include "render/march/phase_mixture.h"

namespace tyndall::render {

// The directions of such rays from one place: about those of distant lights as the phase function there
// scatters.
class DistantLightGuide {
 public:
  // Keeps a reference to the phase function. The lights are those of the ray that is scattered.
  DistantLightGuide(const compile::CompiledScene& world, const LightSelection& lights,
                    const PhaseMixture& phase, double time);
  // The probability that a ray is sent; 0 where it would not pay.
  float chance() const { return chance_; }
  // Density of a ray's directions [1/sr].
  float pdf(const Vec3f& w) const;
  // For numbers in [0, 1): the light, and four of the phase function.
  Vec3f sample(float u_light, float u_lobe, float u0, float u1, float u_turn) const;

 private:
  struct Light {
    Vec3f toward;
    float share;  // of the rays; they add up to 1
  };
  const PhaseMixture& phase_;
  InlineVector<Light, 4> lights_;
  float chance_ = 0;
};

}  // namespace tyndall::render
