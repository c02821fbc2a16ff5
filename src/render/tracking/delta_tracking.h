// Delta tracking: unbiased free paths by null collisions (Woodcock et al. 1965), `--method tracking`.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/majorant/majorant_dda.h"
#include "render/march/ray_march.h"
#include "render/tracking/free_path.h"

namespace tyndall::render {

struct TrackingRequest {
  std::uint32_t seed = 0;
  Rgb throughput;
  March* march = nullptr;  // with its ray and intervals; gets the aimed and the collision point, as segments
                           // of no length in order of t, and the light emitted on the way
  FreePath* free_path = nullptr;
};

// The ray's volumes, for a free path: intervals, and those of them that scatter.
void find_volumes(const compile::CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
                  March& out);

// Tracks rays; keeps its memory from one call to the next.
class DeltaTracker {
 public:
  // The candidate collisions of all rays are evaluated in one batch.
  void track(const compile::CompiledScene& world, std::span<const TrackingRequest> requests,
             ThreadContext& thread);

 private:
  struct Bound {
    double t0, t1, majorant;
  };
  double uniform_extinction(const compile::CompiledScene& world, const compile::CompiledVolume& volume,
                            const March& march, double t, ThreadContext& thread);
  void add_bounds(const compile::CompiledScene& world, const March& march, const compile::VolumeInterval& i,
                  ThreadContext& thread);
  void lay_line(const compile::CompiledScene& world, const March& march, ThreadContext& thread,
                MajorantLine& line);
  void begin(const compile::CompiledScene& world, std::span<const TrackingRequest> requests,
             ThreadContext& thread);

  RayMarcher marcher_;
  MediumBatch batch_;
  compile::BoundsScratch majorant_scratch_;
  std::vector<Bound> bounds_;  // of one ray
  std::vector<float> values_;
  std::vector<MarchRequest> points_;
  std::vector<Vec3d> emitted_;           // by request
  std::vector<std::size_t> unfinished_;  // requests
};

}  // namespace tyndall::render
