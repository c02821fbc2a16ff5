// Ratio and residual ratio tracking (Novák, Selle and Jarosz 2014): transmittance without bias from random
// points along a ray, against proven bounds of extinction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "compile/compiled_scene.h"
#include "compile/majorant/majorant_dda.h"
#include "render/context/thread_context.h"
#include "render/march/medium_batch.h"
#include "render/transmittance/transmittance.h"

namespace tyndall::render {

struct ShadowRay;

// Intervals of several rays in volumes that vary, tracked together.
class RatioTracking {
 public:
  void clear(std::size_t rays) {
    walks_.clear();
    transmittance_.assign(rays, Vec3d(1));
  }
  void add(std::uint32_t ray, const compile::VolumeInterval& inside, std::uint32_t medium) {
    walks_.push_back({ray, inside.volume, medium, inside.t0, inside.t1});
  }
  // Walks all to their ends, or until roulette ends those of which little is left.
  void run(const compile::CompiledScene& world, Transmittance method, std::span<ShadowRay> rays,
           ThreadContext& thread);
  // What is left of each channel, an unbiased estimate.
  const Vec3d& transmittance(std::uint32_t ray) const { return transmittance_[ray]; }

 private:
  // The rest of an interval, and its points of this round: [first, first + count).
  struct Walk {
    std::uint32_t ray, volume, medium;
    double t0, t1;
    std::uint32_t counter = 0, first = 0, count = 0;  // counter: of random numbers
  };
  struct Point {
    double t, control, inverse_rate;
  };
  void draw_points(const compile::CompiledScene& world, Transmittance method, std::span<ShadowRay> rays,
                   Walk& walk, ThreadContext& thread);
  void evaluate(const compile::CompiledScene& world, std::span<const ShadowRay> rays, ThreadContext& thread);
  bool goes_on(std::span<const ShadowRay> rays, Walk& walk);

  std::vector<Walk> walks_;
  std::vector<Point> points_;
  std::vector<Vec3d> transmittance_;
  MediumBatch batch_;
  std::vector<double> places_;  // [m] along its ray, of one walk's points
  std::vector<float> values_;
  compile::BoundsScratch bounds_;
};

}  // namespace tyndall::render
