// Grids of OpenVDB files: what is in a file, and one grid of it as voxels for lookups.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/voxels.h"

namespace tyndall::import {

// What is told of a grid of a NanoVDB file: its bytes unpacked and in the file, and how they are packed.
struct NanoEntry {
  std::uint64_t grid_bytes = 0, file_bytes = 0;
  std::uint16_t codec = 0;
};
// As the file's directory tells, before any grid is read.
struct GridEntry {
  std::string name;  // "density"; with a number, "density[1]", where a file has several of that name
  std::string type;  // "float", "half", "vec3s": as OpenVDB calls it
  bool supported = true;
  bool is_vec = false;
  // Where its entry begins, and that of the grid whose tree it shares, which may be itself.
  std::int64_t place = 0, tree_place = 0;
  std::optional<NanoEntry> nano{};
};
struct GridList {
  std::string error;  // empty: the entries are there
  std::vector<GridEntry> grids;
};
// Reads the directory of an existing file and checks it; OpenVDB itself is not needed for that.
GridList list_grids(const std::string& path);

// The names and types of a file's grids, for messages: "density (float), v (vec3s)".
std::string names_of(const GridList& list);
// The entry of that name; null when there is none.
const GridEntry* find_grid(const GridList& list, const std::string& name);

// What a grid is read for.
struct GridUse {
  // Vecs that carry something: longer ones than max_speed are cut to it. 0: to speed_limit_factor times
  // what all but a hundredth of those that are not zero stay below.
  bool is_velocity = false;
  double max_speed = 0;
  auto operator<=>(const GridUse&) const = default;
};
inline constexpr double speed_limit_factor = 8;

struct GridResult {
  std::string error;  // empty: the grid is there
  VoxelGridPointer grid{};
  std::int64_t active_voxels = 0;
  std::int64_t not_finite = 0;    // values that count as 0
  bool is_level_set = false;      // density by its interior: 1 inside, 0 outside
  bool is_rotated = false;        // or sheared
  std::array<double, 3> voxel{};  // its size [m of the file]
  // Of velocities: how many were cut to the limit, and the greatest there was [m of the file / s].
  std::int64_t slowed = 0;
  double speed_limit = 0, fastest = 0;
};
// Reads one grid of a file, in at most so many bytes of memory for what is kept and as many for what OpenVDB
// makes of the file. All errors begin "cannot read 'smoke.vdb': ".
GridResult read_grid(const std::string& path, const GridEntry& entry, std::uint64_t most_bytes,
                     const GridUse& use = {});

}  // namespace tyndall::import
