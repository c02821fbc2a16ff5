// Grids of OpenVDB files: every type, transform and kind of tree as voxels, and what is refused.
#include "import/vdb/vdb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "fixtures.h"
#include "support/test_folder.h"

namespace tyndall::import {
namespace {

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;

std::string file(const std::string& name) { return (test_folder() / name).string(); }

GridResult read(const std::string& path, const std::string& name = "density", std::uint64_t most = plenty) {
  const GridList list = list_grids(path);
  EXPECT_EQ(list.error, "");
  const GridEntry* entry = find_grid(list, name);
  if (!entry) {
    ADD_FAILURE() << "no grid " << name;
    return {"no grid"};
  }
  return read_grid(path, *entry, most);
}

// The value at a place of the file's space which is a voxel's.
float value_at(const VoxelGrid& grid, const Vec3d& local, std::size_t component = 0) {
  const Vec3d voxel = grid.voxels_from_local.point(local);
  VoxelCoord at{};
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = static_cast<std::int32_t>(std::lround(voxel[k]));
    EXPECT_NEAR(voxel[k], at[k], 1e-9);
  }
  const Voxels& voxels = *grid.components[component];
  for (std::size_t k = 0; k < 3; ++k)
    if (at[k] < 0 || at[k] >= voxels.size[k]) return voxels.background();
  return voxels.at(at);
}
Vec3d index(int x, int y, int z) {
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

// All voxels of the fixture, and those just beyond.
void expect_values(
    const VoxelGrid& grid, const FixtureGrid& fixture, double tolerance, std::size_t component = 0,
    const std::function<double(double)>& meaning = [](double v) { return v; }) {
  for (int z = fixture.first[2] - 1; z <= fixture.last[2] + 1; ++z)
    for (int y = fixture.first[1] - 1; y <= fixture.last[1] + 1; ++y)
      for (int x = fixture.first[0] - 1; x <= fixture.last[0] + 1; ++x) {
        const bool active = x >= fixture.first[0] && x <= fixture.last[0] && y >= fixture.first[1] &&
                            y <= fixture.last[1] && z >= fixture.first[2] && z <= fixture.last[2];
        const double wanted = active ? fixture.value(x, y, z) : fixture.background;
        ASSERT_NEAR(value_at(grid, fixture.local_from_index.point(index(x, y, z)), component),
                    meaning(wanted), tolerance)
            << x << ", " << y << ", " << z;
      }
}

TEST(Vdb, IsReadInEveryType) {
  struct Row {
    GridType type;
    std::string_view name;
    int components;
    std::function<double(double)> meaning;
  };
  const auto same = [](double v) { return v; };
  const auto whole = [](double v) { return std::trunc(v); };
  const Row rows[] = {{GridType::real, "float", 1, same},
                      {GridType::half, "half", 1, same},
                      {GridType::double_, "double", 1, same},
                      {GridType::boolean, "bool", 1, [](double v) { return v > 0 ? 1.0 : 0.0; }},
                      {GridType::int32, "int32", 1, whole},
                      {GridType::int64, "int64", 1, whole},
                      {GridType::vec3s, "vec3s", 3, same},
                      {GridType::vec3d, "vec3d", 3, same},
                      {GridType::vec3i, "vec3i", 3, whole}};
  for (const Row& row : rows)
    for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
      SCOPED_TRACE(row.name);
      FixtureGrid fixture;
      fixture.type = row.type;
      const std::string path = file("type.vdb");
      write_vdb(path, {fixture}, codec);
      EXPECT_EQ(names_of(list_grids(path)), fmt::format("density ({})", row.name));
      const GridResult result = read(path);
      ASSERT_EQ(result.error, "");
      ASSERT_EQ(result.grid->components.size(), static_cast<std::size_t>(row.components));
      EXPECT_EQ(result.active_voxels, 24 * 10 * 13);
      EXPECT_EQ(result.not_finite, 0);
      for (int c = 0; c < row.components; ++c) {
        FixtureGrid component = fixture;
        const auto shift = [c](double v) { return v + c; };
        component.value = [&](int x, int y, int z) { return shift(fixture.value(x, y, z)); };
        component.background = c;
        // Steps of a range of 30.
        expect_values(*result.grid, component, 30.0 / 131070 * 1.01, static_cast<std::size_t>(c),
                      row.meaning);
      }
    }
}

TEST(Vdb, MasksAreOneWhereTheyAreSet) {
  FixtureGrid fixture;
  fixture.type = GridType::mask;
  const std::string path = file("mask.vdb");
  write_vdb(path, {fixture});
  const GridResult result = read(path);
  ASSERT_EQ(result.error, "");
  fixture.value = [](int, int, int) { return 1; };
  expect_values(*result.grid, fixture, 1e-6);
}

TEST(Vdb, KeepsTransforms) {
  const Transform rows[] = {
      Transform::scale({0.25, 0.25, 0.25}),
      Transform::translate({-34, -13.1, 26.4}) * Transform::scale({0.476, 0.476, 0.476}),
      Transform::rotate({1, 2, -1}, 0.8) * Transform::scale({0.1, 0.2, 0.3}),
      {{1, 0.2, 0}, {0.5, 1, 0.1}, {0, -0.3, 2}, {5, 6, 7}},  // sheared
      Transform::scale({-1, 1, 1}),
  };
  for (const Transform& t : rows) {
    FixtureGrid fixture;
    fixture.local_from_index = t;
    const std::string path = file("transform.vdb");
    write_vdb(path, {fixture});
    const GridResult result = read(path);
    ASSERT_EQ(result.error, "");
    expect_values(*result.grid, fixture, 30.0 / 131070 * 1.01);
    EXPECT_NEAR(result.voxel[0], length(t.x), 1e-12);
    EXPECT_NEAR(result.voxel[2], length(t.z), 1e-12);
    // The active box.
    const Vec3d first = result.grid->local_from_voxels.point(result.grid->first_active);
    const Vec3d wanted = t.point(index(-3, 0, 5));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(first[k], wanted[k], 1e-9);
    const Vec3d size = result.grid->last_active - result.grid->first_active;
    EXPECT_EQ(size, index(23, 9, 12));
  }
}

TEST(Vdb, RefusesTransformsThatAreNotPossible) {
  FixtureGrid fixture;
  fixture.frustum = true;
  const std::string path = file("frustum.vdb");
  write_vdb(path, {fixture});
  EXPECT_NE(read(path).error.find("its transform is a frustum"), std::string::npos) << read(path).error;
  EXPECT_NE(read(path).error.find("cannot read '" + path + "'"), std::string::npos);
}

TEST(Vdb, TakesTilesForWhatTheyAre) {
  FixtureGrid fixture;
  fixture.value = nullptr;
  fixture.tiles = {{{-64, 0, 0}, {191, 127, 127}, 2}, {{0, 0, 0}, {7, 7, 7}, 3}};
  const std::string path = file("tiles.vdb");
  write_vdb(path, {fixture});
  const GridResult result = read(path);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.active_voxels, 256 * 128 * 128);
  for (const auto& [at, wanted] : {std::pair{index(-64, 0, 0), 2.0},
                                   {index(191, 127, 127), 2.0},
                                   {index(0, 0, 0), 3.0},
                                   {index(7, 7, 7), 3.0},
                                   {index(8, 7, 7), 2.0},
                                   {index(100, 64, 64), 2.0},
                                   {index(-65, 5, 5), 0.0},
                                   {index(192, 5, 5), 0.0}})
    EXPECT_NEAR(value_at(*result.grid, at), wanted, 3e-5);
  EXPECT_LT(result.grid->components[0]->bytes(), std::uint64_t{8} << 20);
}

TEST(Vdb, OfNothingIsNothing) {
  FixtureGrid fixture;
  fixture.value = nullptr;
  fixture.background = 0.5;
  const std::string path = file("empty.vdb");
  write_vdb(path, {fixture});
  const GridResult result = read(path);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.active_voxels, 0);
  EXPECT_EQ(value_at(*result.grid, index(0, 0, 0)), 0.5f);
}

// 1 inside, 0 outside, and the share of the voxel on the surface.
TEST(Vdb, LevelSetsAreTheirInterior) {
  constexpr double voxel = 0.125;  // the library computes in float
  FixtureGrid fixture;
  fixture.sphere_radius = 2;
  fixture.local_from_index = Transform::scale({voxel, voxel, voxel});
  const std::string path = file("sphere.vdb");
  write_vdb(path, {fixture});
  const GridResult result = read(path);
  ASSERT_EQ(result.error, "");
  EXPECT_TRUE(result.is_level_set);
  double volume = 0;
  for (int z = -20; z <= 20; ++z)
    for (int y = -20; y <= 20; ++y)
      for (int x = -20; x <= 20; ++x) {
        const Vec3d p = index(x, y, z) * voxel;
        const Vec3d at = result.grid->voxels_from_local.point(p);
        const Voxels& voxels = *result.grid->components[0];
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) inside &= at[k] > -0.5 && at[k] < voxels.size[k] - 0.5;
        const double found = inside ? value_at(*result.grid, p) : 0;
        EXPECT_NEAR(found, std::clamp(0.5 - (length(p) - 2) / voxel, 0.0, 1.0), 0.02);
        volume += found * voxel * voxel * voxel;
      }
  EXPECT_NEAR(volume, 4.0 / 3 * 3.14159265 * 8, 0.05);
}

TEST(Vdb, HoldsGridsOfDifferentExtents) {
  FixtureGrid a, b, c;
  b.name = "temperature";
  b.first = {100, 100, 100};
  b.last = {110, 100, 130};
  b.background = 300;
  b.value = [](int x, int, int z) { return 1000 + x + z; };
  c.name = "moved";
  c.shares_tree_of = "density";
  c.local_from_index = Transform::translate({0, 7, 0});
  const std::string path = file("several.vdb");
  write_vdb(path, {a, b, c});
  EXPECT_EQ(list_grids(path).grids.size(), 3u);
  const GridResult density = read(path), temperature = read(path, "temperature"), moved = read(path, "moved");
  ASSERT_EQ(density.error + temperature.error + moved.error, "");
  expect_values(*density.grid, a, 3e-4);
  expect_values(*temperature.grid, b, 0.01);
  a.local_from_index = c.local_from_index;
  expect_values(*moved.grid, a, 3e-4);
  EXPECT_EQ(find_grid(list_grids(path), "velocity"), nullptr);
}

TEST(Vdb, ToldTypesThatCannotBeLookedUp) {
  FixtureGrid points;
  points.type = GridType::points;
  points.name = "points";
  const std::string path = file("points.vdb");
  write_vdb(path, {FixtureGrid{}, points});
  const GridList list = list_grids(path);
  ASSERT_EQ(list.grids.size(), 2u);
  EXPECT_FALSE(find_grid(list, "points")->supported);
  EXPECT_TRUE(find_grid(list, "density")->supported);
  EXPECT_EQ(read(path).error, "");
}

TEST(Vdb, CountsWhatIsNotFinite) {
  FixtureGrid fixture;
  fixture.value = [](int x, int y, int z) {
    return x == 3 && y == 2 ? z == 7 ? std::nan("") : z == 8 ? 1e38 : z == 9 ? HUGE_VAL : 1.0 : 1.0;
  };
  const std::string path = file("nan.vdb");
  write_vdb(path, {fixture});
  const GridResult result = read(path);
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.not_finite, 3);
  EXPECT_EQ(value_at(*result.grid, index(3, 2, 7)), 0);
  EXPECT_EQ(value_at(*result.grid, index(3, 2, 9)), 0);
}

TEST(Vdb, StaysInItsMemory) {
  FixtureGrid fixture;
  fixture.last = {100, 100, 100};
  const std::string path = file("memory.vdb");
  write_vdb(path, {fixture});
  EXPECT_NE(read(path, "density", 100 << 10).error.find("memory"), std::string::npos);
  FixtureGrid far_away;
  far_away.value = nullptr;
  far_away.tiles = {{{-2000000000, 0, 0}, {-2000000000, 0, 0}, 1},
                    {{2000000000, 5, 5}, {2000000000, 5, 5}, 1}};
  write_vdb(path, {far_away});
  EXPECT_NE(read(path).error.find("lie 4000000000 apart"), std::string::npos) << read(path).error;
  far_away.tiles = {{{-500000, 0, -500000}, {-500000, 0, -500000}, 1},
                    {{500000, 500000, 500000}, {500000, 500000, 500000}, 1}};
  write_vdb(path, {far_away});
  EXPECT_NE(read(path).error.find("memory"), std::string::npos) << read(path).error;
}

TEST(Vdb, ToldStreamsAndOtherFiles) {
  const std::string path = file("stream.vdb");
  write_vdb_stream(path, FixtureGrid{});
  EXPECT_NE(list_grids(path).error.find("written as a stream"), std::string::npos) << list_grids(path).error;
  const std::string text = file("text.vdb");
  std::ofstream(text) << "no grid at all, but long enough for a header of a file of grids";
  EXPECT_EQ(list_grids(text).error, fmt::format("cannot read '{}': it is no OpenVDB file", text));
  const std::string nano = file("smoke.nvdb");
  std::ofstream(nano) << "NanoVDB0 and what comes then";
  EXPECT_NE(list_grids(nano).error.find("of NanoVDB, and 32 is known"), std::string::npos)
      << list_grids(nano).error;
  const std::string empty = file("nothing.vdb");
  std::ofstream(empty).close();
  EXPECT_NE(list_grids(empty).error, "");
}

// The scenes' grids are what these say. After a change of them: copy the file that this test leaves.
TEST(Vdb, TheScenesGridsAreCurrent) {
  const std::pair<std::string, std::vector<FixtureGrid>> files[] = {{"plume.vdb", plume()},
                                                                    {"smoke-plume.vdb", smoke_column()}};
  for (const auto& [name, fixtures] : files) {
    write_vdb(file(name), fixtures, Codec::zip);
    for (const FixtureGrid& fixture : fixtures) {
      const GridResult result = read(TYNDALL_SOURCE_DIR "/scenes/grids/" + name, fixture.name);
      ASSERT_EQ(result.error, "");
      expect_values(*result.grid, fixture, fixture.background == 0 ? 6e-4 : 1);
    }
  }
}

}  // namespace
}  // namespace tyndall::import
