// Rays towards media that emit, for direct light: the emission is summed over the whole of each.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/aov.h"
#include "render/crossings.h"
#include "render/march.h"

namespace tyndall::render {

struct EmissionRay {
  compile::Ray ray;
  Rgb contribution;  // of emission 1 along it; traced, what arrives
  std::uint32_t seed = 0;
  std::uint32_t sample = 0;
  LightPart part{};
  std::vector<Crossing> crossings;
  March march;
};

// Such rays waiting to be marched together. They keep their memory.
class EmissionBatch {
 public:
  // The rays added from now on bring light to this sample.
  void set_sample(std::uint32_t sample, LightPart part) {
    sample_ = sample;
    part_ = part;
  }
  void add(const compile::Ray& ray, const Rgb& contribution, std::uint32_t seed);
  std::span<const std::unique_ptr<EmissionRay>> trace(const compile::CompiledScene& world, Worker& worker);
  void clear() { count_ = 0; }

 private:
  std::uint32_t sample_ = 0;
  LightPart part_{};
  std::size_t count_ = 0;
  std::vector<std::unique_ptr<EmissionRay>> rays_;
  std::vector<MarchRequest> requests_;
};

}  // namespace tyndall::render
