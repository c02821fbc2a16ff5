// Voxels: values as they were given, to half a step; ranges that hold them and are near them.
#include "base/voxels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tyndall {
namespace UNNAMED {

// A field of values in some boxes, background elsewhere, and the voxels made of it.
struct Made {
  VoxelCoord size;
  std::vector<float> values;
  VoxelsPointer voxels;

  float& value(const VoxelCoord& at) {
    return values[static_cast<std::size_t>((at[2] * size[1] + at[1]) * size[0] + at[0])];
  }
  float given(const VoxelCoord& at) { return value(at); }
};

template <class Visit>
void for_each_voxel(const VoxelCoord& first, const VoxelCoord& last, Visit&& visit) {
  for (std::int32_t z = first[2]; z <= last[2]; ++z)
    for (std::int32_t y = first[1]; y <= last[1]; ++y)
      for (std::int32_t x = first[0]; x <= last[0]; ++x) visit(VoxelCoord{x, y, z});
}

struct Box {
  VoxelCoord first, last;
  std::optional<float> value;  // none: random ones
};

Made make(const VoxelCoord& size, float background, const std::vector<Box>& boxes, float lowest = -1,
          float highest = 3) {
  Made made{size, {}, nullptr};
  made.values.assign(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                         static_cast<std::size_t>(size[2]),
                     background);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(lowest, highest);
  VoxelsBuilder builder(size, background);
  for (const Box& box : boxes) {
    for_each_voxel(box.first, box.last, [&](const VoxelCoord& at) {
      made.value(at) = box.value ? *box.value : random() % 4 == 0 ? 0 : uniform(random);
    });
    if (box.value)
      builder.fill(box.first, box.last, *box.value);
    else
      builder.mark(box.first, box.last);
  }
  made.voxels = builder.finish("test", [&](const VoxelCoord& first, float* to) {
    for_each_voxel(first, {first[0] + 8, first[1] + 8, first[2] + 8}, [&](const VoxelCoord& at) {
      const bool inside = at[0] < size[0] && at[1] < size[1] && at[2] < size[2];
      *to++ = inside ? made.value(at) : background;
    });
  });
  return made;
}

TEST(Voxels, HaveTheValuesThatWereGiven) {
  for (const float background : {0.0f, -2.5f}) {
    Made made =
        make({90, 40, 75}, background,
             {{{1, 1, 1}, {17, 9, 12}, {}}, {{60, 20, 64}, {88, 38, 73}, {}}, {{30, 8, 8}, {30, 8, 8}, {}}});
    const float most_off = 1.01f * (3 + 2.5f) / 131070;
    for_each_voxel({0, 0, 0}, {89, 39, 74}, [&](const VoxelCoord& at) {
      const float given = made.given(at), found = made.voxels->at(at);
      EXPECT_NEAR(found, given, most_off);
      if (given == 0 && background == 0) {
        EXPECT_EQ(found, 0);
      }
    });
    EXPECT_EQ(made.voxels->at({45, 20, 30}), background);
  }
}

TEST(Voxels, OfOneValueTakeNoRoom) {
  Made made = make({600, 300, 300}, 0, {{{5, 3, 9}, {590, 290, 290}, 0.7f}});
  for (const VoxelCoord at : {VoxelCoord{5, 3, 9}, {590, 290, 290}, {300, 150, 150}, {64, 128, 192}})
    EXPECT_EQ(made.voxels->at(at), 0.7f);
  for (const VoxelCoord at :
       {VoxelCoord{4, 3, 9}, {591, 290, 290}, {300, 150, 291}, {0, 0, 0}, {599, 299, 299}})
    EXPECT_EQ(made.voxels->at(at), 0);
  // Only what has both values has codes: a sheet around it, of 14,288 bricks of less than 1,750 bytes.
  EXPECT_LT(made.voxels->stored, 2u * (75 * 38 * 2 + 38 * 38));
  EXPECT_LT(made.voxels->bytes(), 14288u * 1750u);
}

TEST(Voxels, HaveRangesThatHoldThem) {
  Made made = make(
      {200, 90, 75}, 0,
      {{{1, 1, 1}, {40, 40, 40}, {}}, {{100, 60, 20}, {190, 80, 70}, {}}, {{50, 1, 1}, {80, 80, 40}, 2.0f}});
  std::mt19937 random(3);
  for (int i = 0; i < 600; ++i) {
    VoxelCoord first{}, last{}, end{};
    const int most = i % 3 == 0 ? 200 : i % 3 == 1 ? 30 : 3;
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = static_cast<std::int32_t>(random() % static_cast<unsigned>(made.size[k]));
      last[k] = std::min(first[k] + static_cast<std::int32_t>(random() % static_cast<unsigned>(most)),
                         made.size[k] - 1);
      end[k] = std::min(last[k] + 1, made.size[k] - 1);  // a cell's other side
    }
    const VoxelRange range = made.voxels->range(first, last);
    for_each_voxel(first, end, [&](const VoxelCoord& at) {
      ASSERT_LE(range.lo, made.voxels->at(at) + 1e-4f);
      ASSERT_GE(range.hi, made.voxels->at(at) - 1e-4f);
    });
    EXPECT_GE(range.size, std::max(std::fabs(range.lo), std::fabs(range.hi)));
  }
  // And that end where values do: here in parts of two cells.
  const VoxelRange one = made.voxels->range({20, 20, 20}, {20, 20, 20});
  float lowest = 9, highest = -9;
  for_each_voxel({20, 20, 20}, {22, 22, 22}, [&](const VoxelCoord& at) {
    lowest = std::min(lowest, made.voxels->at(at));
    highest = std::max(highest, made.voxels->at(at));
  });
  EXPECT_EQ(one.lo, lowest);
  EXPECT_EQ(one.hi, highest);
  const VoxelRange far_away = made.voxels->range({150, 10, 10}, {180, 40, 60});
  EXPECT_EQ(far_away.lo, 0);
  EXPECT_EQ(far_away.hi, 0);
}

// Values of extreme sizes stay finite.
TEST(Voxels, TakeExtremeValues) {
  Made made = make({20, 20, 20}, 0, {{{1, 1, 1}, {18, 18, 18}, {}}}, -1e30f, 1e30f);
  for_each_voxel({0, 0, 0}, {19, 19, 19}, [&](const VoxelCoord& at) {
    EXPECT_NEAR(made.voxels->at(at) / 1e30f, made.given(at) / 1e30f, 2e-5f);
  });
  Made tiny = make({20, 20, 20}, 0, {{{1, 1, 1}, {18, 18, 18}, {}}}, 0, 1e-44f);
  for_each_voxel({0, 0, 0}, {19, 19, 19},
                 [&](const VoxelCoord& at) { EXPECT_LE(tiny.voxels->at(at), 2e-44f); });
}

}  // namespace
}  // namespace tyndall
