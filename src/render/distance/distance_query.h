// What a strategy may know that draws the distance along a marched ray at which a light is taken.
#pragma once

#include <vector>

#include "base/interval.h"
#include "base/vec.h"
#include "optics/light_sampling.h"
#include "render/march/march.h"
#include "render/march/phase_mixture.h"

namespace tyndall::render {

class DensityDistribution;

// What the rest of the renderer needs to know of a strategy.
struct StrategyTraits {
  bool aims_at_light = false;       // by a pivot; it cannot be had for lights without a place
  bool uses_typical_phase = false;  // which is made for those alone that do
};

struct DistanceQuery {
  const March& march;
  const Rgb& throughput;
  const DensityDistribution& density;
  // Of a light that has a place; null for the others, for which no strategy is asked that aims.
  const optics::Pivot* pivot = nullptr;
  // The parts of the ray that scatter and that the light reaches, in order.
  const std::vector<Intervald>& lit;
  // The phase function at a typical segment; null unless a strategy of the mixture uses it.
  const PhaseMixture* typical_phase = nullptr;
  // The part of the ray to be drawn from; null: all.
  const Intervald* within = nullptr;
};

}  // namespace tyndall::render
