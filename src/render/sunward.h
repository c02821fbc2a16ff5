// Rays towards the sun. Where a medium scatters forward, a path that happens to go towards a distant light
// brings tens of times what others bring, and most of a picture's noise is how many do. So from some places
// where a medium scatters a path, a second ray leaves in a direction that is drawn for that light, gathers
// what the light brings to it, and ends; the path, which goes on as ever, and it share that light by the
// balance heuristic (decision 15).
#pragma once

#include <vector>

#include "compile/compiled_scene.h"
#include "render/light_choice.h"
#include "render/march.h"

namespace tyndall::render {

// The directions of such rays from one place: about those of distant lights as the phase function there
// scatters.
class SunwardDirections {
 public:
  // Keeps a reference to the phase function. The lights are those of the ray that is scattered.
  void set(const compile::CompiledScene& world, const LightChoice& lights, const PhaseMixture& phase,
           double time);
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
  const PhaseMixture* phase_ = nullptr;
  std::vector<Light> lights_;
  float chance_ = 0;
};

}  // namespace tyndall::render
