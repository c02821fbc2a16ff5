// Transmittance towards lights: closed form where the medium is homogeneous, a march where not; the lanes of
// several shadow rays fill one batch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::render {

struct Worker;

struct ShadowRay {
  compile::Ray ray;
  std::uint32_t target_light = compile::no_index;
  Rgb contribution;          // what arrives if nothing is in the way
  std::uint32_t seed = 0;    // of its march's jitter
  std::uint32_t sample = 0;  // whose light it is: the caller's number
};

// Shadow rays waiting to be traced together.
class ShadowBatch {
 public:
  // The rays added from now on bring light to this sample.
  void set_sample(std::uint32_t sample) { sample_ = sample; }
  void add(const ShadowRay& ray) {
    rays_.push_back(ray);
    rays_.back().sample = sample_;
  }
  // Leaves in each ray's contribution what arrives: times visibility and transmittance.
  std::span<const ShadowRay> trace(const compile::CompiledScene& world, Worker& worker);
  void clear() { rays_.clear(); }

 private:
  // A ray's stay in a volume that must be marched: `count` segments from t0 of length dt.
  struct Stay {
    std::uint32_t medium, volume, ray, count;
    double t0, dt;
  };
  void collect_stays(const compile::CompiledScene& world, std::uint32_t ray, Worker& worker);
  void march_stays(const compile::CompiledScene& world, Worker& worker);

  std::uint32_t sample_ = 0;
  std::vector<ShadowRay> rays_;
  std::vector<Vec3d> depth_;  // optical depth per ray and channel
  std::vector<compile::VolumeInterval> intervals_;
  std::vector<Stay> stays_;
  std::vector<float> values_;
};

}  // namespace tyndall::render
