// OpenVDB files with known contents, written by OpenVDB itself.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/transform.h"
#include "base/voxels.h"

namespace tyndall::import {

enum class GridType { real, half, double_, boolean, int32, int64, mask, vec3s, vec3d, vec3i, points, string };

struct FixtureGrid {
  std::string name = "density";
  GridType type = GridType::real;
  VoxelCoord first{-3, 0, 5}, last{20, 9, 17};
  // Of active voxels; a vec's components add 0, 1 and 2. None: there are no active voxels.
  std::function<double(int x, int y, int z)> value = [](int x, int y, int z) {
    return x + 0.5 * y - 0.25 * z;
  };
  double background = 0;
  Transform local_from_index{};
  // Boxes of one value besides: made of tiles where they can be.
  struct Tile {
    VoxelCoord first, last;
    double value;
  };
  std::vector<Tile> tiles{};
  // A sphere's surface in place of all this, about the origin [m].
  std::optional<double> sphere_radius{};
  bool frustum = false;
  // Voxels of the background's value stay inactive.
  bool sparse = false;
  // Set: another name and transform for the tree of that grid, which must come before.
  std::string shares_tree_of{};
};

// A small plume of smoke with its temperature: scenes/grids/plume.vdb, which the manual looks up.
std::vector<FixtureGrid> plume();
// The smoke of the gallery: scenes/grids/smoke-plume.vdb.
std::vector<FixtureGrid> smoke_column();

enum class Codec { none, zip, blosc };

void write_vdb(const std::string& path, const std::vector<FixtureGrid>& grids, Codec codec = Codec::blosc);
// As a stream, without the places of its grids.
void write_vdb_stream(const std::string& path, const FixtureGrid& grid);

// What the module that has OpenVDB exports.
struct VdbWriter {
  using Write = void (*)(const std::string& path, const std::vector<FixtureGrid>& grids, Codec codec);
  Write write, write_stream;
};

}  // namespace tyndall::import
