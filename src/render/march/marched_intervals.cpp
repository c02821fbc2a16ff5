#include "render/march/marched_intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numerics.h"
#include "compile/steps/graded_step.h"
#include "render/march/transmittance_roulette.h"

namespace tyndall::render {

namespace {

using compile::CellKind;
using compile::CompiledScene;
using compile::CompiledVolume;
using compile::VolumeInterval;

// Shorter intervals are marched as they are: looking into the grid would cost more than it saves.
constexpr double least_steps = 3;

// Leaves out what is empty, but for gaps too short to save a segment.
void skip_empty(std::span<const compile::OccupancySegment> kinds, const VolumeInterval& inside, double step,
                std::vector<MarchedInterval>& out) {
  const std::size_t first = out.size();
  for (const compile::OccupancySegment& s : kinds) {
    if (s.kind == CellKind::empty) continue;
    const bool uniform = s.kind == CellKind::uniform && s.t1 - s.t0 > 2 * step;
    if (uniform) {
      out.push_back({s.t0, s.t1, inside.volume, infinity});
      continue;
    }
    const bool joins = out.size() > first && out.back().step == step && s.t0 - out.back().t1 < step;
    if (joins)
      out.back().t1 = s.t1;
    else
      out.push_back({s.t0, s.t1, inside.volume, step});
  }
}

// Whether a medium has other values elsewhere in the volume.
bool varies(const CompiledScene& world, const VolumeInterval& i) {
  return !world.media[world.volumes[i.volume].medium].uniform;
}

}  // namespace

// Segments from the spread of the bounds.
void MarchedIntervals::add_certified(compile::MajorantDda& walk, const VolumeInterval& inside,
                                     const CompiledVolume& volume, double tolerance, int together,
                                     std::vector<MarchedInterval>& out) {
  cells_.clear();
  certified_.clear();
  compile::MajorantSegment s;
  while (walk.next(s)) {
    if (s.bounds.kind == CellKind::empty) continue;
    cells_.push_back({s.t0, s.t1, s.bounds.minorant, s.bounds.majorant,
                      // Rounding apart, one value: exact in one segment.
                      s.bounds.kind == CellKind::uniform ? 0 : s.bounds.spread});
  }
  certified_intervals(cells_, tolerance, together, volume.widest_step, certified_scratch_, certified_);
  for (const CertifiedInterval& c : certified_)
    out.push_back({c.t0, c.t1, inside.volume, c.count == 1 ? infinity : (c.t1 - c.t0) / (c.count - 0.5),
                   c.minorant, c.spread});
}

// Steps that change from cell to cell.
void MarchedIntervals::add_graded(compile::MajorantDda& walk, const VolumeInterval& inside,
                                  const CompiledVolume& volume, std::vector<MarchedInterval>& out) {
  const std::size_t first = out.size();
  compile::MajorantSegment s;
  while (walk.next(s)) {
    if (s.bounds.kind == CellKind::empty) continue;
    const double step = compile::graded_step(volume.widest_step, volume.most_spread, s.bounds);
    if (out.size() > first && step < infinity && out.back().step == step && out.back().t1 == s.t0)
      out.back().t1 = s.t1;
    else
      out.push_back({s.t0, s.t1, inside.volume, step});
  }
}

// `certified`: how many intervals of the ray share the tolerance of its automatic steps. Cuts `inside` to
// what may be occupied.
void MarchedIntervals::add(const CompiledScene& world, const compile::Ray& ray, bool skips_empty,
                           double certified, VolumeInterval& inside, std::vector<MarchedInterval>& out) {
  const CompiledVolume& volume = world.volumes[inside.volume];
  if (!varies(world, inside)) {
    out.push_back({inside.t0, inside.t1, inside.volume, infinity});
    return;
  }
  const compile::MajorantGrid& grid = *world.grids[volume.grid_at(ray.time)];
  const Transform medium_from_render = volume.medium_from_render_at(ray.time);
  if (skips_empty) {
    const Intervald part =
        grid.occupied_part(medium_from_render.point(ray.origin), medium_from_render.vector(ray.direction),
                           {inside.t0, inside.t1});
    if (part.empty()) return;
    inside.t0 = part.lo;
    inside.t1 = part.hi;
  }
  const double step = volume.step.metres;
  if (volume.step.proven) {
    compile::MajorantDda walk(grid, medium_from_render, ray, inside.t0, inside.t1, bounds_);
    // Each interval takes its share of the tolerance: (1 + a) (1 + b) - 1 is below it when ln(1 + a) + ln(1 +
    // b) is.
    const auto together = std::count_if(inside_.begin(), inside_.end(), [&](const VolumeInterval& i) {
      return varies(world, i) && i.t0 < inside.t1 && inside.t0 < i.t1;
    });
    add_certified(walk, inside, volume, std::log1p(volume.step.tolerance) / certified,
                  static_cast<int>(together), out);
  } else if (volume.most_spread > 0) {
    compile::MajorantDda walk(grid, medium_from_render, ray, inside.t0, inside.t1, bounds_);
    add_graded(walk, inside, volume, out);
  } else if (!skips_empty || !volume.skips || inside.t1 - inside.t0 <= least_steps * step) {
    out.push_back({inside.t0, inside.t1, inside.volume, step});
  } else {
    skip_empty(occupancy_.along(grid, medium_from_render, ray, inside.t0, inside.t1, step, bounds_), inside,
               step, out);
  }
}

void MarchedIntervals::find(const CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
                            bool skips_empty, std::vector<MarchedInterval>& out) {
  out.clear();
  world.volume_intervals(ray, kind, inside_);
  const auto certified = std::count_if(inside_.begin(), inside_.end(), [&](const VolumeInterval& i) {
    return varies(world, i) && world.volumes[i.volume].step.proven;
  });
  for (VolumeInterval& inside : inside_)
    add(world, ray, skips_empty, static_cast<double>(certified), inside, out);
  const auto earlier = [](const MarchedInterval& a, const MarchedInterval& b) { return a.t0 < b.t0; };
  if (!std::is_sorted(out.begin(), out.end(), earlier)) std::stable_sort(out.begin(), out.end(), earlier);
}

void MarchedIntervals::find_whole(const CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
                                  std::vector<MarchedInterval>& out) {
  out.clear();
  world.volume_intervals(ray, kind, inside_);
  for (const VolumeInterval& inside : inside_) out.push_back({inside.t0, inside.t1, inside.volume, infinity});
}

std::uint32_t segments_before_roulette(const CompiledScene& world, std::span<const MarchedInterval> marched) {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  for (const MarchedInterval& s : marched)
    if (s.step < infinity)
      least = std::min(least, segments_before_roulette(world.volumes[s.volume].majorant, s.step));
  return least;
}

}  // namespace tyndall::render
