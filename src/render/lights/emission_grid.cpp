#include "render/lights/emission_grid.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "compile/geometry/geometry.h"
#include "render/march/ray_march.h"
#include "render/tracking/delta_tracking.h"

namespace tyndall::render {

namespace {

// All grids together have no more cells than this (12 bytes each), one no more than that.
constexpr double most_cells = 1 << 20, most_cells_of_one = 16 * 16 * 16, least_cells_of_one = 64;
// Points of a cell on each axis: at first, to find what is small, and of grids laid anew.
constexpr int first_looks = 3, later_looks = 2;
constexpr int most_trims = 4;         // times that a grid is laid anew around what shines
constexpr double worth_a_trim = 0.5;  // of the box that would be left

// A grid of about so many cells over a box.
EmissionGrid grid_over(const compile::Bounds& box, double cells) {
  EmissionGrid grid;
  grid.lo = box.lo;
  const Vec3d extent = box.hi - box.lo;
  const double edge = std::cbrt(extent.x * extent.y * extent.z / cells);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.count[axis] = static_cast<int>(std::clamp(std::round(extent[axis] / edge), 1.0, 128.0));
    grid.cell[axis] = extent[axis] / grid.count[axis];
  }
  return grid;
}

// The emission of all media at the middle of the shutter, averaged over looks into each cell: a row of cells
// is a ray, the rows of a layer one batch.
std::vector<float> emission_in(const compile::CompiledScene& world, const EmissionGrid& grid, int looks,
                               ThreadContext& thread) {
  RayMarcher marcher;
  const auto [nx, ny, nz] = grid.count;
  std::vector<float> sum(static_cast<std::size_t>(nx) * ny * nz);
  std::vector<March> rows(static_cast<std::size_t>(ny) * looks);
  std::vector<MarchRequest> requests(rows.size());
  const double look = 1.0 / looks;
  for (int z = 0; z < nz * looks; ++z) {
    for (int y = 0; y < ny * looks; ++y) {
      March& row = rows[y];
      const Vec3d start = grid.lo + Vec3d{0, (y + 0.5) * look * grid.cell.y, (z + 0.5) * look * grid.cell.z};
      const compile::Ray ray{start, {1, 0, 0}, nx * grid.cell.x, world.features.motion ? 0.5 : 0.0};
      find_volumes(world, ray, compile::RayKind::scattered, row);
      row.t0.clear();
      for (int x = 0; x < nx * looks; ++x) row.t0.push_back((x + 0.5) * look * grid.cell.x);
      requests[y] = {ray, compile::RayKind::scattered, 0, &row};
    }
    marcher.evaluate_points(world, requests, thread);
    for (int y = 0; y < ny * looks; ++y) {
      float* const cells = &sum[(static_cast<std::size_t>(z / looks) * ny + y / looks) * nx];
      for (int c = 0; c < rows[y].channels; ++c)
        for (int x = 0; x < nx * looks; ++x)
          cells[x / looks] +=
              rows[y].emission[c][x] / static_cast<float>(rows[y].channels * looks * looks * looks);
    }
  }
  return sum;
}

// The box of the cells that shine, and one more on each side; nothing when none does.
std::optional<compile::Bounds> shining(const EmissionGrid& grid, const std::vector<float>& emission) {
  const auto [nx, ny, nz] = grid.count;
  std::array<int, 3> lo = grid.count, hi{0, 0, 0};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        if (!(emission[(static_cast<std::size_t>(z) * ny + y) * nx + x] > 0)) continue;
        const std::array<int, 3> at{x, y, z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          lo[axis] = std::min(lo[axis], at[axis] - 1);
          hi[axis] = std::max(hi[axis], at[axis] + 2);
        }
      }
  if (hi[0] == 0) return std::nullopt;
  compile::Bounds box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = grid.lo[axis] + std::max(lo[axis], 0) * grid.cell[axis];
    box.hi[axis] = grid.lo[axis] + std::min(hi[axis], grid.count[axis]) * grid.cell[axis];
  }
  return box;
}

double volume_of(const compile::Bounds& box) {
  const Vec3d extent = box.hi - box.lo;
  return extent.x * extent.y * extent.z;
}

// What the grid is drawn by; leaves in `emission` the density of points.
void weigh(std::vector<float>& emission, EmissionGrid& grid) {
  const double cell_volume = grid.cell.x * grid.cell.y * grid.cell.z;
  double sum = 0;
  for (const float e : emission) sum += e;
  grid.power = sum * cell_volume;
  double before = 0, square = 0;
  for (std::size_t i = 0; i < emission.size(); ++i) {
    const double share = emission[i] / sum;
    const Vec3d middle = grid.middle(static_cast<int>(i));
    grid.before.push_back(before);
    before += share;
    grid.center += middle * share;
    square += length_squared(middle - grid.lo) * share;
    emission[i] = static_cast<float>(share / cell_volume);
  }
  grid.radius_squared = std::max(square - length_squared(grid.center - grid.lo), 0.0);
}

// Nothing when no look into the volume met emission.
std::optional<EmissionGrid> grid_of(const compile::CompiledScene& world,
                                    const compile::CompiledVolume& volume, double cells,
                                    ThreadContext& thread) {
  compile::Bounds box = world.geometry->volume_bounds(volume);
  for (int trims = 0;; ++trims) {
    if (!(volume_of(box) > 0)) return std::nullopt;
    EmissionGrid grid = grid_over(box, cells);
    std::vector<float> emission = emission_in(world, grid, trims == 0 ? first_looks : later_looks, thread);
    const auto trimmed = shining(grid, emission);
    if (!trimmed) return std::nullopt;
    if (trims < most_trims && volume_of(*trimmed) < worth_a_trim * volume_of(box)) {
      box = *trimmed;
      continue;
    }
    weigh(emission, grid);
    grid.density = std::move(emission);
    return grid;
  }
}

// The integral of density s² ds over the line from x, the density of the direction that is drawn through
// points.
double line_density(const EmissionGrid& grid, const Vec3d& x, const Vec3d& direction) {
  double enter = 0, leave = infinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double hi = grid.lo[axis] + grid.count[axis] * grid.cell[axis];
    if (direction[axis] == 0) {
      if (x[axis] < grid.lo[axis] || x[axis] >= hi) return 0;
      continue;
    }
    const double a = (grid.lo[axis] - x[axis]) / direction[axis], b = (hi - x[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter < leave)) return 0;
  // From cell to cell (Amanatides and Woo 1987).
  std::array<int, 3> at{}, step{};
  Vec3d next, between;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double p = (x[axis] + enter * direction[axis] - grid.lo[axis]) / grid.cell[axis];
    at[axis] = std::clamp(static_cast<int>(std::floor(p)), 0, grid.count[axis] - 1);
    step[axis] = direction[axis] > 0 ? 1 : -1;
    if (direction[axis] == 0) {
      next[axis] = between[axis] = infinity;
      continue;
    }
    const double edge = grid.lo[axis] + (at[axis] + (step[axis] > 0)) * grid.cell[axis];
    next[axis] = (edge - x[axis]) / direction[axis];
    between[axis] = grid.cell[axis] / std::abs(direction[axis]);
  }
  double sum = 0, s = enter;
  while (s < leave) {
    const std::size_t axis = next.x < next.y ? (next.x < next.z ? 0 : 2) : (next.y < next.z ? 1 : 2);
    const double end = std::min(next[axis], leave);
    const std::size_t i = (static_cast<std::size_t>(at[2]) * grid.count[1] + at[1]) * grid.count[0] + at[0];
    if (end > s) sum += grid.density[i] * (end - s) * (end * end + end * s + s * s) / 3;
    s = std::max(s, end);
    at[axis] += step[axis];
    if (at[axis] < 0 || at[axis] >= grid.count[axis]) break;
    next[axis] += between[axis];
  }
  return sum;
}

}  // namespace

Vec3d EmissionGrid::middle(int i) const {
  const int nx = count[0], ny = count[1];
  return lo + Vec3d{i % nx + 0.5, i / nx % ny + 0.5, i / (nx * ny) + 0.5} * cell;
}

std::unique_ptr<const EmissionGrids> EmissionGrids::of(const compile::CompiledScene& world) {
  std::vector<const compile::CompiledVolume*> volumes;
  for (const compile::CompiledVolume& volume : world.volumes)
    if (world.media[volume.medium].emission) volumes.push_back(&volume);
  const double cells = std::min(most_cells / static_cast<double>(volumes.size()), most_cells_of_one);
  if (volumes.empty() || cells < least_cells_of_one) return nullptr;
  ThreadContext thread;
  std::vector<EmissionGrid> grids;
  for (const compile::CompiledVolume* volume : volumes)
    if (auto grid = grid_of(world, *volume, cells, thread)) grids.push_back(std::move(*grid));
  return grids.empty() ? nullptr : std::make_unique<const EmissionGrids>(std::move(grids));
}

double EmissionGrids::weight(const EmissionGrid& grid, const Vec3d& x) {
  return grid.power / (length_squared(grid.center - x) + grid.radius_squared);
}

double EmissionGrids::total_weight(const Vec3d& x) const {
  double total = 0;
  for (const EmissionGrid& grid : grids_) total += weight(grid, x);
  return total;
}

std::optional<EmissionGrids::Direction> EmissionGrids::sample(const Vec3d& x, float u_cell, float u0,
                                                              float u1, float u2) const {
  const double total = total_weight(x);
  if (!(total > 0)) return std::nullopt;
  double rest = u_cell * total, own = 0;
  const EmissionGrid* grid = nullptr;
  for (const EmissionGrid& one : grids_) {
    const double weight_of_one = weight(one, x);
    if (!(weight_of_one > 0)) continue;
    grid = &one;
    own = weight_of_one;
    if (rest < own) break;
    rest -= own;
  }
  const double u = std::clamp(rest / own, 0.0, one_minus_ulp);
  const auto after = std::upper_bound(grid->before.begin(), grid->before.end(), u);
  const auto i = static_cast<int>(after - grid->before.begin()) - 1;
  const Vec3d y = grid->middle(i) + (Vec3d{u0, u1, u2} - Vec3d(0.5)) * grid->cell;
  const double distance = length(y - x);
  if (!(distance > 0)) return std::nullopt;
  Direction out;
  out.direction = (y - x) / distance;
  out.pdf = pdf(x, out.direction);
  return out.pdf > 0 ? std::optional(out) : std::nullopt;
}

double EmissionGrids::pdf(const Vec3d& x, const Vec3d& direction) const {
  double sum = 0, total = 0;
  for (const EmissionGrid& grid : grids_) {
    const double own = weight(grid, x);
    total += own;
    if (own > 0) sum += own * line_density(grid, x, direction);
  }
  return total > 0 ? sum / total : 0.0;
}

}  // namespace tyndall::render
