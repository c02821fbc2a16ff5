// Lookups in planes: the machine, the reference, folding and bounds agree, and follow the definition.
#include <gtest/gtest.h>

#include "support.h"
#include "vm/interval/interval.h"

namespace tyndall::vm {
namespace UNNAMED {

PlanePointer test_plane(int width, int height, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 3);
  std::vector<float> texels;
  for (int i = 0; i < width * height; ++i) texels.push_back(uniform(random));
  return make_plane("test R", width, height, std::move(texels));
}

Program lookup(const PlanePointer& plane) {
  Builder builder;
  const NodeId out = builder.emit(Op::plane, {builder.input(Input::p_x), builder.input(Input::p_y)}, {}, 0,
                                  builder.plane(plane));
  return *builder.finish(std::span(&out, 1));
}

float at(const PlanePointer& plane, float u, float v) {
  return evaluate_lane(Op::plane, std::array{u, v}, 0, 0, {.planes = {plane}, .voxels = {}});
}

// (0, 0) is the lower left corner; texels have their values in their middles; both ways it repeats.
TEST(Planes, AreLookedUpAsDefined) {
  const PlanePointer plane = make_plane("p", 2, 2, {1, 2, 3, 5});  // the lower row first
  EXPECT_EQ(at(plane, 0.25f, 0.25f), 1);
  EXPECT_EQ(at(plane, 0.75f, 0.25f), 2);
  EXPECT_EQ(at(plane, 0.25f, 0.75f), 3);
  EXPECT_EQ(at(plane, 0.75f, 0.75f), 5);
  EXPECT_EQ(at(plane, 0.5f, 0.5f), 2.75f);
  EXPECT_EQ(at(plane, 0, 0.25f), 1.5f);  // between the last and the first column
  EXPECT_EQ(at(plane, 3.75f, -0.25f), 5);
  EXPECT_EQ(at(plane, std::nanf(""), std::numeric_limits<float>::infinity()), at(plane, 0, 0));
  EXPECT_EQ(plane->lowest, 1);
  EXPECT_EQ(plane->highest, 5);
}

TEST(Planes, AgreeInEverySimdClass) {
  const auto operands = awkward_operands(Op::plane, 4000);
  std::vector<std::array<float, 4>> rows = operands;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-2, 2);
  for (int i = 0; i < 1000; ++i) rows.push_back({uniform(random), uniform(random), 0, 0});
  const Lanes lanes(rows);
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 3}, {64, 128}, {3000, 2}}) {
    const PlanePointer plane = test_plane(width, height);
    const Program program = lookup(plane);
    ASSERT_EQ(program.tables.planes.size(), 1u);
    std::vector<float> expected(lanes.size());
    float* const output = expected.data();
    run_reference(program, lanes.from(0), lanes.size(), std::span(&output, 1));
    for_each_simd_class([&](const std::string&) {
      Machine machine;
      const std::vector<float> found = run(machine, program, lanes.from(0), lanes.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_TRUE(same(found[i], expected[i])) << rows[i][0] << ", " << rows[i][1];
        EXPECT_TRUE(same(found[i], at(plane, rows[i][0], rows[i][1])));
      }
    });
    // The bound holds all of them, wherever the box is.
    IntervalMachine intervals;
    BoxInputs boxes;
    const float lo[2] = {-3, -3}, hi[2] = {5, 5};
    boxes.set(Input::p_x, lo, hi);
    boxes.set(Input::p_y, lo + 1, hi + 1);
    ValueBounds bound;
    intervals.run(program, boxes, 1, std::span(&bound, 1));
    for (const float value : expected) EXPECT_TRUE(bound.covers(value)) << value;
  }
}

// Of a picture in a temporary file, whose tiles have less memory than they would take.
TEST(Planes, AreTheSameInAFile) {
  constexpr int width = 300, height = 170;
  const PlanePointer known = test_plane(width, height);
  const auto paged = std::make_shared<PagedTexels>(width, height, 2, make_tile_memory(1 << 16));
  std::vector<float> row(2 * width);
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      row[static_cast<std::size_t>(2 * x)] = -1;
      row[static_cast<std::size_t>(2 * x + 1)] = known->at(x, y);
    }
    ASSERT_EQ(paged->add_row(row), "");
  }
  Plane in_file{"in a file", width, height, {}, known->lowest, known->highest, known->hash, paged, 1};
  const auto plane = std::make_shared<const Plane>(std::move(in_file));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) ASSERT_EQ(plane->at(x, y), known->at(x, y)) << x << ", " << y;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-2, 2);
  std::vector<std::array<float, 4>> rows;
  for (int i = 0; i < 5000; ++i) rows.push_back({uniform(random), uniform(random), 0, 0});
  const Lanes lanes(rows);
  for_each_simd_class([&](const std::string&) {
    Machine machine;
    const auto expected = run(machine, lookup(known), lanes.from(0), lanes.size());
    const auto found = run(machine, lookup(plane), lanes.from(0), lanes.size());
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], expected[i]);
  });
}

// A program holds the planes that its outputs read, each once, and no others.
TEST(Planes, AreKeptOnlyWhereRead) {
  const PlanePointer a = test_plane(2, 2), b = test_plane(3, 3), c = test_plane(4, 4);
  Builder builder;
  const NodeId u = builder.input(Input::u), v = builder.input(Input::v);
  const NodeId of_a = builder.emit(Op::plane, {u, v}, {}, 0, builder.plane(a));
  const NodeId of_b = builder.emit(Op::plane, {u, v}, {}, 0, builder.plane(b));
  const NodeId of_c = builder.emit(Op::plane, {v, u}, {}, 0, builder.plane(c));
  EXPECT_EQ(builder.emit(Op::plane, {u, v}, {}, 0, builder.plane(a)), of_a);
  EXPECT_NE(of_a, of_b);
  const std::array outputs{of_c, of_b};
  const Program program = *builder.finish(outputs);
  ASSERT_EQ(program.tables.planes.size(), 2u);
  EXPECT_EQ(verify(program), "");
  const std::string listing = print(program);
  EXPECT_NE(listing.find("4 x 4"), std::string::npos) << listing;
  EXPECT_EQ(listing.find("2 x 2"), std::string::npos) << listing;
  Program broken = program;
  broken.tables.planes.pop_back();
  EXPECT_NE(verify(broken).find("plane"), std::string::npos);
}

TEST(Planes, AreFoldedAtKnownPlaces) {
  const PlanePointer plane = test_plane(5, 4);
  Builder builder;
  const NodeId value =
      builder.emit(Op::plane, {builder.constant(0.3f), builder.constant(0.8f)}, {}, 0, builder.plane(plane));
  ASSERT_TRUE(builder.is_constant(value));
  EXPECT_EQ(builder.constant_value(value), at(plane, 0.3f, 0.8f));
}

}  // namespace
}  // namespace tyndall::vm
