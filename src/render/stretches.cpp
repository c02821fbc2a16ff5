#include "render/stretches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numerics.h"
#include "compile/grid_walk.h"
#include "compile/kind_walk.h"
#include "render/dark.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

using compile::CellKind;
using compile::CompiledScene;
using compile::CompiledVolume;
using compile::VolumeInterval;

// Shorter stays are marched as they are: looking into the grid would cost more than it saves.
constexpr double least_steps = 3;

// Leaves out what is empty, but for gaps too short to save a segment.
void skip_empty(std::span<const compile::KindSegment> kinds, const VolumeInterval& stay, double step,
                std::vector<Stretch>& out) {
  const std::size_t first = out.size();
  for (const compile::KindSegment& s : kinds) {
    if (s.kind == CellKind::empty) continue;
    const bool uniform = s.kind == CellKind::uniform && s.t1 - s.t0 > 2 * step;
    if (uniform) {
      out.push_back({s.t0, s.t1, stay.volume, infinity});
      continue;
    }
    const bool joins = out.size() > first && out.back().step == step && s.t0 - out.back().t1 < step;
    if (joins)
      out.back().t1 = s.t1;
    else
      out.push_back({s.t0, s.t1, stay.volume, step});
  }
}

// Segments from the spread of the bounds.
void certify(compile::GridWalk& walk, const VolumeInterval& stay, const CompiledVolume& volume,
             double tolerance, int together, Worker& worker, std::vector<Stretch>& out) {
  worker.certified_cells.clear();
  worker.certified_stretches.clear();
  const auto flush = [&] {
    for (const CertifiedStretch& s : worker.certified_stretches)
      out.push_back({s.t0, s.t1, stay.volume, s.count == 1 ? infinity : (s.t1 - s.t0) / (s.count - 0.5),
                     s.minorant, s.spread});
  };
  compile::MajorantSegment s;
  while (walk.next(s)) {
    if (s.bounds.kind == CellKind::empty) continue;
    worker.certified_cells.push_back({s.t0, s.t1, s.bounds.minorant, s.bounds.majorant,
                                      // Rounding apart, one value: exact in one segment.
                                      s.bounds.kind == CellKind::uniform ? 0 : s.bounds.spread});
  }
  const double narrowest = volume.step.proven ? 0 : volume.widest_step / 8;
  certified_stretches(worker.certified_cells, tolerance, together, volume.widest_step, narrowest,
                      worker.certified_scratch, worker.certified_stretches);
  flush();
}

}  // namespace

void find_stretches(const CompiledScene& world, const compile::Ray& ray, compile::RayKind kind,
                    Worker& worker, std::vector<Stretch>& out) {
  out.clear();
  std::vector<VolumeInterval>& stays = worker.intervals;
  world.volume_intervals(ray, kind, stays);
  const auto varies = [&](const VolumeInterval& i) {
    return !world.media[world.volumes[i.volume].medium].homogeneous;
  };
  const auto certified = static_cast<double>(std::count_if(stays.begin(), stays.end(), [&](const auto& i) {
    return varies(i) && world.volumes[i.volume].step.automatic();
  }));
  for (VolumeInterval& stay : stays) {
    const CompiledVolume& volume = world.volumes[stay.volume];
    if (!varies(stay)) {
      out.push_back({stay.t0, stay.t1, stay.volume, infinity});
      continue;
    }
    const compile::MajorantGrid& grid = *world.grids[volume.grid_at(ray.time)];
    const Transform medium_from_render = volume.medium_from_render_at(ray.time);
    if (worker.skips_empty) {
      const Intervald part = grid.occupied_part(medium_from_render.point(ray.origin),
                                                medium_from_render.vector(ray.direction), {stay.t0, stay.t1});
      if (part.empty()) continue;
      stay.t0 = part.lo;
      stay.t1 = part.hi;
    }
    const bool automatic = volume.step.automatic();
    if (!automatic &&
        (!worker.skips_empty || !volume.skips || stay.t1 - stay.t0 <= least_steps * volume.step.metres)) {
      out.push_back({stay.t0, stay.t1, stay.volume, volume.step.metres});
      continue;
    }
    if (!automatic) {
      const auto kinds = worker.kinds.along(grid, medium_from_render, ray, stay.t0, stay.t1,
                                            volume.step.metres, worker.bounds);
      skip_empty(kinds, stay, volume.step.metres, out);
      continue;
    }
    compile::GridWalk walk(grid, medium_from_render, ray, stay.t0, stay.t1, worker.bounds);
    // Each stay takes its share of the tolerance: (1 + a) (1 + b) - 1 stays below it when ln(1 + a) + ln(1 +
    // b) does.
    const auto together = static_cast<int>(std::count_if(stays.begin(), stays.end(), [&](const auto& i) {
      return varies(i) && i.t0 < stay.t1 && stay.t0 < i.t1;
    }));
    certify(walk, stay, volume, std::log1p(volume.step.tolerance) / certified, together, worker, out);
  }
  const auto earlier = [](const Stretch& a, const Stretch& b) { return a.t0 < b.t0; };
  if (!std::is_sorted(out.begin(), out.end(), earlier)) std::stable_sort(out.begin(), out.end(), earlier);
}

std::uint32_t segments_before_dark(const CompiledScene& world, std::span<const Stretch> stretches) {
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  for (const Stretch& s : stretches)
    if (s.step < infinity)
      least = std::min(least, segments_before_dark(world.volumes[s.volume].majorant, s.step));
  return least;
}

void whole_stays(const CompiledScene& world, const compile::Ray& ray, compile::RayKind kind, Worker& worker,
                 std::vector<Stretch>& out) {
  out.clear();
  world.volume_intervals(ray, kind, worker.intervals);
  for (const VolumeInterval& stay : worker.intervals)
    out.push_back({stay.t0, stay.t1, stay.volume, infinity});
}

}  // namespace tyndall::render
