// Marches that end by roulette have the same means: what passes, what scatters, what shines.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "render/distance/density_sampling.h"
#include "render/march/ray_march.h"
#include "render/march/transmittance_roulette.h"
#include "support/scene_builder.h"

namespace tyndall::render {
namespace UNNAMED {

using support::Point;

// 2 m of heterogeneous smoke that is thinnest in red, and shines.
compile::CompiledScene smoke(float density) {
  support::SceneBuilder b;
  b.step(0.005).orthographic({0, 0, 0}, {0, 0, -1}, 1);
  b.volume(
      scene::Box{{-1, -1, -3}, {1, 1, -1}},
      b.shader({.sigma_t = Rgb(0.6f, 0.8f, 1), .albedo = Rgb(0.9f, 0.5f, 0.1f), .emission = Rgb(1, 2, 3)},
               [=](const Point& p) { return (cos(p.z * 9.f) * 0.5f + 1.f) * density; }));
  return compile::compile(b.scene);
}

const compile::Ray ray{{0, 0, 0}, {0, 0, -1}, 100};
// Thin curtains in the smoke and behind it.
const std::vector<MarchCrossing> curtains = {{1.2, 0.5f}, {2.5, 0.75f}, {4, 0.25f}};

// Numbers that a march gives, by name.
std::map<std::string, double> numbers(const March& m) {
  std::map<std::string, double> out;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string channel = std::to_string(c);
    out["passes " + channel] = m.end_transmittance()[c];
    out["scatters " + channel] = m.total_scattered()[c];
    out["shines " + channel] = m.emitted[c];
    for (std::size_t k = 0; k < m.crossings.size(); ++k)
      out["before curtain " + std::to_string(k) + " " + channel] = m.crossings[k].before[c];
  }
  return out;
}

TEST(TransmittanceRoulette, KeepsEveryMean) {
  for (const float density : {1.f, 6.f, 12.f}) {
    const compile::CompiledScene world = smoke(density);
    constexpr int marches = 20000;
    std::map<std::string, double> sum, difference, square, part_square;
    std::uint64_t segments = 0, all = 0;
    ThreadContext thread;
    RayMarcher marcher;
    March whole, part;
    for (std::uint32_t k = 0; k < marches; ++k) {
      const auto seed = static_cast<std::uint32_t>(hash_bits(k, 5));
      whole.crossings = part.crossings = curtains;
      const std::array<MarchRequest, 2> requests = {{{ray, compile::RayKind::scattered, seed, &whole, false},
                                                     {ray, compile::RayKind::scattered, seed, &part, true}}};
      marcher.march(world, requests, thread);
      all += whole.count;
      segments += part.count;
      const auto a = numbers(whole), b = numbers(part);
      for (const auto& [name, value] : a) {
        sum[name] += value;
        difference[name] += b.at(name) - value;
        square[name] += (b.at(name) - value) * (b.at(name) - value);
      }
    }
    for (const auto& [name, total] : sum) {
      const double error = std::sqrt(square[name]) + 1e-6 * total;
      EXPECT_NEAR(difference[name], 0, 4 * error) << name << ", density " << density << ", of " << total;
      EXPECT_LE(error, 0.1 * total) << name << ": this shows nothing";
    }
    if (density == 1)
      EXPECT_EQ(segments, all) << "no part of it is dark";
    else
      EXPECT_LT(segments, (density > 6 ? 0.5 : 0.8) * static_cast<double>(all)) << "nothing was saved";
  }
}

// What a march ends before is in none of what is drawn from it.
TEST(TransmittanceRoulette, HoldsNothingBehindItsEnd) {
  const compile::CompiledScene world = smoke(40);
  ThreadContext thread;
  RayMarcher marcher;
  int ended = 0;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    March m;
    m.crossings = curtains;
    const MarchRequest request{ray, compile::RayKind::scattered, seed, &m, true};
    marcher.march(world, request, thread);
    ASSERT_GT(m.count, 0u);
    double before = 1;
    for (std::uint32_t i = 0; i < m.count; ++i) {
      const double end = m.transmittance_at(i, m.t0[i] + m.dt[i])[0];
      ASSERT_LE(end, m.transmittance[0][i]);
      // Up by no more than makes up for those that end.
      ASSERT_LE(m.transmittance[0][i], 20.001 * before);
      before = end;
    }
    ASSERT_EQ(m.scattering_intervals.size(), 1u);
    if (m.count == m.progress.laid) continue;
    ++ended;
    EXPECT_DOUBLE_EQ(m.scattering_intervals[0].hi, m.t0[m.count - 1] + m.dt[m.count - 1]);
    EXPECT_EQ(m.end_transmittance(), Rgb(0));
    EXPECT_EQ(m.crossings.back().before, Rgb(0));
    const DensityDistribution density(m, Rgb(1));
    for (const float u : {0.f, 0.5f, 0.999999f}) EXPECT_LE(density.sample(u).t, m.scattering_intervals[0].hi);
  }
  EXPECT_GT(ended, 60);
}

TEST(TransmittanceRoulette, RoundsHoldEverySegmentOnce) {
  for (const std::uint32_t first : {4u, 5u, 100u, 4096u})
    for (const std::uint32_t count : {0u, 1u, 3u, 4u, 7u, 9u, 64u, 4096u, 1u << 31}) {
      std::uint32_t end = 0;
      std::uint32_t round = 0;
      for (; end < count; ++round) {
        const std::uint32_t next = segments_until(first, round, count);
        ASSERT_GT(next, end);
        ASSERT_LE(next, count);
        end = next;
      }
      EXPECT_LE(round, 32u);
    }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
