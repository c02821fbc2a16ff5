// Rays towards media that emit, for direct light: the emission is summed over the whole of each.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/film/aov.h"
#include "render/march/ray_march.h"
#include "render/surface/transparent_hits.h"

namespace tyndall::render {

struct EmissionRay {
  compile::Ray ray;
  Rgb contribution;  // of emission 1 along it; traced, what arrives
  std::uint32_t seed = 0;
  LightTarget target{};
  std::vector<Crossing> crossings;
  March march;
};

// Such rays waiting to be marched together. They keep their memory.
class EmissionBatch {
 public:
  void add(const compile::Ray& ray, const Rgb& contribution, std::uint32_t seed, const LightTarget& target);
  std::span<const std::unique_ptr<EmissionRay>> trace(const compile::CompiledScene& world,
                                                      ThreadContext& thread);
  void clear();

 private:
  std::size_t count_ = 0;
  std::vector<std::unique_ptr<EmissionRay>> rays_;
  std::vector<MarchRequest> requests_;
  RayMarcher marcher_;
};

}  // namespace tyndall::render
