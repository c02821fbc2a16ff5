// Grids of NanoVDB files: every type and packing, tiles, transforms, and files that are broken.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "import/vdb/vdb.h"
#include "nano_writer.h"
#include "support/test_folder.h"

namespace tyndall::import {
namespace UNNAMED {

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;

std::string written(const std::string& bytes) {
  const std::string path = (test_folder() / "nano.nvdb").string();
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

GridResult read(const std::string& path, const std::string& name = "density", std::uint64_t most = plenty) {
  const GridList list = list_grids(path);
  EXPECT_EQ(list.error, "");
  const GridEntry* entry = find_grid(list, name);
  return entry ? read_grid(path, *entry, most) : GridResult{.error = "no such grid"};
}

float value_at(const VoxelGrid& grid, const Vec3d& local, std::size_t component = 0) {
  const Vec3d voxel = grid.voxels_from_local.point(local);
  VoxelCoord at{};
  for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<std::int32_t>(std::lround(voxel[k]));
  const Voxels& voxels = *grid.components[component];
  for (std::size_t k = 0; k < 3; ++k)
    if (at[k] < 0 || at[k] >= voxels.size[k]) return voxels.background();
  return voxels.at(at);
}

struct Row {
  NanoType type;
  std::string_view name;
  int components;
  int leaf_steps;
  double (*meaning)(double);
};
double same(double v) { return v; }
double whole(double v) { return std::trunc(v); }
double above_zero(double v) { return v > 0 ? 1 : 0; }
// The last number: steps of a quantised leaf from its least value to its greatest; 0: it keeps its values.
const Row rows[] = {{NanoType::real, "float", 1, 0, same},
                    {NanoType::double_, "double", 1, 0, same},
                    {NanoType::int16, "int16", 1, 0, whole},
                    {NanoType::int32, "int32", 1, 0, whole},
                    {NanoType::int64, "int64", 1, 0, whole},
                    {NanoType::uint32, "uint32", 1, 0, whole},
                    {NanoType::vec3f, "Vec3f", 3, 0, same},
                    {NanoType::vec3d, "Vec3d", 3, 0, same},
                    {NanoType::boolean, "bool", 1, 0, above_zero},
                    {NanoType::fp4, "Fp4", 1, 15, same},
                    {NanoType::fp8, "Fp8", 1, 255, same},
                    {NanoType::fp16, "Fp16", 1, 65535, same},
                    {NanoType::fpn, "FpN", 1, 15, same}};

TEST(Nano, IsReadInEveryTypeAndPacking) {
  for (const Row& row : rows)
    for (const NanoCodec codec : {NanoCodec::none, NanoCodec::zip, NanoCodec::blosc}) {
      SCOPED_TRACE(row.name);
      NanoFixture fixture;
      fixture.type = row.type;
      fixture.value = [](int x, int y, int z) { return 20 + x + 0.5 * y - 0.25 * z; };
      fixture.local_from_index = Transform::translate({1, -2, 3}) * Transform::rotate({1, 2, 3}, 0.5) *
                                 Transform::scale({0.5, 1, 2});
      // No leaf holds more than from the background, 0, to the greatest value; a brick of the reader has
      // 65535 steps.
      const double greatest =
          fixture.value(fixture.last[0], fixture.last[1], fixture.first[2]) + row.components - 1;
      const double tolerance =
          (row.leaf_steps > 0 ? greatest / (2 * row.leaf_steps) : 0) + greatest / (2 * 65535.0);
      const std::string path = written(nano_file({fixture}, codec));
      EXPECT_EQ(names_of(list_grids(path)), fmt::format("density ({})", row.name));
      const GridResult result = read(path);
      ASSERT_EQ(result.error, "");
      ASSERT_EQ(result.grid->components.size(), static_cast<std::size_t>(row.components));
      EXPECT_EQ(result.active_voxels, 24 * 10 * 13);
      EXPECT_NEAR(result.voxel[2], 2, 1e-12);
      for (int z = fixture.first[2] - 1; z <= fixture.last[2] + 1; ++z)
        for (int y = fixture.first[1] - 1; y <= fixture.last[1] + 1; ++y)
          for (int x = fixture.first[0] - 1; x <= fixture.last[0] + 1; ++x) {
            const bool active = x >= fixture.first[0] && x <= fixture.last[0] && y >= fixture.first[1] &&
                                y <= fixture.last[1] && z >= fixture.first[2] && z <= fixture.last[2];
            const Vec3d local = fixture.local_from_index.point(
                {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
            for (int c = 0; c < row.components; ++c) {
              const double wanted = row.meaning((active ? fixture.value(x, y, z) : 0) + c);
              ASSERT_NEAR(value_at(*result.grid, local, static_cast<std::size_t>(c)), wanted, tolerance)
                  << x << ", " << y << ", " << z;
            }
          }
    }
}

TEST(Nano, MasksAreOneWhereTheyAreSet) {
  NanoFixture fixture;
  fixture.type = NanoType::mask;
  const GridResult result = read(written(nano_file({fixture})));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(value_at(*result.grid, {0, 0, 5}), 1);
  EXPECT_EQ(value_at(*result.grid, {20, 9, 17}), 1);
  EXPECT_EQ(value_at(*result.grid, {21, 9, 17}), 0);
}

TEST(Nano, TilesHaveTheirValue) {
  NanoFixture fixture;
  fixture.background = 0.5;
  fixture.tiles = {{{-8, 16, 8}, 8, 3}, {{128, 0, -128}, 128, 4}};
  const GridResult result = read(written(nano_file({fixture})));
  ASSERT_EQ(result.error, "");
  const auto at = [&](double x, double y, double z) { return value_at(*result.grid, {x, y, z}); };
  const double step = 30.0 / 131070;
  EXPECT_NEAR(at(-8, 16, 8), 3, step);
  EXPECT_NEAR(at(-1, 23, 15), 3, step);
  EXPECT_NEAR(at(0, 23, 15), 0.5, step);
  EXPECT_EQ(at(128, 0, -128), 4);
  EXPECT_EQ(at(255, 127, -1), 4);
  EXPECT_NEAR(at(127, 100, -1), 0.5, step);
  EXPECT_NEAR(at(5, 5, 10), 5, step);
}

TEST(Nano, ActiveVoxelsAreCounted) {
  NanoFixture fixture;
  fixture.tiles = {{{-8, 16, 8}, 8, 3}, {{128, 0, -128}, 128, 4}};
  std::string grid = nano_grid(fixture);
  constexpr std::size_t count_at = 672 + 56;  // of a tree, after its grid
  grid.replace(count_at, 8, 8, '\xff');
  const GridResult result = read(written(nano_file_of(fixture, grid, NanoCodec::none)));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.active_voxels, 24 * 10 * 13 + 8 * 8 * 8 + 128 * 128 * 128);
}

TEST(Nano, LevelSetsAreTheirInterior) {
  NanoFixture fixture;
  fixture.level_set = true;
  fixture.background = 3;
  fixture.value = [](int x, int, int) { return x - 8.25; };
  const GridResult result = read(written(nano_file({fixture})));
  ASSERT_EQ(result.error, "");
  EXPECT_TRUE(result.is_level_set);
  EXPECT_EQ(value_at(*result.grid, {7, 3, 9}), 1);
  EXPECT_NEAR(value_at(*result.grid, {8, 3, 9}), 0.75, 1e-4);
  EXPECT_EQ(value_at(*result.grid, {9, 3, 9}), 0);
}

TEST(Nano, OneOfSeveralIsRead) {
  NanoFixture density, again, flow;
  again.value = [](int, int, int) { return 7; };
  flow.name = "v";
  flow.type = NanoType::vec3f;
  const std::string path = written(nano_file({density, again}, NanoCodec::zip) + nano_file({flow}));
  EXPECT_EQ(names_of(list_grids(path)), "density (float), density[1] (float), v (Vec3f)");
  EXPECT_NEAR(value_at(*read(path, "density[1]").grid, {0, 0, 5}), 7, 1e-3);
  EXPECT_NEAR(value_at(*read(path, "v").grid, {0, 0, 8}, 2), 0, 1e-3);
}

TEST(Nano, MemoryIsLimited) {
  const std::string path = written(nano_file({NanoFixture{}}));
  EXPECT_NE(read(path, "density", 1 << 16).error.find("of memory that are left for grids"),
            std::string::npos);
}

TEST(Nano, OtherVersionsAreTold) {
  std::string bytes = nano_file({NanoFixture{}});
  const std::uint32_t old = 29u << 21;
  bytes.replace(8, 4, reinterpret_cast<const char*>(&old), 4);
  EXPECT_NE(list_grids(written(bytes)).error.find("version 29 of NanoVDB, and 32 is known"),
            std::string::npos);
}

// An error with the file's name, or a grid whose values are finite.
bool can_be_read(const std::string& bytes) {
  const std::string path = written(bytes), begin = fmt::format("cannot read '{}': ", path);
  const GridList list = list_grids(path);
  if (!list.error.empty()) {
    EXPECT_EQ(list.error.substr(0, begin.size()), begin);
    return false;
  }
  bool all = true;
  for (const GridEntry& entry : list.grids) {
    if (!entry.supported) continue;
    const GridResult result = read_grid(path, entry, std::uint64_t{64} << 20);
    all &= result.error.empty();
    if (!result.error.empty()) {
      EXPECT_EQ(result.error.substr(0, begin.size()), begin);
      continue;
    }
    for (const VoxelsPointer& voxels : result.grid->components) {
      const VoxelRange range = voxels->range({0, 0, 0}, voxels->size);
      EXPECT_TRUE(std::isfinite(range.lo) && std::isfinite(range.hi));
    }
  }
  return all;
}

TEST(HostileNano, CutOffIsTold) {
  for (const NanoCodec codec : {NanoCodec::none, NanoCodec::zip, NanoCodec::blosc}) {
    NanoFixture fixture;
    fixture.type = NanoType::fpn;
    const std::string whole = nano_file({fixture}, codec);
    EXPECT_TRUE(can_be_read(whole));
    for (std::size_t part = 1; part < 50; ++part)
      EXPECT_FALSE(can_be_read(whole.substr(0, whole.size() * part / 50))) << part;
  }
}

TEST(HostileNano, ChangedBytesDoNoHarm) {
  std::mt19937 random(1);
  int refused = 0;
  for (const NanoType type : {NanoType::real, NanoType::fpn, NanoType::vec3d, NanoType::mask})
    for (const NanoCodec codec : {NanoCodec::none, NanoCodec::blosc}) {
      NanoFixture fixture;
      fixture.type = type;
      const std::string grid = nano_grid(fixture), whole = nano_file_of(fixture, grid, codec);
      for (int i = 0; i < 60; ++i) {
        // Of the file, or of the grid before it is packed.
        const bool packed = i / 2 % 2 == 0;
        std::string changed = packed ? whole : grid;
        const std::size_t place = i % 3 == 0 ? random() % changed.size() : random() % 1200;
        const std::size_t count = std::min<std::size_t>(4, changed.size() - place);
        changed.replace(place, count, count, i % 2 == 0 ? '\xff' : '\x7f');
        refused += !can_be_read(packed ? changed : nano_file_of(fixture, changed, codec));
      }
    }
  EXPECT_GT(refused, 40);
}

}  // namespace UNNAMED
}  // namespace tyndall::import
