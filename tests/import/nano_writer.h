// NanoVDB files with known contents, by structs as their format has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/transform.h"
#include "base/voxels.h"

namespace tyndall::import {

enum class NanoType {
  real,
  double_,
  int16,
  int32,
  int64,
  vec3f,
  vec3d,
  mask,
  uint32,
  boolean,
  fp4,
  fp8,
  fp16,
  fpn
};
inline constexpr std::size_t nano_types = static_cast<std::size_t>(NanoType::fpn) + 1;
enum class NanoCodec : std::uint16_t { none, zip, blosc };

struct NanoFixture {
  std::string name = "density";
  NanoType type = NanoType::real;
  VoxelCoord first{-3, 0, 5}, last{20, 9, 17};
  // Of active voxels; a vec's components add 0, 1 and 2.
  std::function<double(int x, int y, int z)> value = [](int x, int y, int z) {
    return x + 0.5 * y - 0.25 * z;
  };
  double background = 0;
  Transform local_from_index{};
  bool level_set = false;
  // Boxes of 8³ voxels, or of 128³, that are of one value.
  struct Tile {
    VoxelCoord origin;
    int side;
    double value;
  };
  std::vector<Tile> tiles{};
};

// The grid as it stands in memory, and files of such.
std::string nano_grid(const NanoFixture& fixture);
std::string nano_file(const std::vector<NanoFixture>& fixtures, NanoCodec codec = NanoCodec::none);
// One grid, of these bytes, which need not be what `fixture` says.
std::string nano_file_of(const NanoFixture& fixture, const std::string& grid, NanoCodec codec);

}  // namespace tyndall::import
