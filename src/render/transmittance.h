// Transmittance towards lights: closed form where the medium is homogeneous, a march where not; the lanes of
// several shadow rays fill one batch.
#pragma once

#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::render {

struct Worker;

struct ShadowRay {
  compile::Ray ray;
  std::uint32_t target_light = compile::no_index;
  Rgb contribution;        // what arrives if nothing is in the way
  std::uint32_t seed = 0;  // of its march's jitter
};

// Shadow rays waiting to be traced together.
class ShadowBatch {
 public:
  void add(const ShadowRay& ray) { rays_.push_back(ray); }
  // Sum over the rays of contribution times visibility times transmittance; empties the batch.
  Rgb trace(const compile::CompiledScene& world, Worker& worker);

 private:
  // A ray's stay in a volume that must be marched: `count` segments from t0 of length dt.
  struct Stay {
    std::uint32_t volume, ray, count;
    double t0, dt;
  };
  void collect_stays(const compile::CompiledScene& world, std::uint32_t ray, Worker& worker);
  void march_stays(const compile::CompiledScene& world, Worker& worker);

  std::vector<ShadowRay> rays_;
  std::vector<Vec3d> depth_;  // optical depth per ray and channel
  std::vector<compile::VolumeInterval> intervals_;
  std::vector<Stay> stays_;
  std::vector<float> values_;
};

}  // namespace tyndall::render
