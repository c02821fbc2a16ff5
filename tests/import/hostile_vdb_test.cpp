// Files that are cut off, or whose bytes were changed: an error with the file and a reason, or a grid;
// nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "fixtures.h"
#include "import/vdb/vdb.h"
#include "support/test_folder.h"

// OpenVDB's root node does not let go of the child that it is making when an exception leaves it, which is
// how every broken file ends: the leak checker is not to tell of that.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libopenvdb"; }

namespace tyndall::import {
namespace UNNAMED {

constexpr std::uint64_t most = std::uint64_t{64} << 20;

std::string bytes_of(Codec codec) {
  FixtureGrid scalar, vec, tiles;
  scalar.type = GridType::half;
  vec.name = "v";
  vec.type = GridType::vec3s;
  vec.local_from_index = Transform::rotate({1, 1, 0}, 0.4);
  tiles.name = "tiles";
  tiles.tiles = {{{0, 0, 0}, {63, 31, 31}, 2}};
  const std::string path = test_folder().string() + "/whole.vdb";
  write_vdb(path, {scalar, vec, tiles}, codec);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Whether all grids can be read; errors must name the file and say why.
bool can_be_read(const std::string& bytes) {
  const std::string path = test_folder().string() + "/hostile.vdb";
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const auto good = [&](const std::string& error) {
    if (error.empty()) return true;
    const std::string begin = fmt::format("cannot read '{}': ", path);
    EXPECT_EQ(error.substr(0, begin.size()), begin);
    EXPECT_GT(error.size(), begin.size() + 5) << error;
    return false;
  };
  const GridList list = list_grids(path);
  bool all = good(list.error);
  for (const GridEntry& entry : list.grids) {
    if (!entry.supported) continue;
    const GridResult result = read_grid(path, entry, most);
    all &= good(result.error);
    if (!result.error.empty()) continue;
    for (const VoxelsPointer& voxels : result.grid->components) {
      const VoxelRange range = voxels->range({0, 0, 0}, voxels->size);
      EXPECT_TRUE(std::isfinite(range.lo) && std::isfinite(range.hi));
    }
  }
  return all;
}

TEST(HostileVdb, CutOffIsToldAtEveryLength) {
  for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
    const std::string whole = bytes_of(codec);
    EXPECT_TRUE(can_be_read(whole));
    for (std::size_t part = 0; part < 50; ++part)
      EXPECT_FALSE(can_be_read(whole.substr(0, whole.size() * part / 50))) << part << " of 50";
    EXPECT_FALSE(can_be_read(whole.substr(0, whole.size() - 1)));
  }
}

TEST(HostileVdb, ChangedBytesDoNoHarm) {
  std::mt19937 random(1);
  int refused = 0;
  for (const Codec codec : {Codec::none, Codec::zip, Codec::blosc}) {
    const std::string whole = bytes_of(codec);
    for (int i = 0; i < 100; ++i) {
      std::string changed = whole;
      // Most of them where the directory and the trees begin.
      const std::size_t place = i % 2 == 0 ? random() % changed.size() : random() % 1200;
      if (i % 3 == 0)
        changed[place] = static_cast<char>(random());
      else
        changed.replace(place, std::min<std::size_t>(4, changed.size() - place),
                        std::min<std::size_t>(4, changed.size() - place), i % 3 == 1 ? '\xff' : '\x7f');
      refused += !can_be_read(changed);
    }
  }
  EXPECT_GT(refused, 40);
}

// Lengths and counts that no file has.
TEST(HostileVdb, CountsBeyondTheFileAreTold) {
  const std::string whole = bytes_of(Codec::none);
  for (std::size_t place = 0; place + 8 < 900; place += 5) {
    std::string changed = whole;
    changed.replace(place, 8, 8, place % 2 == 0 ? '\x3f' : '\xff');
    can_be_read(changed);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::import
