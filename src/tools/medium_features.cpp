#include "tools/medium_features.h"

#include <fmt/format.h>

#include <vector>

#include "base/parallel.h"
#include "compile/majorant/grid_summary.h"

namespace tyndall::tools {
namespace {

std::string program_line(std::string_view name, const vm::Program& program) {
  return fmt::format("  {:<22}{} instructions a segment, {} once a batch, {} registers\n", name,
                     program.lane_code.size(), program.uniform_code.size(), program.row_count);
}

// The grids of one medium, together.
std::string grid_lines(const std::vector<compile::GridSummary>& grids) {
  std::size_t cells = 0, empty = 0, uniform = 0, tight = 0;
  double tightness = 0;
  for (const compile::GridSummary& g : grids) {
    cells += g.cells;
    empty += g.empty;
    uniform += g.uniform;
    tight += g.tightness > 0;
    tightness += g.tightness;
  }
  const auto share = [&](std::size_t count) {
    return 100 * static_cast<double>(count) / static_cast<double>(cells);
  };
  std::string text =
      fmt::format("  {:<22}{} in {} grid{}: {:.1f} % proved empty, {:.1f} % uniform\n", "cells", cells,
                  grids.size(), grids.size() == 1 ? "" : "s", share(empty), share(uniform));
  if (tight > 0)
    text += fmt::format("  {:<22}{:.2f} x the largest of 64 samples a cell\n", "majorants",
                        tightness / static_cast<double>(tight));
  return text;
}

}  // namespace

std::string medium_features(const compile::CompiledScene& world) {
  std::vector<compile::GridSummary> summaries(world.grids.size());
  parallel_for(world.grids.size(), 0, [&](std::size_t i, int) { summaries[i] = summarize(*world.grids[i]); });
  std::string text;
  for (const compile::CompiledMedium& medium : world.media) {
    text += fmt::format("medium {}: {}{}\n", medium.name,
                        medium.homogeneous() ? "the same everywhere" : "varies in space",
                        medium.full.reads(vm::Input::time) ? ", changes with time" : "");
    text += program_line("everything", medium.full);
    text += program_line("extinction alone", medium.extinction);
    std::vector<compile::GridSummary> grids;
    for (std::size_t i = 0; i < summaries.size(); ++i)
      if (&world.grids[i]->medium() == &medium) grids.push_back(summaries[i]);
    if (!grids.empty()) text += grid_lines(grids);
  }
  return text;
}

}  // namespace tyndall::tools
