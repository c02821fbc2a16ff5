#include "compile/steps/pilot_group.h"

#include <algorithm>
#include <cmath>

#include "compile/majorant/majorant_dda.h"
#include "compile/steps/graded_step.h"

namespace tyndall::compile {

namespace {

void add(const LineLight& of_line, LineLight& sum) {
  sum.transmitted += of_line.transmitted;
  sum.scattered += of_line.scattered;
  sum.emitted += of_line.emitted;
}

struct LinesLight : LineProfile::Compared {
  double emitted_squares = 0;
};

// Of all lines together, of which `compared_line` compares one.
template <class CompareLine>
LinesLight sum_of(const std::vector<LineProfile>& profiles, CompareLine&& compared_line) {
  LinesLight sum;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const LineProfile::Compared line = compared_line(i);
    add(line.exact, sum.exact);
    add(line.marched, sum.marched);
    sum.variance += line.variance;
    sum.emitted_squares += line.exact.emitted * line.exact.emitted;
  }
  return sum;
}

double off_by(double found, double truth) { return truth > 0 ? std::abs(found / truth - 1) : 0; }

// What comes through, what is scattered towards the camera of the light that gets there, and what is emitted:
// whichever is worst.
double bias_of(const PilotGroup& group, const LinesLight& seen, const LinesLight& paths) {
  const auto lines = static_cast<double>(group.seen_profiles.size());
  // What is behind is seen beside the medium's own light, and what is as good as black may be so.
  constexpr double least_seen = 1e-3;
  const bool has_light = group.scatters || seen.exact.emitted > 0;
  const double all = has_light ? lines : std::max(seen.exact.transmitted, least_seen * lines);
  const double bias = std::max((seen.marched.transmitted - seen.exact.transmitted) / all,
                               off_by(seen.marched.emitted, seen.exact.emitted));
  if (!group.scatters) return bias;
  // The profiles are lit from where they are seen, where a cloud's edge matters most. Of light from other
  // sides it matters less: how much was found out on pictures (docs/decisions/0031-steps.md).
  constexpr double as_lit = 0.75;
  return std::max(bias, as_lit * off_by(seen.marched.scattered, seen.exact.scattered) +
                            off_by(paths.marched.transmitted, paths.exact.transmitted));
}

PilotEstimate estimate_of(const PilotGroup& group, const LinesLight& seen, const LinesLight& paths) {
  const double noise = seen.emitted_squares > 0 ? seen.variance / seen.emitted_squares : 0;
  return {bias_of(group, seen, paths), noise};
}

// As MarchedIntervals cuts a ray.
std::vector<LinePiece> graded_pieces(const std::vector<LineCell>& cells, double widest, double most_spread) {
  std::vector<LinePiece> pieces;
  double step_before = 0;
  for (const LineCell& cell : cells) {
    const double step = graded_step(widest, most_spread, cell.bounds);
    if (!pieces.empty() && step < infinity && step == step_before && pieces.back().t1 == cell.t0)
      pieces.back().t1 = cell.t1;
    else
      pieces.push_back({cell.t0, cell.t1, 1});
    constexpr double most = 1 << 20;
    LinePiece& piece = pieces.back();
    piece.count = static_cast<int>(std::clamp(std::ceil((piece.t1 - piece.t0) / step), 1.0, most));
    step_before = step;
  }
  return pieces;
}

std::vector<LineCell> cells_of(const CompiledScene& world, const PilotLine& line, BoundsScratch& scratch) {
  const CompiledVolume& volume = world.volumes[line.volume];
  MajorantDda walk(*world.grids[volume.grid_at(line.ray.time)], volume.medium_from_render_at(line.ray.time),
                   line.ray, line.t0, line.t1, scratch);
  std::vector<LineCell> cells;
  MajorantSegment s;
  while (walk.next(s))
    if (s.bounds.kind != CellKind::empty) cells.push_back({s.t0 - line.t0, s.t1 - line.t0, s.bounds});
  return cells;
}

}  // namespace

double PilotGroup::longest() const {
  double longest = 0;
  for (const auto* lines : {&seen, &paths})
    for (const PilotLine& line : *lines) longest = std::max(longest, line.t1 - line.t0);
  return longest;
}

void PilotGroup::look(Pilot& pilot, std::size_t places) {
  seen_profiles = pilot.profiles(seen, places);
  path_profiles = pilot.profiles(paths, places);
}

void PilotGroup::find_cells(const CompiledScene& world, BoundsScratch& scratch) {
  seen_cells.clear();
  path_cells.clear();
  for (const PilotLine& line : seen) seen_cells.push_back(cells_of(world, line, scratch));
  for (const PilotLine& line : paths) path_cells.push_back(cells_of(world, line, scratch));
}

double PilotGroup::segments(double metres) const {
  double sum = 0;
  for (const auto* lines : {&seen, &paths})
    for (const PilotLine& line : *lines) sum += std::ceil((line.t1 - line.t0) / metres);
  return sum / static_cast<double>(seen.size() + paths.size());
}

double PilotGroup::graded_segments(double most_spread) const {
  double sum = 0;
  for (const auto* lines : {&seen_cells, &path_cells})
    for (const std::vector<LineCell>& cells : *lines)
      for (const LinePiece& piece : graded_pieces(cells, widest, most_spread)) sum += piece.count;
  return sum / static_cast<double>(seen.size() + paths.size());
}

double PilotGroup::shortest_graded(double most_spread) const {
  double shortest = widest;
  for (const auto* lines : {&seen_cells, &path_cells})
    for (const std::vector<LineCell>& cells : *lines)
      for (const LineCell& cell : cells)
        shortest = std::min(shortest, graded_step(widest, most_spread, cell.bounds));
  return shortest;
}

PilotEstimate PilotGroup::estimate(double metres) const {
  return estimate_of(*this,
                     sum_of(seen_profiles, [&](std::size_t i) { return seen_profiles[i].compared(metres); }),
                     sum_of(path_profiles, [&](std::size_t i) { return path_profiles[i].compared(metres); }));
}

PilotEstimate PilotGroup::graded_estimate(double most_spread) const {
  const auto compared = [&](const LineProfile& profile, const std::vector<LineCell>& cells) {
    return profile.compared(graded_pieces(cells, widest, most_spread));
  };
  return estimate_of(
      *this, sum_of(seen_profiles, [&](std::size_t i) { return compared(seen_profiles[i], seen_cells[i]); }),
      sum_of(path_profiles, [&](std::size_t i) { return compared(path_profiles[i], path_cells[i]); }));
}

}  // namespace tyndall::compile
