// Texels of pictures that are too large for memory: their values, and what looking at all of them takes.
#include "base/paged_texels.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <vector>

#include "base/parallel.h"

namespace tyndall {
namespace UNNAMED {

float texel_of(int x, int y, int channel) { return static_cast<float>(x + 3 * y + 1000 * channel); }

void fill(PagedTexels& texels, int width, int height, int channels) {
  std::vector<float> row;
  for (int y = height; y-- > 0;) {
    row.clear();
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) row.push_back(texel_of(x, y, c));
    ASSERT_EQ(texels.add_row(row), "");
  }
}

std::int64_t resident_bytes() {
  std::int64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

TEST(PagedTexels, AreWhatTheRowsSaid) {
  struct Row {
    int width, height, channels;
    std::uint64_t memory;
  };
  for (const Row& row :
       {Row{1, 1, 1, 1 << 20}, Row{33, 65, 3, 0}, Row{1000, 700, 4, 1 << 18}, Row{1000, 700, 1, 1 << 20}}) {
    PagedTexels texels(row.width, row.height, row.channels, make_tile_memory(row.memory));
    fill(texels, row.width, row.height, row.channels);
    // Down the columns, so that tiles go and come back.
    for (int x = 0; x < row.width; x += 7)
      for (int y = 0; y < row.height; ++y)
        for (int c = 0; c < row.channels; ++c) ASSERT_EQ(texels.at(x, y, c), texel_of(x, y, c));
  }
}

// Two pictures of different channels, by several threads.
TEST(PagedTexels, ShareTheirMemory) {
  const auto memory = make_tile_memory(std::uint64_t{1} << 20);
  PagedTexels gray(512, 512, 1, memory), color(512, 512, 3, memory);
  fill(gray, 512, 512, 1);
  fill(color, 512, 512, 3);
  std::vector<int> wrong(512);
  parallel_for(512, 4, [&](std::size_t column, int) {
    const int x = static_cast<int>(column);
    for (int y = 0; y < 512; ++y)
      wrong[column] += (gray.at(x, y, 0) != texel_of(x, y, 0)) + (color.at(x, y, 2) != texel_of(x, y, 2));
  });
  for (const int n : wrong) EXPECT_EQ(n, 0);
}

TEST(PagedTexels, GrowthInMemoryEndsAtTheirLimit) {
  constexpr int side = 4096;
  constexpr std::int64_t limit = std::int64_t{4} << 20;
  PagedTexels texels(side, side, 1, make_tile_memory(limit));  // 64 MB
  fill(texels, side, side, 1);
  EXPECT_EQ(texels.at(0, 0, 0), 0);
  const std::int64_t before = resident_bytes();
  float sum = 0;
  for (int y = 0; y < side; y += PagedTexels::tile_side)
    for (int x = 0; x < side; x += PagedTexels::tile_side) sum += texels.at(x, y, 0);
  EXPECT_GT(sum, 0);
  EXPECT_LT(resident_bytes() - before, 2 * limit);
}

}  // namespace UNNAMED
}  // namespace tyndall
