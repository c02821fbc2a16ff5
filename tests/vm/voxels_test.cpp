// Lookups in voxels: by every filter the machine, the reference and folding agree and follow the definition,
// and bounds hold them.
#include "base/voxels.h"

#include <gtest/gtest.h>

#include "support.h"
#include "vm/interval/interval.h"

namespace tyndall::vm {
namespace UNNAMED {

constexpr Op filters[] = {Op::voxels, Op::voxels_nearest, Op::voxels_cubic};
constexpr VoxelCoord size{70, 33, 25};

// Random values in two boxes, one value in a third.
VoxelsPointer test_voxels(float background = 0) {
  VoxelsBuilder builder(size, background);
  builder.mark({3, 3, 3}, {20, 28, 20});
  builder.mark({40, 10, 10}, {66, 29, 21});
  builder.fill({22, 3, 3}, {38, 29, 21}, 1.25f);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1, 3);
  std::vector<float> values;
  for (int i = 0; i < size[0] * size[1] * size[2]; ++i) values.push_back(uniform(random));
  const auto in = [](int x, int y, int z, const VoxelCoord& first, const VoxelCoord& last) {
    return x >= first[0] && x <= last[0] && y >= first[1] && y <= last[1] && z >= first[2] && z <= last[2];
  };
  return builder.finish("test", [&](const VoxelCoord& first, float* to) {
    for (int z = first[2]; z <= first[2] + 8; ++z)
      for (int y = first[1]; y <= first[1] + 8; ++y)
        for (int x = first[0]; x <= first[0] + 8; ++x) {
          const bool random_one =
              in(x, y, z, {3, 3, 3}, {20, 28, 20}) || in(x, y, z, {40, 10, 10}, {66, 29, 21});
          *to++ = random_one ? values[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)]
                  : in(x, y, z, {22, 3, 3}, {38, 29, 21}) ? 1.25f
                                                          : background;
        }
  });
}

Program lookup(Op op, const VoxelsPointer& voxels) {
  Builder builder;
  const NodeId out =
      builder.emit(op, {builder.input(Input::p_x), builder.input(Input::p_y), builder.input(Input::p_z)}, {},
                   0, builder.voxels(voxels));
  return *builder.finish(std::span(&out, 1));
}

float at(Op op, const VoxelsPointer& voxels, float x, float y, float z) {
  return evaluate_lane(op, std::array{x, y, z}, 0, 0, {.planes = {}, .voxels = {voxels}});
}

// The weights of the voxels around a coordinate, from the voxel `first` on.
struct Weights {
  int first;
  std::vector<double> weights;
};
Weights weights_of(Op op, double x, int n) {
  x = std::clamp(x, 0.0, static_cast<double>(n - 1));
  const int cell = static_cast<int>(std::floor(x));
  const double t = x - cell;
  if (op == Op::voxels_nearest) return {static_cast<int>(std::floor(x + 0.5)), {1}};
  if (op == Op::voxels) return {cell, {1 - t, t}};
  return {cell - 1,
          {(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
           (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6}};
}
double by_definition(Op op, const Voxels& voxels, const std::array<double, 3>& p) {
  std::array<Weights, 3> along;
  for (std::size_t k = 0; k < 3; ++k) along[k] = weights_of(op, p[k], voxels.size[k]);
  double sum = 0;
  for (std::size_t z = 0; z < along[2].weights.size(); ++z)
    for (std::size_t y = 0; y < along[1].weights.size(); ++y)
      for (std::size_t x = 0; x < along[0].weights.size(); ++x) {
        VoxelCoord voxel{along[0].first + static_cast<int>(x), along[1].first + static_cast<int>(y),
                         along[2].first + static_cast<int>(z)};
        for (std::size_t k = 0; k < 3; ++k) voxel[k] = std::clamp(voxel[k], 0, voxels.size[k] - 1);
        sum += along[0].weights[x] * along[1].weights[y] * along[2].weights[z] *
               static_cast<double>(voxels.at(voxel));
      }
  return sum;
}

TEST(VoxelLookups, FollowTheirDefinition) {
  const VoxelsPointer voxels = test_voxels();
  std::mt19937 random(1);
  std::uniform_real_distribution<float> x(-3, 73), y(-3, 36), z(-3, 28);
  for (const Op op : filters)
    for (int i = 0; i < 4000; ++i) {
      const std::array<float, 3> p{x(random), y(random), z(random)};
      // Neighbours in two bricks are rounded differently: half a step of 4 / 65535 each.
      EXPECT_NEAR(at(op, voxels, p[0], p[1], p[2]), by_definition(op, *voxels, {p[0], p[1], p[2]}), 8e-5)
          << op_info(op).name << " at " << p[0] << ", " << p[1] << ", " << p[2];
    }
  EXPECT_EQ(at(Op::voxels, voxels, 30, 15, 12), 1.25f);
  EXPECT_EQ(at(Op::voxels_cubic, voxels, 30.5f, 15.3f, 12), 1.25f);
  EXPECT_EQ(at(Op::voxels_nearest, voxels, 30.4f, 15, 12), 1.25f);
}

// Each voxel has its own value at its place, but for the smooth filter.
TEST(VoxelLookups, GiveVoxelsAtWholeCoordinates) {
  const VoxelsPointer voxels = test_voxels(0.5f);
  for (int z = 0; z < size[2]; ++z)
    for (int y = 0; y < size[1]; ++y)
      for (int x = 0; x < size[0]; ++x)
        for (const Op op : {Op::voxels, Op::voxels_nearest})
          ASSERT_EQ(at(op, voxels, static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)),
                    voxels->at({x, y, z}));
}

// To half a step of the bricks at the border, and exactly where that is 0.
TEST(VoxelLookups, AreBackgroundBeyondTheBox) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (const float background : {0.0f, -0.75f}) {
    const VoxelsPointer voxels = test_voxels(background);
    const double tolerance = background == 0 ? 0 : 4.0 / 131070;
    for (const Op op : filters)
      for (const float far_away : {-1.0f, -1e30f, -inf, 200.0f, 1e30f, inf, std::nanf("")}) {
        EXPECT_NEAR(at(op, voxels, far_away, 10, 10), background, tolerance);
        EXPECT_NEAR(at(op, voxels, 10, far_away, 10), background, tolerance);
        EXPECT_NEAR(at(op, voxels, 10, 10, far_away), background, tolerance);
      }
  }
}

TEST(VoxelLookups, AgreeInEverySimdClass) {
  const VoxelsPointer voxels = test_voxels();
  for (const Op op : filters) {
    std::vector<std::array<float, 4>> rows = awkward_operands(op, 2000);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-3, 75);
    for (int i = 0; i < 2000; ++i)
      rows.push_back({uniform(random), uniform(random) / 2, uniform(random) / 3, 0});
    const Lanes lanes(rows);
    const Program program = lookup(op, voxels);
    std::vector<float> expected(lanes.size());
    float* const output = expected.data();
    run_reference(program, lanes.from(0), lanes.size(), std::span(&output, 1));
    for_each_simd_class([&](const std::string&) {
      Machine machine;
      const std::vector<float> found = run(machine, program, lanes.from(0), lanes.size());
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_TRUE(same(found[i], expected[i])) << rows[i][0] << ", " << rows[i][1] << ", " << rows[i][2];
    });
  }
}

TEST(VoxelLookups, LieInTheirBounds) {
  std::mt19937 random(11);
  const auto uniform = [&](float lo, float hi) {
    return std::uniform_real_distribution<float>(lo, hi)(random);
  };
  for (const float background : {0.0f, 0.5f}) {
    const VoxelsPointer voxels = test_voxels(background);
    for_each_simd_class([&](const std::string&) {
      for (const Op op : filters)
        for (int i = 0; i < 1500; ++i) {
          std::array<ValueBounds, 3> box;
          for (std::size_t k = 0; k < 3; ++k) {
            const float n = static_cast<float>(size[k]);
            const float center = i % 5 == 0 ? std::round(uniform(0, n)) : uniform(-5, n + 5);
            const float radius = i % 7 == 0 ? 0 : std::exp(uniform(-9, 4));
            box[k] = {center - radius, center + radius, i % 11 == 0};
          }
          const ValueBounds bound = evaluate_bounds(op, box, 0, 0, {.planes = {}, .voxels = {voxels}});
          EXPECT_FALSE(bound.may_be_nan);
          for (int j = 0; j < 60; ++j) {
            std::array<float, 3> p{};
            for (std::size_t k = 0; k < 3; ++k) {
              p[k] = j < 8    ? (j >> k & 1 ? box[k].hi : box[k].lo)
                     : j < 20 ? std::clamp(std::round(uniform(box[k].lo, box[k].hi)), box[k].lo, box[k].hi)
                              : std::clamp(uniform(box[k].lo, box[k].hi), box[k].lo, box[k].hi);
              if (box[k].may_be_nan && j % 13 == 0) p[k] = std::nanf("");
            }
            const float value = at(op, voxels, p[0], p[1], p[2]);
            ASSERT_TRUE(bound.covers(value))
                << op_info(op).name << " " << value << " in [" << bound.lo << ", " << bound.hi << "] at "
                << p[0] << ", " << p[1] << ", " << p[2];
          }
        }
    });
  }
}

// What lies outside of all values is proved to be nothing, and one value to be that.
TEST(VoxelLookups, HaveExactBoundsWhereNothingVaries) {
  const VoxelsPointer voxels = test_voxels();
  for (const Op op : filters) {
    const auto bound = [&](float x, float y, float z, float radius) {
      const std::array<ValueBounds, 3> box{{{x - radius, x + radius, false},
                                            {y - radius, y + radius, false},
                                            {z - radius, z + radius, false}}};
      return evaluate_bounds(op, box, 0, 0, {.planes = {}, .voxels = {voxels}});
    };
    EXPECT_EQ(bound(500, 10, 10, 100), (ValueBounds{0, 0, false})) << op_info(op).name;
    EXPECT_EQ(bound(-40, -40, -40, 30), (ValueBounds{0, 0, false})) << op_info(op).name;
    EXPECT_EQ(bound(27, 15, 12, 1), (ValueBounds{1.25f, 1.25f, false})) << op_info(op).name;
  }
}

TEST(VoxelLookups, ArePartOfTheProgram) {
  const VoxelsPointer voxels = test_voxels(), others = test_voxels(2);
  Builder builder;
  const NodeId x = builder.input(Input::p_x), y = builder.input(Input::p_y), z = builder.input(Input::p_z);
  const NodeId of_first = builder.emit(Op::voxels, {x, y, z}, {}, 0, builder.voxels(voxels));
  const NodeId of_others = builder.emit(Op::voxels, {x, y, z}, {}, 0, builder.voxels(others));
  EXPECT_NE(of_first, of_others);
  EXPECT_EQ(builder.emit(Op::voxels, {x, y, z}, {}, 0, builder.voxels(voxels)), of_first);
  const Program program = *builder.finish(std::span(&of_others, 1));
  ASSERT_EQ(program.tables.voxels.size(), 1u);
  EXPECT_EQ(program.tables.voxels[0], others);
  EXPECT_EQ(verify(program), "");
  EXPECT_NE(print(program).find("0 = test, 70 x 33 x 25"), std::string::npos) << print(program);
  EXPECT_NE(program.fingerprint, builder.finish(std::span(&of_first, 1))->fingerprint);
  Program broken = program;
  broken.tables.voxels.clear();
  EXPECT_NE(verify(broken).find("voxels 0 of 0"), std::string::npos) << verify(broken);
  const NodeId known =
      builder.emit(Op::voxels, {builder.constant(9), builder.constant(9), builder.constant(9)}, {}, 0,
                   builder.voxels(voxels));
  ASSERT_TRUE(builder.is_constant(known));
  EXPECT_EQ(builder.constant_value(known), voxels->at({9, 9, 9}));
}

}  // namespace
}  // namespace tyndall::vm
