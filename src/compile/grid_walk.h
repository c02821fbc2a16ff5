// The cells of a majorant grid along a ray: what tracking, ratio tracking, skipping and step sizes need.
//
//   compile::GridWalk walk(*volume.grid, volume.medium_from_render, ray, interval.t0, interval.t1,
//   worker.bounds); compile::MajorantSegment s; while (walk.next(s)) …  // s.t0 of the first is interval.t0;
//   each begins where the last one ended
//
// The segments cover [t0, t1) without gaps, in order; inside one, extinction lies in [minorant, majorant] per
// metre of the ray (world units, whatever the volume's transform). Neighbours with the same bounds are one
// segment.
#pragma once

#include <array>
#include <cstdint>

#include "compile/compiled_scene.h"
#include "compile/majorant_grid.h"

namespace tyndall::compile {

struct MajorantSegment {
  double t0 = 0, t1 = 0;  // [m] along the ray
  CellBounds bounds;
};

class GridWalk {
 public:
  // Over [t0, t1) of the ray; makes what cells it meets.
  GridWalk(const MajorantGrid& grid, const Transform& medium_from_render, const Ray& ray, double t0,
           double t1, BoundsScratch& scratch);

  // The next segment, or false at the end.
  bool next(MajorantSegment& out);

 private:
  void enter_brick();
  double exit(std::size_t axis, std::int64_t low, std::int64_t count) const;
  MajorantSegment step();

  const MajorantGrid& grid_;
  BoundsScratch& scratch_;
  Vec3d origin_, direction_;  // in cells, from the grid's lowest corner
  double t_, end_;
  std::array<std::int64_t, 3> cell_{};
  const MajorantGrid::Brick* brick_ = nullptr;
  MajorantSegment ahead_;  // the segment after the last one given; empty at the end
};

}  // namespace tyndall::compile
