// What is proven of a medium along a ray, without numbers: empty, uniform or varying. For skipping, which
// asks for nothing else and asks it of every ray.
//
//   for (const compile::OccupancySegment& s : walk.along(grid, medium_from_render, ray, t0, t1, step,
//   bounds)) …
//
// Planes between cells are crossed side by side, in SIMD lanes: how many of the other axes' planes come
// before one follows from its place alone, so no crossing waits for another (against Amanatides and Woo,
// Eurographics 1987, who go from cell to cell).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/majorant/majorant_grid.h"

namespace tyndall::compile {

struct OccupancySegment {
  double t0 = 0, t1 = 0;  // [m] along the ray
  CellKind kind = CellKind::varying;
};

// One axis of a grid for one ray, which meets its plane k, counted from where it starts, at first + k * apart
// [m]. The plane that bounds the grid is never crossed: what lies outside by rounding counts with the
// outermost cells.
struct WalkAxis {
  float first = 0, apart = 0, per_metre = 0;
  std::int32_t planes = 0;  // that may be crossed
  std::int32_t stride = 0;  // of the groups, from one side of a plane to the other
};

class OccupancyWalk {
 public:
  // [t0, t1) of the ray, cut where the kind changes, in groups of cells no longer than `step` [m] where that
  // is more than a cell; makes what cells it meets. Neighbours of one kind are one segment, but for uniform
  // ones with other values; each begins where the last one ended. Holds until the next call.
  std::span<const OccupancySegment> along(const MajorantGrid& grid, const Transform& medium_from_render,
                                          const Ray& ray, double t0, double t1, double step,
                                          BoundsScratch& scratch);

 private:
  // Sets the axes for a ray from a place, in groups, over a length [m]. Gives the group at its start.
  std::int32_t aim(const std::array<std::uint32_t, 3>& groups, const Vec3d& from, const Vec3d& speed,
                   double length);

  std::vector<OccupancySegment> segments_;
  std::array<WalkAxis, 3> axes_;
  // Where a group of another kind, or one whose kind says too little, is entered: [m] from the start, and the
  // group.
  std::vector<float> times_;
  std::vector<std::int32_t> groups_;
};

}  // namespace tyndall::compile
