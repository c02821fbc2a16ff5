// What of a ray is marched, and how finely, after what majorant grids prove about its volumes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/majorant/majorant_dda.h"
#include "compile/majorant/occupancy_walk.h"
#include "render/march/error_bounded_steps.h"

namespace tyndall::render {

// A part of a ray inside of one volume, to be cut into segments of at most `step` [m]; infinite: one segment.
// Regions are those of March that lie in it.
struct MarchedInterval {
  double t0 = 0, t1 = 0;
  std::uint32_t volume = 0;
  double step = 0;
  float minorant = 0, spread = 0;  // [1/m] what is proven of its extinction; where the step is automatic
  std::uint32_t first_region = 0, region_count = 0;
};

// Finds them; keeps its memory from ray to ray.
class MarchedIntervals {
 public:
  // All intervals of the ray over [0, ray.t_max), in order of (t0, volume). What is proven to be empty is in
  // none (unless `skips_empty` is false), what is proven to be uniform is one segment. The rest has the
  // volume's step, or steps that follow from its bounds (graded_step.h); where a proven tolerance is given
  // instead, the transmittance from the ray's start to any end of a segment is overestimated in the mean by
  // no more than it: 0 <= E[T'] - T <= tolerance, with T the exact transmittance (error_bounded_steps.h).
  void find(const compile::CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
            bool skips_empty, std::vector<MarchedInterval>& out);
  // Each volume's interval as it is, of one segment.
  void find_whole(const compile::CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
                  std::vector<MarchedInterval>& out);

 private:
  void add(const compile::CompiledScene& world, const compile::Ray& ray, bool skips_empty, double certified,
           compile::VolumeInterval& inside, std::vector<MarchedInterval>& out);
  void add_certified(compile::MajorantDda& walk, const compile::VolumeInterval& inside,
                     const compile::CompiledVolume& volume, double tolerance, int together,
                     std::vector<MarchedInterval>& out);

  void add_graded(compile::MajorantDda& walk, const compile::VolumeInterval& inside,
                  const compile::CompiledVolume& volume, std::vector<MarchedInterval>& out);

  std::vector<compile::VolumeInterval> inside_;
  compile::OccupancyWalk occupancy_;
  compile::BoundsScratch bounds_;
  std::vector<CertifiedCell> cells_;
  std::vector<CertifiedInterval> certified_;
  CertifiedScratch certified_scratch_;
};

// How many segments of a ray with these intervals are evaluated before Russian roulette may end its march
// (transmittance_roulette.h).
std::uint32_t segments_before_roulette(const compile::CompiledScene& world,
                                       std::span<const MarchedInterval> marched);

}  // namespace tyndall::render
