// A ray through media, divided where what was learned of the lights changes. Direct light along it is sampled
// in one of the pieces, which are chosen by what they scatter and what they are lit with.
#pragma once

#include <span>
#include <vector>

#include "base/interval.h"
#include "compile/compiled_scene.h"
#include "render/distance/density_sampling.h"
#include "render/lights/learned_lights.h"
#include "render/lights/light_selection.h"

namespace tyndall::render {

struct RayPiece {
  Intervald t;
  const LightRegion* region = nullptr;
  double before = 0, probability = 0;  // of all before it, and its own

  LightSelection lights(const compile::CompiledScene& world, const compile::Ray& ray) const {
    return {world, ray, t.lo, t.hi, region};
  }
};

// Of one ray after the other; keeps its memory.
class RayPieces {
 public:
  void clear() { pieces_.clear(); }
  // `density` is that of the march. Leaves none where no light brings anything.
  void divide(const compile::CompiledScene& world, const LearnedLights& learned, const March& march,
              const DensityDistribution& density);
  bool empty() const { return pieces_.empty(); }
  // For u in [0, 1), which is rescaled to be used again; never earlier on the ray for a greater u.
  const RayPiece& choose(float& u) const;
  // The piece that holds t; null: none does that may be chosen.
  const RayPiece* at(double t) const;
  std::span<const RayPiece> all() const { return pieces_; }

 private:
  std::vector<RayPiece> pieces_;  // in order
};

}  // namespace tyndall::render
