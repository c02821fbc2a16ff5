// What is proven of a medium along a ray, without numbers: empty, uniform or varying. For skipping, which
// asks for nothing else and asks it of every ray.
//
//   compile::KindWalk walk(grid, volume.medium_from_render_at(ray.time), ray, stay.t0, stay.t1, step,
//   worker.bounds); compile::KindSegment s; while (walk.next(s)) …  // s.t0 of the first is stay.t0; each
//   begins where the last one ended
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "compile/compiled_scene.h"
#include "compile/majorant_grid.h"

namespace tyndall::compile {

struct KindSegment {
  double t0 = 0, t1 = 0;  // [m] along the ray
  CellKind kind = CellKind::varying;
};

// Neighbours of one kind are one segment, but for uniform ones with other values.
class KindWalk {
 public:
  // Over [t0, t1) of the ray, in groups of cells no longer than `step` [m] where that is more than a cell;
  // makes what cells it meets.
  KindWalk(const MajorantGrid& grid, const Transform& medium_from_render, const Ray& ray, double t0,
           double t1, double step, BoundsScratch& scratch);

  // The next segment, or false at the end.
  bool next(KindSegment& out);

 private:
  // The ray meets plane k of an axis, counted from where it starts, at first + k * apart.
  struct Axis {
    double first, apart, leave;  // leave: the next plane; infinite before the grid's end
    double crossed;              // planes
    std::int32_t left;           // groups from here to the grid's end
    std::ptrdiff_t stride;
  };

  const MajorantGrid& grid_;
  BoundsScratch& scratch_;
  std::array<Axis, 3> axes_{};
  double t_, end_;
  int level_ = 0;
  std::size_t index_ = 0;  // of the group at t_
};

}  // namespace tyndall::compile
