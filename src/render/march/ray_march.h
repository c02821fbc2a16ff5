// Decoupled marching (Kulla and Fajardo, EGSR 2012, section 3) of many rays at once.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/context/thread_context.h"
#include "render/march/march.h"
#include "render/march/march_integrals.h"
#include "render/march/marched_intervals.h"
#include "render/march/medium_batch.h"

namespace tyndall::render {

// A ray to be marched over [0, ray.t_max): intervals, segments, programs, running sums.
struct MarchRequest {
  compile::Ray ray;
  compile::RayKind kind{};
  std::uint32_t seed = 0;  // of its jitter
  March* out = nullptr;
  bool may_end_by_roulette = false;  // where little passes (transmittance_roulette.h)
};

// Marches rays; keeps its memory from one call to the next.
class RayMarcher {
 public:
  // Marches rays together: the segments of all are the lanes of one batch for each medium.
  void march(const compile::CompiledScene& world, std::span<const MarchRequest> requests,
             ThreadContext& thread);
  // One ray alone.
  void march(const compile::CompiledScene& world, const MarchRequest& request, ThreadContext& thread) {
    march(world, std::span(&request, 1), thread);
  }

  // Coefficients at points instead: the segments are the t0 that each request's march holds already, in order
  // and of no length, as are its ray and its intervals. Nothing is summed along the ray.
  void evaluate_points(const compile::CompiledScene& world, std::span<const MarchRequest> requests,
                       ThreadContext& thread);

 private:
  // A block of a request, sorted by medium: its place among the lanes of a batch.
  struct BatchEntry {
    std::uint32_t medium = 0, request = 0, block = 0;
    auto operator<=>(const BatchEntry&) const = default;
  };
  // Where media are evaluated: somewhere in each segment, or at its start.
  enum class Places { in_segments, at_starts };

  void start(std::span<const MarchRequest> requests);
  void begin_march(const compile::CompiledScene& world, const MarchRequest& request, ThreadContext& thread);
  void lay_segments(const compile::CompiledScene& world, March& march, Statistics& statistics);
  void limit_segments(const compile::CompiledScene& world, double wanted, March& march,
                      Statistics& statistics);
  void lay_batches(const compile::CompiledScene& world, std::span<const MarchRequest> requests);
  void evaluate_batch(const compile::CompiledScene& world, std::span<const MarchRequest> requests,
                      std::span<const BatchEntry> entries, Places places, ThreadContext& thread);
  void evaluate(const compile::CompiledScene& world, std::span<const MarchRequest> requests, Places places,
                ThreadContext& thread);

  MarchedIntervals intervals_;
  std::vector<double> edges_;
  std::vector<std::uint32_t> active_;  // intervals
  std::vector<std::uint32_t> going_;   // requests that have segments left
  std::vector<BatchEntry> entries_;
  MediumBatch batch_;
  std::shared_ptr<std::vector<float>> outputs_;  // of this call's batches
  std::size_t floats_ = 0;                       // of them, in use
  IntegralScratch integrals_;
};

}  // namespace tyndall::render
