// Writes files of grids by OpenVDB: a module of the tests, for tests/import/fixtures.cpp.
#include "import/fixtures.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <fstream>
#include <map>

namespace tyndall::import {

namespace {

using namespace openvdb;

Coord coord(const VoxelCoord& at) { return {at[0], at[1], at[2]}; }

template <class Value>
Value value_of(double number) {
  if constexpr (VecTraits<Value>::IsVec) {
    using T = typename Value::value_type;
    return Value(static_cast<T>(number), static_cast<T>(number + 1), static_cast<T>(number + 2));
  } else if constexpr (std::is_same_v<Value, ValueMask> || std::is_same_v<Value, std::string>) {
    return Value{};
  } else if constexpr (std::is_same_v<Value, bool>) {
    return number > 0;
  } else {
    return static_cast<Value>(number);
  }
}

template <class Grid>
GridBase::Ptr filled(const FixtureGrid& fixture) {
  using Value = typename Grid::ValueType;
  typename Grid::Ptr grid = [&] {
    if constexpr (std::is_same_v<Grid, MaskGrid>)
      return Grid::create();
    else
      return Grid::create(value_of<Value>(fixture.background));
  }();
  for (const FixtureGrid::Tile& tile : fixture.tiles) {
    if constexpr (std::is_same_v<Grid, MaskGrid>)
      grid->fill(CoordBBox(coord(tile.first), coord(tile.last)), true);
    else
      grid->fill(CoordBBox(coord(tile.first), coord(tile.last)), value_of<Value>(tile.value));
  }
  if (!fixture.value) return grid;
  auto accessor = grid->getAccessor();
  for (int z = fixture.first[2]; z <= fixture.last[2]; ++z)
    for (int y = fixture.first[1]; y <= fixture.last[1]; ++y)
      for (int x = fixture.first[0]; x <= fixture.last[0]; ++x) {
        if constexpr (std::is_same_v<Grid, MaskGrid>)
          accessor.setValueOn(Coord(x, y, z));
        else if (const double value = fixture.value(x, y, z); !fixture.sparse || value != fixture.background)
          accessor.setValue(Coord(x, y, z), value_of<Value>(value));
      }
  return grid;
}

GridBase::Ptr made(const FixtureGrid& fixture) {
  if (fixture.sphere_radius)
    return tools::createLevelSetSphere<FloatGrid>(static_cast<float>(*fixture.sphere_radius),
                                                  openvdb::Vec3f(0),
                                                  static_cast<float>(fixture.local_from_index.x.x));
  switch (fixture.type) {
    case GridType::real:
      return filled<FloatGrid>(fixture);
    case GridType::half: {
      const GridBase::Ptr grid = filled<FloatGrid>(fixture);
      grid->setSaveFloatAsHalf(true);
      return grid;
    }
    case GridType::double_:
      return filled<DoubleGrid>(fixture);
    case GridType::boolean:
      return filled<BoolGrid>(fixture);
    case GridType::int32:
      return filled<Int32Grid>(fixture);
    case GridType::int64:
      return filled<Int64Grid>(fixture);
    case GridType::mask:
      return filled<MaskGrid>(fixture);
    case GridType::vec3s:
      return filled<Vec3SGrid>(fixture);
    case GridType::vec3d:
      return filled<Vec3DGrid>(fixture);
    case GridType::vec3i:
      return filled<Vec3IGrid>(fixture);
    case GridType::points:
      return points::PointDataGrid::create();
    case GridType::string:
      break;
  }
  return nullptr;
}

math::Transform::Ptr transform_of(const FixtureGrid& fixture) {
  if (fixture.frustum)
    return math::Transform::createFrustumTransform(BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 1.0);
  const tyndall::Transform& t = fixture.local_from_index;
  Mat4d rows = Mat4d::identity();
  const tyndall::Vec3d* const from[] = {&t.x, &t.y, &t.z, &t.t};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) rows(i, k) = (*from[i])[static_cast<std::size_t>(k)];
  return math::Transform::createLinearTransform(rows);
}

GridPtrVec all_of(const std::vector<FixtureGrid>& fixtures) {
  initialize();
  GridPtrVec grids;
  std::map<std::string, GridBase::Ptr> by_name;
  for (const FixtureGrid& fixture : fixtures) {
    GridBase::Ptr grid =
        fixture.shares_tree_of.empty() ? made(fixture) : by_name.at(fixture.shares_tree_of)->copyGrid();
    if (!fixture.sphere_radius) grid->setTransform(transform_of(fixture));
    grid->setName(fixture.name);
    by_name[fixture.name] = grid;
    grids.push_back(grid);
  }
  return grids;
}

void write(const std::string& path, const std::vector<FixtureGrid>& fixtures, Codec codec) {
  io::File file(path);
  const std::uint32_t masks = io::COMPRESS_ACTIVE_MASK;
  file.setCompression(codec == Codec::none  ? masks
                      : codec == Codec::zip ? masks | io::COMPRESS_ZIP
                                            : masks | io::COMPRESS_BLOSC);
  file.write(all_of(fixtures));
  file.close();
}

void write_stream(const std::string& path, const std::vector<FixtureGrid>& fixtures, Codec) {
  std::ofstream file(path, std::ios::binary);
  io::Stream(file).write(all_of(fixtures));
}

}  // namespace
}  // namespace tyndall::import

extern "C" const tyndall::import::VdbWriter tyndall_vdb_writer{tyndall::import::write,
                                                               tyndall::import::write_stream};
