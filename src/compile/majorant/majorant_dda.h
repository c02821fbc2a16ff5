// The cells of a majorant grid along a ray: what tracking, ratio tracking and step sizes need.
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
#include "compile/majorant/majorant_grid.h"

namespace tyndall::compile {

struct MajorantSegment {
  double t0 = 0, t1 = 0;  // [m] along the ray
  CellBounds bounds;
};

class MajorantDda {
 public:
  // Over [t0, t1) of the ray; makes what cells it meets.
  MajorantDda(const MajorantGrid& grid, const Transform& medium_from_render, const Ray& ray, double t0,
              double t1, BoundsScratch& scratch);

  // The next segment, or false at the end.
  bool next(MajorantSegment& out);

 private:
  // Planes are numbered like the cells above them: `plane` is the next one that the ray meets, `leave` is
  // when. The block begins at cell `low` and ends after `left` planes more.
  struct Axis {
    double origin, speed, inverse;  // of the ray, in cells from the grid's lowest corner
    double leave;
    std::int32_t plane, last, left, low, stride;  // stride: in a brick's cells
    bool up;
  };
  void aim(Axis& axis) const;
  void enter(const std::array<std::int32_t, 3>& cell);
  void leave(std::size_t along);
  MajorantSegment step();

  const MajorantGrid& grid_;
  BoundsScratch& scratch_;
  std::array<Axis, 3> axes_{};
  double t_, end_;
  const MajorantGrid::Brick* brick_ = nullptr;
  std::array<std::int32_t, 3> brick_at_{};
  std::int32_t inner_ = 0;  // the cell in the brick
  std::int32_t width_ = 0;  // of the block, in cells
  bool one_step_ = false;   // the block is passed as one
  MajorantSegment ahead_;   // the segment after the last one given; empty at the end
};

}  // namespace tyndall::compile
