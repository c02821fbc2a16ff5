// What of a ray is marched, and how finely, after what majorant grids prove about its volumes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::render {

struct Worker;

// A part of a ray's stay in one volume, to be cut into segments of at most `step` [m]; infinite: one segment.
// Regions are those of March that lie in it.
struct Stretch {
  double t0 = 0, t1 = 0;
  std::uint32_t volume = 0;
  double step = 0;
  float minorant = 0, spread = 0;  // [1/m] what is proven of its extinction; where the step is automatic
  std::uint32_t first_region = 0, region_count = 0;
};

// All stretches of the ray over [0, ray.t_max), in order of (t0, volume). What is proven to be empty is in
// none, what is proven to be uniform is one segment. In volumes with a step of their own the rest has that
// step; where a tolerance is given instead, the transmittance from the ray's start to any end of a segment is
// overestimated in the mean by no more than it: 0 <= E[T'] - T <= tolerance, with T the exact transmittance
// (certified.h).
void find_stretches(const compile::CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
                    Worker& worker, std::vector<Stretch>& out);

// Of a ray with these stretches, how many segments are evaluated before chance may end it in the dark
// (dark.h).
std::uint32_t segments_before_dark(const compile::CompiledScene& world, std::span<const Stretch> stretches);

// The ray's stays as they are, each one segment.
void whole_stays(const compile::CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
                 Worker& worker, std::vector<Stretch>& out);

}  // namespace tyndall::render
