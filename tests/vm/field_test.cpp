// Noise and what is made of it: means, bounds, continuity, independence of seeds and axes, flows without
// sources.
#include "support.h"

namespace tyndall::vm {
namespace UNNAMED {

// Runs one field operation at many points.
class Field {
 public:
  explicit Field(Op op, std::uint8_t octaves = 0, std::uint32_t seed = 0)
      : program_(program_of(op, octaves, seed)) {}

  std::vector<float> at(const std::vector<std::array<float, 4>>& points) {
    const Lanes lanes(points);
    return run(machine_, program_, lanes.from(0), lanes.size());
  }

 private:
  Program program_;
  Machine machine_;
};

std::vector<std::array<float, 4>> random_points(std::size_t count, float extent, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> range(-extent, extent);
  std::vector<std::array<float, 4>> points(count);
  for (auto& p : points)
    for (float& c : p) c = range(random);
  return points;
}

struct Statistics {
  double mean = 0, deviation = 0, lowest = 0, highest = 0;
  explicit Statistics(const std::vector<float>& values) {
    lowest = highest = static_cast<double>(values[0]);
    double sum = 0, squares = 0;
    for (const float v : values) {
      const double x = static_cast<double>(v);
      sum += x, squares += x * x;
      lowest = std::min(lowest, x), highest = std::max(highest, x);
    }
    mean = sum / static_cast<double>(values.size());
    deviation = std::sqrt(squares / static_cast<double>(values.size()) - mean * mean);
  }
};

constexpr Op one_value_fields[] = {Op::noise3,      Op::noise4,      Op::fbm3,    Op::fbm4,
                                   Op::turbulence3, Op::turbulence4, Op::ridged3, Op::ridged4,
                                   Op::cells3,      Op::cells4,      Op::curl3_x, Op::curl3_y,
                                   Op::curl3_z,     Op::curl4_x,     Op::curl4_y, Op::curl4_z};

TEST(Fields, HaveZeroMeanAndStayAboutWithinOne) {
  const std::size_t count = 400000;
  const auto points = random_points(count, 3000, 11);
  for (const Op op : one_value_fields) {
    for (const std::uint8_t octaves : {std::uint8_t{1}, std::uint8_t{5}}) {
      if (!op_info(op).has(OpTrait::octaves) && octaves != 1) continue;
      Field field(op, op_info(op).has(OpTrait::octaves) ? octaves : std::uint8_t{0}, 3);
      const Statistics s(field.at(points));
      // Five standard errors of independent points, and the last digit of the measured means.
      EXPECT_LE(std::fabs(s.mean), 5 * s.deviation / std::sqrt(static_cast<double>(count)) + 1e-4)
          << op_info(op).name;
      EXPECT_GT(s.deviation, 0.05) << op_info(op).name;
      EXPECT_GE(s.lowest, -1.7) << op_info(op).name;
      EXPECT_LE(s.highest, 1.7) << op_info(op).name;
    }
  }
}

TEST(Fields, NoiseStaysBelowItsSupremum) {
  // vm.md: the supremum of 12-edge gradient noise with a quintic fade is 1.0364. The points lie where it is
  // reached.
  std::vector<std::array<float, 4>> points = random_points(1000000, 1000, 12);
  for (auto& p : points)
    for (float& c : p) c = std::floor(c) + 0.5f + (c - std::floor(c) - 0.5f) * 0.4f;
  const Statistics s(Field(Op::noise3).at(points));
  EXPECT_LE(std::max(-s.lowest, s.highest), 1.0364);
  EXPECT_GT(std::max(-s.lowest, s.highest), 0.9);
  const Statistics t(Field(Op::noise4).at(points));
  EXPECT_LE(std::max(-t.lowest, t.highest), 1.0364);
}

TEST(Fields, NoiseIsContinuousAndBoundedInSlope) {
  // Lipschitz constant 3.75 (vm.md); the points straddle lattice planes as often as not.
  const auto points = random_points(200000, 50, 13);
  std::vector<std::array<float, 4>> moved = points, snapped = points;
  const float step = 1.0f / 1024;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t axis = i % 3;
    if (i % 2 == 0) snapped[i][axis] = std::floor(points[i][axis]) - step / 2;
    moved[i] = snapped[i];
    moved[i][axis] += step;
  }
  for (const Op op : {Op::noise3, Op::noise4}) {
    Field field(op);
    const std::vector<float> a = field.at(snapped), b = field.at(moved);
    for (std::size_t i = 0; i < a.size(); ++i)
      ASSERT_LE(std::fabs(a[i] - b[i]), 3.75f * step * 1.02f) << op_info(op).name << ' ' << snapped[i][0];
  }
}

TEST(Fields, CellsAreContinuous) {
  // A distance changes by at most the step: the search never misses the nearest point.
  const auto points = random_points(200000, 50, 14);
  auto moved = points;
  for (std::size_t i = 0; i < points.size(); ++i) moved[i][i % 3] += 1.0f / 1024;
  for (const auto& [op, mean] : {std::pair{Op::cells3, 0.52036f}, {Op::cells4, 0.59002f}}) {
    Field field(op);
    const std::vector<float> a = field.at(points), b = field.at(moved);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LE(std::fabs(a[i] - b[i]) * mean, 1.05f / 1024);
  }
}

// The nearest distance is that of cells; both distances change by at most the step; the number changes only
// where the two distances are equal, and is uniform over cells.
TEST(Fields, WorleyKnowsTheTwoNearestAndTheirNumber) {
  const auto points = random_points(100000, 50, 24);
  auto moved = points;
  const float step = 1.0f / 1024, allowed = 1.05f * step;
  for (std::size_t i = 0; i < points.size(); ++i) moved[i][i % 3] += step;
  const std::tuple<Op, Op, Op, Op, float> rows[] = {
      {Op::worley3_first, Op::worley3_second, Op::worley3_id, Op::cells3, 0.52036f},
      {Op::worley4_first, Op::worley4_second, Op::worley4_id, Op::cells4, 0.59002f}};
  for (const auto& [first, second, id, cells, mean] : rows) {
    const std::vector<float> a = Field(first).at(points), b = Field(second).at(points);
    const std::vector<float> n = Field(id).at(points), scaled = Field(cells).at(points);
    const std::vector<float> a_moved = Field(first).at(moved), b_moved = Field(second).at(moved),
                             n_moved = Field(id).at(moved);
    std::array<double, 16> bins{};
    std::size_t changes = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_NEAR(a[i], (scaled[i] + 1) * mean, 1e-6f);
      ASSERT_LE(a[i], b[i]);
      ASSERT_LE(b[i], 1);
      ASSERT_LE(std::fabs(a_moved[i] - a[i]), allowed);
      ASSERT_LE(std::fabs(b_moved[i] - b[i]), allowed);
      if (n[i] != n_moved[i]) {
        ASSERT_LE(b[i] - a[i], 2 * allowed);
        ++changes;
      }
      ASSERT_GE(n[i], 0);
      ASSERT_LT(n[i], 1);
      ++bins[static_cast<std::size_t>(n[i] * 16)];
    }
    EXPECT_GT(changes, 10u);
    // In a box of side 100 a cell is hit at most a few times: nearly independent. 15 degrees of freedom.
    const double mean_count = static_cast<double>(points.size()) / 16;
    double chi = 0;
    for (const double count : bins) chi += (count - mean_count) * (count - mean_count) / mean_count;
    EXPECT_LT(chi, 60) << op_info(id).name;
  }
}

TEST(Fields, LatticeValuesAreUncorrelated) {
  // Between neighbours along each axis and diagonal, and between seeds, the noise at cell centres correlates
  // only as far as it shares corners: a cell two away shares none. Five standard errors.
  const std::size_t count = 200000;
  auto points = random_points(count, 500, 15);
  for (auto& p : points)
    for (float& c : p) c = std::floor(c) + 0.37f;
  const std::vector<float> base = Field(Op::noise3).at(points);
  const double variance = std::pow(Statistics(base).deviation, 2);
  const auto correlation = [&](const std::vector<float>& other) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
      sum += static_cast<double>(base[i]) * static_cast<double>(other[i]);
    return sum / static_cast<double>(count) / variance;
  };
  const double limit = 5 / std::sqrt(static_cast<double>(count));
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) {
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) < 2) continue;
        auto shifted = points;
        for (auto& p : shifted)
          p[0] += static_cast<float>(x), p[1] += static_cast<float>(y), p[2] += static_cast<float>(z);
        EXPECT_LE(std::fabs(correlation(Field(Op::noise3).at(shifted))), limit) << x << ' ' << y << ' ' << z;
      }
  for (std::uint32_t seed = 1; seed <= 40; ++seed)
    EXPECT_LE(std::fabs(correlation(Field(Op::noise3, 0, seed).at(points))), limit) << "seed " << seed;
}

TEST(Fields, NoiseVanishesAtLatticePointsAndDiffersBetweenSeeds) {
  const std::vector<std::array<float, 4>> points = {
      {0, 0, 0, 0}, {3, -7, 100, 2}, {-1e6f, 5, 1, 1}, {0.5f, 0.4f, 0.3f, 0.2f}};
  const std::vector<float> a = Field(Op::noise3, 0, 1).at(points), b = Field(Op::noise3, 0, 2).at(points);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(a[i], 0);
  EXPECT_NE(a[3], b[3]);
}

TEST(Fields, LargeCoordinatesGiveFiniteNumbersAndNaNsGiveNaN) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<std::array<float, 4>> points = {{5e6f, 1, 1, 1},  {-3e9f, 3e9f, 0.5f, 1},
                                                    {1e18f, 1, 1, 1}, {inf, 0, 0, 0},
                                                    {0, -inf, 0, 0},  {0, 0, std::nanf(""), 0}};
  for (const Op op : {Op::noise3, Op::noise4, Op::fbm3, Op::fbm4, Op::ridged3, Op::curl3_x}) {
    const std::vector<float> values =
        Field(op, op_info(op).has(OpTrait::octaves) ? std::uint8_t{8} : std::uint8_t{0}).at(points);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(std::fabs(values[i]), 4) << op_info(op).name << ' ' << i;
    for (std::size_t i = 3; i < points.size(); ++i)
      EXPECT_TRUE(std::isnan(values[i])) << op_info(op).name << ' ' << i;
  }
}

TEST(Fields, FbmIsTheNormalisedSumOfItsOctaves) {
  // One octave is the noise; many differ from fewer by at most the weight of what is added.
  const auto points = random_points(2000, 20, 16);
  const std::vector<float> noise = Field(Op::noise3, 0, 9).at(points), one = Field(Op::fbm3, 1, 9).at(points);
  EXPECT_EQ(noise, one);
  const std::vector<float> five = Field(Op::fbm3, 5, 9).at(points), eight = Field(Op::fbm3, 8, 9).at(points);
  const float total5 = 2 - 0x1p-4f, total8 = 2 - 0x1p-7f, added = total8 - total5;
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LE(std::fabs(eight[i] * total8 - five[i] * total5), added * 1.0364f + 1e-6f);
}

TEST(Fields, CurlHasNoDivergence) {
  // Central differences of exact derivatives, in steps where their error and that of rounding are both small.
  const auto points = random_points(4000, 20, 17);
  const float h = 1.0f / 128;
  for (const bool time : {false, true}) {
    const std::array<Op, 3> ops = time ? std::array{Op::curl4_x, Op::curl4_y, Op::curl4_z}
                                       : std::array{Op::curl3_x, Op::curl3_y, Op::curl3_z};
    std::vector<double> divergence(points.size(), 0), size(points.size(), 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto low = points, high = points;
      for (std::size_t i = 0; i < points.size(); ++i) low[i][axis] -= h, high[i][axis] += h;
      Field field(ops[axis]);
      const std::vector<float> a = field.at(low), b = field.at(high);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double slope =
            static_cast<double>(b[i] - a[i]) / static_cast<double>(high[i][axis] - low[i][axis]);
        divergence[i] += slope;
        size[i] += std::fabs(slope);
      }
    }
    double sum = 0, sizes = 0;
    for (std::size_t i = 0; i < points.size(); ++i) sum += std::fabs(divergence[i]), sizes += size[i];
    EXPECT_LT(sum, sizes * 0.01);
  }
}

TEST(Random, IsUniformPureAndBlindToTheSignOfZero) {
  for (const Op op : {Op::random1, Op::random2, Op::random3, Op::random4}) {
    const std::size_t count = 1 << 18;
    std::vector<std::array<float, 4>> points(count);
    for (std::size_t i = 0; i < count; ++i)
      points[i] = {static_cast<float>(i), static_cast<float>(i % 7), static_cast<float>(i / 100), 0.5f};
    const std::vector<float> values = Field(op).at(points);
    std::array<double, 64> bins{};
    for (const float v : values) {
      ASSERT_GE(v, 0);
      ASSERT_LT(v, 1);
      ++bins[static_cast<std::size_t>(v * 64)];
    }
    // Chi squared with 63 degrees of freedom: 120 is beyond the 99.999 % point.
    double chi = 0;
    for (const double n : bins) chi += (n - count / 64.0) * (n - count / 64.0) / (count / 64.0);
    EXPECT_LT(chi, 120) << op_info(op).name;
  }
  EXPECT_EQ(evaluate_lane(Op::random1, std::array{0.0f}), evaluate_lane(Op::random1, std::array{-0.0f}));
  EXPECT_NE(evaluate_lane(Op::random2, std::array{1.0f, 2.0f}),
            evaluate_lane(Op::random2, std::array{2.0f, 1.0f}));
}

TEST(Blackbody, HasLuminanceOneAndTurnsFromRedToBlue) {
  const auto color = [](float kelvin) {
    return std::array{evaluate_lane(Op::blackbody_r, std::array{kelvin}),
                      evaluate_lane(Op::blackbody_g, std::array{kelvin}),
                      evaluate_lane(Op::blackbody_b, std::array{kelvin})};
  };
  float last_ratio = 1e9f;
  for (const float kelvin : {600.0f, 1000.0f, 1900.0f, 3200.0f, 5000.0f, 6500.0f, 10000.0f, 40000.0f, 1e8f}) {
    const auto [r, g, b] = color(kelvin);
    EXPECT_NEAR(0.2126f * r + 0.7152f * g + 0.0722f * b, 1, 1e-5) << kelvin;
    EXPECT_GE(std::min({r, g, b}), 0) << kelvin;
    EXPECT_LT(r / (b + 1e-3f), last_ratio) << kelvin;
    last_ratio = r / (b + 1e-3f);
  }
  // The planckian locus passes 6500 K a little beside D65: near white, within the observer's fit.
  const auto [r, g, b] = color(6500);
  EXPECT_NEAR(r, 1, 0.06);
  EXPECT_NEAR(g, 1, 0.03);
  EXPECT_NEAR(b, 1, 0.06);
  for (const float cold : {0.0f, -5.0f, 100.0f}) EXPECT_EQ(color(cold), color(500));
  EXPECT_TRUE(std::isnan(color(std::nanf(""))[0]));
}

}  // namespace UNNAMED
}  // namespace tyndall::vm
