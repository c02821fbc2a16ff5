// Rays towards lamps and what they light. In fog, a direction that passes a lamp at the angle θ gathers about
// 1/sin θ of its light: of directions drawn as the medium or a surface scatters, few go there, and these
// bring nearly all (their variance is infinite for a lamp without extent). So where a path is scattered, a
// second ray may leave, uniform in θ; it gathers what lamps bring to it, and ends. The path, which goes on as
// ever, and it share that light by the balance heuristic. Other rays are sent to surfaces that are lit
// brightly, which light the fog as lamps do (decision 32; after Georgiev, Křivánek, Hachisuka, Nowrouzezahrai
// and Jarosz, "Joint Importance Sampling of Low-Order Volumetric Scattering", SIGGRAPH Asia 2013).
#pragma once

#include <span>

#include "base/inline_vector.h"
#include "compile/compiled_scene.h"
#include "render/lights/light_region.h"
#include "render/lights/lit_spots.h"

namespace tyndall::render {

// Whether such rays are worth their cost, twice that of a path: a small lamp stands in a medium, or so near
// to one that it is in the medium's box.
bool guides_to_lamps(const compile::CompiledScene& world);

// The directions of such rays from one place. Of many lamps it is about few, drawn for the place: all
// techniques from there must share it.
class LampGuide {
 public:
  // `ray`'s origin is the place; what is farther than its end is left to paths. `picks`: in [0, 1), which of
  // many lamps. No spots: null.
  LampGuide(const compile::CompiledScene& world, const LitSpots* spots, const compile::Ray& ray,
            std::span<const float> picks, const LightRegion* region = nullptr);
  // Whether there is nothing to send rays to.
  bool empty() const { return lamps_.empty() && spots_.empty(); }
  // Density of a ray's directions [1/sr]; infinite straight towards a lamp.
  double pdf(const Vec3d& w) const;
  // For numbers in [0, 1): the lamp or spot, and two of the direction.
  Vec3d sample(float u_target, float u0, float u1) const;

 private:
  struct Lamp {
    Vec3d toward;  // unit
    double share;  // of the rays; they add up to 1
  };
  struct Spot {
    Vec3d toward;  // unit
    double share;
    double m_max;  // 1 - cos of the cone around it
  };
  void add_lamps(const compile::CompiledScene& world, const compile::Ray& ray, std::span<const float> picks,
                 const LightRegion* region);
  void add(const compile::CompiledLight& light, const compile::Ray& ray, double probability);
  void add(const LitSpot& spot, const Vec3d& x, double weight);

  InlineVector<Lamp, 8> lamps_;
  InlineVector<Spot, LitSpots::most_spots> spots_;
};

}  // namespace tyndall::render
