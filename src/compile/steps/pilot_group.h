// Volumes that are the same but for where they stand, the lines through them, and what marches make of those.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/numerics.h"
#include "compile/compiled_scene.h"
#include "compile/majorant/majorant_grid.h"
#include "compile/steps/line_profile.h"
#include "compile/steps/pilot.h"
#include "compile/steps/pilot_lines.h"

namespace tyndall::compile {

// A part of a line in which bounds are the same; those that are proven to be empty are left out.
struct LineCell {
  double t0 = 0, t1 = 0;  // [m] from the line's start
  CellBounds bounds;
};

// How far off the light of a group is, in shares of it, and the noise of what one march has of the light that
// the medium emits: its mean square, likewise.
struct PilotEstimate {
  double bias = 0, noise = 0;
};

struct PilotGroup {
  scene::Step step{};
  std::vector<std::uint32_t> volumes{};
  double widest = infinity;  // [m]
  bool scatters = false;
  double seen_share = 0;  // of the picture
  // What the camera sees, and from there towards light; with what the pilot found there, and the grids.
  std::vector<PilotLine> seen{}, paths{};
  std::vector<LineProfile> seen_profiles{}, path_profiles{};
  std::vector<std::vector<LineCell>> seen_cells{}, path_cells{};

  double longest() const;
  void look(Pilot& pilot, std::size_t places);
  void find_cells(const CompiledScene& world, BoundsScratch& scratch);
  // Of marches at a step [m]; and with one that changes from cell to cell (graded_step.h).
  double segments(double metres) const;  // of a line, on average
  double graded_segments(double most_spread) const;
  double shortest_graded(double most_spread) const;  // segment [m]
  PilotEstimate estimate(double metres) const;
  PilotEstimate graded_estimate(double most_spread) const;
};

}  // namespace tyndall::compile
