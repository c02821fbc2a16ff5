// Proven bounds of a medium's coefficients over the cells of a grid: empty space, uniform regions, majorants
// and minorants of extinction without any number from the user.
//
// The bounds come from the medium's own program run on intervals (vm/interval/interval.h), so they hold for
// whatever the program gives at any point of the cell and any time of the grid's interval, after the
// renderer's clamping (negative and NaN to 0, at most largest_coefficient). Cells are made brick by brick,
// where rays come first; a brick is a pure function of its place, so it does not matter which ray or thread
// was first.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/interval.h"
#include "base/transform.h"
#include "base/vec.h"
#include "compile/geometry/shape_hit.h"
#include "scene/medium.h"
#include "vm/interval/interval.h"

namespace tyndall::compile {

using scene::largest_coefficient;

// What is proven about a cell. Empty: extinction, scattering and emission are all exactly 0, and no value is
// bad. Uniform: every output of the program is one value to rounding.
enum class CellKind : std::uint8_t { empty, uniform, varying };
// Bounds of extinction [1/m of world space], over all channels; `spread` is the largest difference in one
// channel.
struct CellBounds {
  float minorant = 0, majorant = 0, spread = 0;
  CellKind kind = CellKind::varying;

  bool operator==(const CellBounds&) const = default;
};

// One thread's scratch for making cells.
struct BoundsScratch {
  vm::IntervalMachine machine;
  std::array<std::vector<float>, 6> p, world;  // lowest x y z, highest x y z
  std::vector<vm::ValueBounds> values;
  std::vector<std::uint32_t> loose;
};

class MajorantGrid {
 public:
  // Where a grid holds. Two volumes with the same medium and an equal domain share one.
  struct Domain {
    Bounds box;  // in the medium's space p
    // Set when the program reads P: where p is in the world, at the ends of ways when it moves.
    std::vector<Transform> world_from_medium;
    Interval<float> time;     // both ends included: one slab of the shutter, or one moment
    std::uint32_t cells = 0;  // at most, over the whole box
    // Ways are off from straight lines by no more than `bend` times the distance from `pivot`.
    double bend = 0;
    Vec3d pivot{};
    bool operator==(const Domain&) const = default;
  };

  // Keeps a reference to the medium. Makes no cells yet.
  MajorantGrid(const scene::Medium& medium, const Domain& domain);
  ~MajorantGrid();
  MajorantGrid(const MajorantGrid&) = delete;
  MajorantGrid& operator=(const MajorantGrid&) = delete;

  static constexpr std::uint32_t brick_side = 8, brick_cells = brick_side * brick_side * brick_side;
  static constexpr std::uint32_t block_side = 4;  // eight blocks a brick
  static constexpr std::uint32_t block_of(std::uint32_t cell) {
    return (cell >> 8 & 1) << 2 | (cell >> 5 & 1) << 1 | (cell >> 2 & 1);
  }
  // Groups of cells are cubes of 1, 2, 4 or 8 cells a side; level is the logarithm.
  static constexpr int levels = 4;
  static constexpr std::size_t bytes_per_cell = sizeof(float) * 3 + 3;

  // What a brick is as a whole; its cells are there only where the whole says too little.
  struct Brick {
    CellBounds whole;
    struct Cells {
      std::array<float, brick_cells> minorant, majorant, spread;
      std::array<CellKind, brick_cells> kind;
      std::array<bool, 8> empty_block;
    };
    std::unique_ptr<Cells> cells;

    CellBounds cell(std::uint32_t i) const {
      if (!cells) return whole;
      return {cells->minorant[i], cells->majorant[i], cells->spread[i], cells->kind[i]};
    }
  };

  const scene::Medium& medium() const { return *medium_; }
  // Refers from now on to another medium that gives the same.
  void refer_to(const scene::Medium& medium) { medium_ = &medium; }
  const Domain& domain() const { return domain_; }
  // Bricks along each axis; cells are brick_side times as many.
  const std::array<std::uint32_t, 3>& bricks() const { return bricks_; }
  std::uint32_t brick_count() const { return bricks_[0] * bricks_[1] * bricks_[2]; }
  Vec3d cell_size() const { return cell_size_; }

  // The brick at these coordinates, made now when no one has been there. Any thread, any time.
  const Brick& brick(std::uint32_t x, std::uint32_t y, std::uint32_t z, BoundsScratch& scratch) const {
    const std::size_t i = (std::size_t{z} * bricks_[1] + y) * bricks_[0] + x;
    const Brick* known = made_[i].load(std::memory_order_acquire);
    return known ? *known : make(i, {x, y, z}, scratch);
  }
  static constexpr std::uint8_t unknown = 0xff;  // the kind of a group that no one has asked for
  // Groups along each axis, x fastest in their order.
  std::array<std::uint32_t, 3> groups(int level) const {
    const std::uint32_t a_brick = brick_side >> level;
    return {bricks_[0] * a_brick, bricks_[1] * a_brick, bricks_[2] * a_brick};
  }
  // What is proven of all of a group's cells together, in a look at a level's groups.
  class Kinds {
   public:
    CellKind at(std::size_t group, BoundsScratch& scratch) const {
      const std::uint8_t known = known_[group].load(std::memory_order_relaxed);
      return known != unknown ? static_cast<CellKind>(known) : grid_->make_kind(level_, group, scratch);
    }

    // The kind, or `unknown`; makes nothing.
    std::uint8_t known(std::size_t group) const { return known_[group].load(std::memory_order_relaxed); }

   private:
    friend class MajorantGrid;
    Kinds(const MajorantGrid* grid, int level)
        : grid_(grid), known_(grid->kinds_[static_cast<std::size_t>(level)].data()), level_(level) {}

    const MajorantGrid* grid_;
    const std::atomic<std::uint8_t>* known_;  // does not move
    int level_;
  };
  Kinds kinds(int level) const { return {this, level}; }
  // Whether two uniform groups have the same bounds.
  bool same_values(int level, std::size_t a, std::size_t b, BoundsScratch& scratch) const;
  // Looks at every block as a whole. To be called once, before rays come.
  void survey(BoundsScratch& scratch);
  // After it: the share of blocks that are proved empty or uniform,
  double plain_share() const { return plain_share_; }
  // the largest majorant of a block [1/m],
  float majorant() const { return majorant_; }
  // and what of a stay on a ray in the medium's space, of any direction but zero, may hold anything: what
  // lies outside the box around all blocks that are not proved empty does not. Empty when nothing may.
  Intervald occupied_part(const Vec3d& origin, const Vec3d& direction, Intervald stay) const {
    if (occupied_.lo.x > occupied_.hi.x) return {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double lo = occupied_.lo[axis] - origin[axis], hi = occupied_.hi[axis] - origin[axis];
      if (direction[axis] == 0) {
        if (lo > 0 || hi < 0) return {};
        continue;
      }
      const double inverse = 1 / direction[axis], a = lo * inverse, b = hi * inverse;
      stay.lo = std::max(stay.lo, std::min(a, b));
      stay.hi = std::min(stay.hi, std::max(a, b));
    }
    return stay;
  }
  // The cell that holds p, which is moved into the box when it lies outside.
  CellBounds at(const Vec3d& p, BoundsScratch& scratch) const;

 private:
  const Brick& make(std::size_t index, const std::array<std::uint32_t, 3>& at, BoundsScratch& scratch) const;
  // The first cell of a group.
  std::array<std::uint32_t, 3> cell_of(int level, std::size_t group) const;
  CellKind make_kind(int level, std::size_t group, BoundsScratch& scratch) const;
  void note_kinds(const std::array<std::uint32_t, 3>& at, const Brick& brick) const;
  std::unique_ptr<Brick> computed(const std::array<std::uint32_t, 3>& at, BoundsScratch& scratch) const;
  void evaluate(std::size_t boxes, BoundsScratch& scratch) const;
  void refine(Brick::Cells& cells, BoundsScratch& scratch) const;
  void add_box(const Vec3d& lo, const Vec3d& hi, BoundsScratch& scratch) const;
  CellBounds summary(std::size_t first, std::size_t count, std::size_t boxes,
                     const BoundsScratch& scratch) const;

  const scene::Medium* medium_;
  Domain domain_;
  std::array<std::uint32_t, 3> bricks_{};
  Vec3d cell_size_;
  double plain_share_ = 0;
  float majorant_ = largest_coefficient;
  Bounds occupied_;                         // whole blocks and a little more; of the domain before the survey
  std::vector<std::uint8_t> coefficients_;  // outputs that are not negative: extinction, scattering, emission
  std::vector<std::size_t> quantities_;     // outputs but those that say which branch was taken
  mutable std::vector<std::atomic<Brick*>> made_;
  // By level and group; functions of the place, so whoever writes one writes the same.
  mutable std::array<std::vector<std::atomic<std::uint8_t>>, levels> kinds_;
};

}  // namespace tyndall::compile
