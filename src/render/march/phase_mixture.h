// The phase function at a place of a marched ray.
#pragma once

#include <cstdint>

#include "base/inline_vector.h"
#include "base/vec.h"
#include "compile/compiled_scene.h"
#include "optics/phase.h"
#include "render/march/march.h"

namespace tyndall::render {

// The lobes of all media at one segment of a march, weighted by their scattering.
class PhaseMixture {
 public:
  PhaseMixture(const compile::CompiledScene& world, const March& march, std::uint32_t segment);

  // Coloured, because media of different colours may scatter differently: ∑ (share of sigma_s) lobe [1/sr].
  Rgb eval(float one_minus_cos) const;
  // The same with every lobe less directed (optics::Phase::eval_softened).
  Rgb eval_softened(float one_minus_cos, float anisotropy) const;
  // Of `sample` [1/sr].
  float pdf(float one_minus_cos) const;
  // Draws 1 - cos for three numbers in [0, 1).
  float sample(float u_lobe, float u0, float u1) const;

 private:
  struct Lobe {
    optics::Phase phase;
    Rgb share;  // of sigma_s, per channel; sums to 1 over the lobes
    float probability;
  };
  InlineVector<Lobe, 4> lobes_;
};

}  // namespace tyndall::render
