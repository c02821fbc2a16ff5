// One number a voxel, kept for lookups: what a scene's grids are made of.
//
// Voxels stand at whole coordinates, from 0 up to `size` along each axis; the outermost three are background,
// as is all beyond them: filters reach two of them, and what lies beyond is proved to be one value. They are
// kept in bricks of 8 cells a side, a cell being what lies between eight voxels: so a brick has 9 voxels a
// side, those of its far sides once more in the next brick, and an interpolation reads one brick. A brick's
// values are 16-bit steps from its lowest: they are off by half a step, 1/131070 of its range, at most; zeros
// are exact. A brick of one value has no codes. Bricks are found by two tables, of blocks of 8 bricks a side
// and of the bricks in a block; equal blocks of one value are one.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/transform.h"
#include "base/vec.h"

namespace tyndall {

using VoxelCoord = std::array<std::int32_t, 3>;

// What values lie between. `size`: the largest number that they were computed with, for rounding.
struct VoxelRange {
  float lo = 0, hi = 0, size = 0;

  void add(const VoxelRange& other);
};

// Shared and never changed once made.
struct Voxels {
  static constexpr std::int32_t brick_side = 8, brick_voxels = brick_side + 1, block_side = 8;
  static constexpr std::int32_t border = 3;
  static constexpr std::uint32_t values_a_brick = brick_voxels * brick_voxels * brick_voxels;
  static constexpr std::uint32_t codes_a_brick = values_a_brick + 1;  // whole words
  static constexpr std::uint32_t bricks_a_block = block_side * block_side * block_side;
  static constexpr std::uint32_t corners_a_brick = 64;  // parts of 2 x 2 x 2 cells
  // Along an axis: whole numbers and their eighths are exact in float.
  static constexpr std::int32_t max_size = 1 << 20;
  // Codes are found by offsets in bytes of 31 bits.
  static constexpr std::uint32_t max_stored = (1u << 31) / (2 * codes_a_brick);

  std::string name;  // "smoke.vdb density", for listings
  VoxelCoord size{}, blocks{};
  std::vector<std::uint32_t> block_at;  // numbers of blocks, x fastest
  std::vector<std::uint32_t> brick_in;  // numbers of bricks, those of a block together, x fastest
  // By brick: a value is lowest + step * code. Bricks below `stored` have codes; brick 0 is background.
  std::vector<float> lowest, highest, step;
  std::uint32_t stored = 0;
  std::vector<std::uint16_t> codes;
  std::vector<std::uint32_t> corner_codes;  // of each part of each stored brick: lowest | highest << 16
  std::vector<VoxelRange> block_ranges;     // by block
  // Of the blocks at each place, then of 8 x 8 x 8 of those before, up to one.
  struct Level {
    VoxelCoord size{};
    std::vector<VoxelRange> ranges;
  };
  std::vector<Level> levels;
  std::uint64_t hash = 0;  // of all that lookups give

  float background() const { return lowest[0]; }
  // The value of a voxel.
  float at(const VoxelCoord& voxel) const;
  // Between what all interpolations lie in the cells [first, last] of each axis, which are moved inside.
  VoxelRange range(VoxelCoord first, VoxelCoord last) const;
  std::uint64_t bytes() const;

 private:
  friend class VoxelsBuilder;
  std::uint32_t brick_at(const VoxelCoord& brick) const;
  VoxelRange brick_range(std::uint32_t brick) const { return {lowest[brick], highest[brick], 0}; }
};
using VoxelsPointer = std::shared_ptr<const Voxels>;

// Grids of a file as lookups need them.
struct VoxelGrid {
  std::vector<VoxelsPointer> components;  // one, or three of a grid of vecs
  Transform local_from_voxels, voxels_from_local;
  Vec3d first_active, last_active;  // voxels
};
using VoxelGridPointer = std::shared_ptr<const VoxelGrid>;

// Makes Voxels from what is not background: first what bricks those are in, then their values.
class VoxelsBuilder {
 public:
  // `size` as in Voxels: the border of background included.
  VoxelsBuilder(const VoxelCoord& size, float background);
  // What the tables of so many voxels need, before anything is made [bytes].
  static std::uint64_t table_bytes(const VoxelCoord& size);

  // Voxels [first, last] may be anything: the bricks that have them are asked for.
  void mark(const VoxelCoord& first, const VoxelCoord& last);
  // Voxels [first, last] are of one value.
  void fill(const VoxelCoord& first, const VoxelCoord& last, float value);
  // What the result needs at most [bytes], and whether it can be kept.
  std::uint64_t bytes() const;
  bool too_large() const { return marked_ >= Voxels::max_stored; }

  // Writes the values of the voxels [first, first + 8] to `values`, x fastest.
  using Fill = std::function<void(const VoxelCoord& first, float* values)>;
  VoxelsPointer finish(std::string name, const Fill& fill);

 private:
  static constexpr std::uint32_t pending = 0xffffffffu, constant = 0x80000000u;
  // Bricks [first, end) along each axis.
  struct Bricks {
    VoxelCoord first{}, end{};
  };
  void add(const VoxelCoord& first, const VoxelCoord& last, std::optional<float> value);
  void add_to_block(const VoxelCoord& block, const Bricks& touched, const Bricks& inside,
                    std::optional<float> value);
  std::uint32_t add_block(std::uint32_t brick);
  std::uint32_t shared_block(float value);
  std::uint32_t& entry(const VoxelCoord& brick);
  std::uint32_t constant_of(float value);
  std::uint32_t stored_brick(const std::vector<float>& values);
  void find_ranges();
  void find_hash();

  Voxels voxels_;
  std::vector<bool> is_shared_;   // by block
  std::vector<float> constants_;  // values of bricks without codes
  std::map<float, std::uint32_t> constant_of_value_, block_of_value_;
  std::uint32_t marked_ = 0;
};

}  // namespace tyndall
