// Planes made of rows: the same in memory and in a temporary file; what is not a number, and what is
// negative.
#include "image/plane_maker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <thread>

namespace tyndall::image {
namespace UNNAMED {

constexpr int width = 1500, height = 700;

float number(int x, int y, int channel) {
  const auto u = [](int i) { return static_cast<std::uint32_t>(i); };
  const std::uint32_t mixed = u(x) * 73856093u ^ u(y) * 19349663u ^ u(channel) * 83492791u;
  return static_cast<float>(mixed >> 8) * 0x1p-20f;
}

std::vector<PlanePointer> made(PlaneMaker& maker) {
  EXPECT_EQ(maker.begin({width, height, {"R", "G", "B", "Z"}, {0, 2, 3}, {}}), "");
  std::vector<float> row(3 * width);
  for (int y = 0; y < height; ++y) {
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = number(static_cast<int>(i) / 3, y, static_cast<int>(i) % 3);
    maker.row(row);
  }
  std::string error;
  auto planes = maker.finish(error);
  EXPECT_EQ(error, "");
  return planes;
}

TEST(PlaneMaker, KeepsLargePicturesInAFile) {
  PictureMemory plenty, little(PictureMemory::least);
  PlaneMaker in_memory("sky.exr", PlaneMaker::Negative::cleared, plenty),
      in_file("sky.exr", PlaneMaker::Negative::cleared, little);
  const auto known = made(in_memory), paged = made(in_file);
  ASSERT_EQ(known.size(), 3u);
  ASSERT_EQ(paged.size(), 3u);
  EXPECT_FALSE(in_memory.is_paged());
  EXPECT_TRUE(in_file.is_paged());
  EXPECT_EQ(known[1]->name, "sky.exr B");
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(paged[k]->name, known[k]->name);
    EXPECT_EQ(paged[k]->lowest, known[k]->lowest);
    EXPECT_EQ(paged[k]->highest, known[k]->highest);
    EXPECT_TRUE(paged[k]->texels.empty());
  }
  // Anywhere, by several threads at once that share the memory of tiles.
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < 4; ++seed)
    threads.emplace_back([&, seed] {
      std::mt19937 random(seed);
      for (int i = 0; i < 20000; ++i) {
        const int x = static_cast<int>(random() % width), y = static_cast<int>(random() % height);
        const auto k = static_cast<std::size_t>(random() % 3);
        // Rows of planes count from the bottom.
        ASSERT_EQ(paged[k]->at(x, y), number(x, height - 1 - y, static_cast<int>(k)));
        ASSERT_EQ(known[k]->at(x, y), paged[k]->at(x, y));
      }
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(PlaneMaker, ClearsWhatIsNoLight) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const bool clears : {true, false}) {
    PictureMemory memory;
    PlaneMaker maker("a", clears ? PlaneMaker::Negative::cleared : PlaneMaker::Negative::kept, memory);
    EXPECT_EQ(maker.begin({2, 2, {"R"}, {0}, {}}), "");
    maker.row(std::array{nan, -1.0f});
    maker.row(std::array{2.0f, std::numeric_limits<float>::infinity()});
    std::string error;
    const auto planes = maker.finish(error);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_EQ(maker.not_finite(), 2u);
    EXPECT_EQ(maker.negative(), clears ? 1u : 0u);
    EXPECT_EQ(planes[0]->texels, (std::vector<float>{2, 0, 0, clears ? 0.0f : -1.0f}));
  }
}

TEST(PlaneMaker, RefusesWhatNoFileHolds) {
  PictureMemory memory;
  PlaneMaker maker("a", PlaneMaker::Negative::kept, memory);
  EXPECT_NE(maker.begin({1 << 20, 1 << 20, {"R"}, {0}, {}}).find("GB of a temporary file"),
            std::string::npos);
}

}  // namespace UNNAMED
}  // namespace tyndall::image
