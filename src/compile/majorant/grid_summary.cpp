#include "compile/majorant/grid_summary.h"

#include <algorithm>

#include "vm/run/machine.h"

namespace tyndall::compile {

namespace {

// 4³ places a cell, in at most this many cells.
constexpr std::size_t sampled_cells = 4096, places = 4, samples = places * places * places;

// The largest extinction among samples of a cell [1/m].
float largest_sample(const MajorantGrid& grid, const Vec3d& corner, vm::Machine& machine) {
  const scene::Medium& medium = grid.medium();
  std::array<std::array<float, samples>, 3> p, world;
  for (std::size_t i = 0; i < samples; ++i) {
    const Vec3d place = {static_cast<double>(i % places), static_cast<double>(i / places % places),
                         static_cast<double>(i / (places * places))};
    const Vec3d at = corner + (place + Vec3d(0.5)) * grid.cell_size() * (1.0 / places);
    const Vec3d in_world =
        grid.domain().world_from_medium.empty() ? Vec3d() : grid.domain().world_from_medium[0].point(at);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[axis][i] = static_cast<float>(at[axis]);
      world[axis][i] = static_cast<float>(in_world[axis]);
    }
  }
  vm::BatchInputs inputs;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inputs.lanes[static_cast<std::size_t>(vm::Input::p_x) + axis] = p[axis].data();
    inputs.lanes[static_cast<std::size_t>(vm::Input::P_x) + axis] = world[axis].data();
  }
  inputs[vm::Input::time] = &grid.domain().time.lo;
  std::vector<std::array<float, samples>> values(medium.extinction.outputs.size());
  std::vector<float*> outputs;
  for (auto& row : values) outputs.push_back(row.data());
  machine.run(medium.extinction, inputs, samples, outputs);
  float largest = 0;
  for (const std::uint8_t k : medium.extinction_sigma_t)
    for (const float v : values[k])
      if (v > largest) largest = std::min(v, largest_coefficient);
  return largest;
}

}  // namespace

GridSummary summarize(const MajorantGrid& grid) {
  GridSummary out;
  BoundsScratch scratch;
  vm::Machine machine;
  const std::array<std::uint32_t, 3>& bricks = grid.bricks();
  out.cells = std::size_t{grid.brick_count()} * MajorantGrid::brick_cells;
  const std::size_t stride =
      std::max<std::size_t>(out.cells / sampled_cells, 1) | 1;  // odd: visits all places
  double bound = 0, truth = 0;
  std::size_t cell = 0;
  for (std::uint32_t z = 0; z < bricks[2]; ++z)
    for (std::uint32_t y = 0; y < bricks[1]; ++y)
      for (std::uint32_t x = 0; x < bricks[0]; ++x) {
        const MajorantGrid::Brick& brick = grid.brick(x, y, z, scratch);
        for (std::uint32_t i = 0; i < MajorantGrid::brick_cells; ++i, ++cell) {
          const CellBounds b = brick.cell(i);
          out.empty += b.kind == CellKind::empty;
          out.uniform += b.kind == CellKind::uniform;
          if (cell % stride != 0 || b.kind == CellKind::empty) continue;
          constexpr std::uint32_t side = MajorantGrid::brick_side;
          const Vec3d at = {static_cast<double>(x * side + i % side),
                            static_cast<double>(y * side + i / side % side),
                            static_cast<double>(z * side + i / (side * side))};
          const float largest = largest_sample(grid, grid.domain().box.lo + at * grid.cell_size(), machine);
          if (!(largest > 0)) continue;
          bound += static_cast<double>(b.majorant);
          truth += static_cast<double>(largest);
        }
      }
  if (truth > 0) out.tightness = bound / truth;
  return out;
}

}  // namespace tyndall::compile
