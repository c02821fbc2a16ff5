// The loops over segments against plain numbers, in every SIMD class of this processor.
#include "render/march/segment_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/march/ray_march.h"
#include "support/simd_classes.h"

namespace tyndall::render {
namespace UNNAMED {

using support::for_each_simd_class;

const Vec3d origin{0.3, -2, 1e3}, direction{0.6, 0, -0.8};

struct Coordinates {
  std::vector<float> x, y, z;
};
template <class Samples>
Coordinates put(const Samples& samples) {
  Coordinates out;
  for (auto* row : {&out.x, &out.y, &out.z}) row->assign(samples.count + widest_lanes, 7);
  put_on_line(samples, origin, direction, out.x.data(), out.y.data(), out.z.data());
  return out;
}
void expect_at(const Coordinates& got, std::size_t k, double t, const std::string& name) {
  EXPECT_EQ(got.x[k], static_cast<float>(origin.x + direction.x * t)) << name << " " << k;
  EXPECT_EQ(got.y[k], static_cast<float>(origin.y + direction.y * t)) << name << " " << k;
  EXPECT_EQ(got.z[k], static_cast<float>(origin.z + direction.z * t)) << name << " " << k;
}

// Of every count, as vectors end somewhere, and from odd and even samples on.
TEST(MarchLanes, SamplesAreWhereJitterSays) {
  for_each_simd_class([](const std::string& name) {
    for (const std::uint32_t first : {0u, 1u, 6u, 4094u})
      for (std::size_t count = 1; count < 40; ++count) {
        const bool paired = count % 3 != 0;
        std::vector<double> t0(count + widest_lanes), dt(count + widest_lanes);
        for (std::size_t k = 0; k < count; ++k)
          t0[k] = 0.1 * static_cast<double>(k * k), dt[k] = 0.3 / static_cast<double>(k + 1);
        const std::uint32_t seed = 0x9abcdef1u * static_cast<std::uint32_t>(count);
        const Coordinates uneven = put(SegmentSamples{t0.data(), dt.data(), seed, first, count, paired});
        const Coordinates even = put(UniformSamples{2.5, 0.125, seed, first, count, paired});
        for (std::size_t k = 0; k < count; ++k) {
          const double place = jitter(seed, first + static_cast<std::uint32_t>(k), paired);
          expect_at(uneven, k, t0[k] + place * dt[k], name);
          expect_at(even, k, 2.5 + (static_cast<double>(k) + place) * 0.125, name);
        }
      }
  });
}

// Their array may end with them.
TEST(MarchLanes, PlacedSamplesAreWhereTheyAre) {
  for_each_simd_class([](const std::string& name) {
    for (std::size_t count = 1; count < 20; ++count) {
      std::vector<double> t(count);
      for (std::size_t k = 0; k < count; ++k) t[k] = std::sqrt(static_cast<double>(k + 2));
      const Coordinates got = put(PlacedSamples{t.data(), count});
      for (std::size_t k = 0; k < count; ++k) expect_at(got, k, t[k], name);
    }
  });
}

TEST(MarchLanes, EvenSegmentsFollowEachOther) {
  for_each_simd_class([](const std::string& name) {
    for (std::size_t count = 1; count < 20; ++count) {
      std::vector<double> t0(count + widest_lanes), dt(count + widest_lanes);
      lay_uniform_segments(0.7, 1.0 / 3, count, t0.data(), dt.data());
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_EQ(t0[k], 0.7 + static_cast<double>(k) * (1.0 / 3)) << name;
        EXPECT_EQ(dt[k], 1.0 / 3) << name;
      }
    }
  });
}

// From depths of 1e-30 to 1e30 against long double: haze, in which 1 - e^-x as such has no digits left, and
// stone.
TEST(MarchLanes, TransmittanceIsRightOverSixtyDecades) {
  for_each_simd_class([](const std::string& name) {
    std::vector<float> sigma_t;
    std::vector<double> dt;
    for (double exponent = -30; exponent <= 30; exponent += 0.01) {
      sigma_t.push_back(static_cast<float>(std::pow(10.0, exponent / 2)));
      dt.push_back(std::pow(10.0, exponent / 2));
    }
    // Where one form takes over from another.
    for (const double depth : {0.25, std::nextafter(0.25, 0.0), 707.9, 708.0, 745.0})
      sigma_t.push_back(1), dt.push_back(depth);
    const std::size_t count = dt.size();
    sigma_t.resize(count + widest_lanes);
    dt.resize(count + widest_lanes);
    std::vector<double> through(dt.size()), reach(dt.size());
    transmit_segments(sigma_t.data(), dt.data(), 0, count, through.data(), reach.data());
    for (std::size_t i = 0; i < count; ++i) {
      const long double depth = static_cast<long double>(sigma_t[i]) * dt[i];
      const long double passes = expl(-depth), over = -expm1l(-depth) / sigma_t[i];
      // Of the average over the segment, (1 - e^-x)/x: a few roundings, and of a thin one's alternating
      // series the first term left out, x^10/11!. A thick one's depth is rounded once.
      const auto x = static_cast<double>(depth), most = static_cast<double>(passes),
                 average = static_cast<double>(over) / dt[i];
      const bool thin = x < 0.25;
      const double left_out = thin ? std::pow(x, 10) / 39916800 : 0.0;
      EXPECT_NEAR(through[i], most, thin ? x * left_out + 3e-16 : (1e-15 + x * 0x1p-53) * most + 1e-307)
          << name << " " << x;
      EXPECT_NEAR(reach[i] / dt[i], average, left_out + 1e-15 * average) << name << " " << x;
    }
  });
}

// In haze, where 1 - e^-x in float is wrong by a factor of two, absorbed light is right.
TEST(MarchLanes, KeepHaze) {
  for_each_simd_class([](const std::string& name) {
    const std::vector<float> sigma_t(1 + widest_lanes, 0x1p-25f);
    const std::vector<double> dt(1 + widest_lanes, 1);
    std::vector<double> through(dt.size()), reach(dt.size());
    transmit_segments(sigma_t.data(), dt.data(), 0, 1, through.data(), reach.data());
    EXPECT_NEAR(0x1p-25 * reach[0] / 0x1p-25, 1 - 0x1p-26, 1e-15) << name;
    EXPECT_NEAR(through[0], 1 - 0x1p-25 + 0x1p-51, 1.2e-16) << name;
  });
}

TEST(MarchLanes, NothingInTheWayLetsAllThrough) {
  for_each_simd_class([](const std::string& name) {
    const std::vector<float> sigma_t(3 + widest_lanes);
    const std::vector<double> dt(3 + widest_lanes, 0.1);
    std::vector<double> through(dt.size()), reach(dt.size());
    transmit_segments(sigma_t.data(), dt.data(), 1, 3, through.data(), reach.data());
    for (std::size_t i = 1; i < 3; ++i) {
      EXPECT_EQ(through[i], 1.0) << name;
      EXPECT_EQ(reach[i], 0.1) << name;
    }
    EXPECT_EQ(through[0], 0.0) << name;  // not asked for
  });
}

}  // namespace UNNAMED
}  // namespace tyndall::render
