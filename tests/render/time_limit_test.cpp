// Renderings that end before they are done: each block of pixels has all samples of a pass or none.
#include <gtest/gtest.h>

#include <atomic>

#include "render/render.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

constexpr int size = 256;

compile::CompiledScene slow_scene() {
  return compile::compile(support::scene_of(R"(
render { resolution: (256, 256)  step: 0.01  bounces: 1 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }
volume { in: box { min: (-2, -2, -2)  max: (2, 2, 2) }
         medium: { density = 0.5 + 0.4 * fbm(p * 3, octaves: 8)  albedo = 0.9 } }
light point { position: (1, 3, 0)  power: 100 }
)"));
}

TEST(TimeLimit, BlocksAreWholeAndAreWhatTheyWouldBeWithoutIt) {
  const compile::CompiledScene world = slow_scene();
  RenderOptions limited;
  limited.threads = 2;
  limited.time_limit = 0.15;
  limited.sample_count = 4;
  const RenderResult result = render(world, limited);
  ASSERT_TRUE(result.statistics.out_of_time) << "the scene is slow enough";
  ASSERT_TRUE(result.statistics.uneven);
  std::uint64_t samples = 0, without = 0;
  int compared = 0;
  for (int y0 = 0; y0 < size; y0 += 16)
    for (int x0 = 0; x0 < size; x0 += 16) {
      const std::uint32_t count = result.film.samples(x0, y0);
      for (int y = y0; y < y0 + 16; ++y)
        for (int x = x0; x < x0 + 16; ++x) {
          ASSERT_EQ(result.film.samples(x, y), count) << x << "," << y;
          samples += count;
          without += count == 0;
        }
      if (count == 0 || ++compared > 2) continue;
      RenderOptions block;
      block.threads = 1;
      block.crop = PixelWindow{x0, y0, x0 + 16, y0 + 16};
      block.sample_count = static_cast<int>(count);
      const RenderResult alone = render(world, block);
      for (int y = y0; y < y0 + 16; ++y)
        for (int x = x0; x < x0 + 16; ++x) ASSERT_EQ(result.film.mean(x, y), alone.film.mean(x, y));
    }
  EXPECT_EQ(result.statistics.samples, samples);
  EXPECT_EQ(result.statistics.pixels_without_samples, without);
}

TEST(TimeLimit, NothingIsCountedOfABlockThatHadNoTime) {
  RenderOptions limited;
  limited.time_limit = 1e-9;
  for (const bool adaptive : {false, true}) {
    if (adaptive) limited.error = 0.1;
    const RenderResult result = render(slow_scene(), limited);
    EXPECT_TRUE(result.statistics.out_of_time);
    EXPECT_EQ(result.statistics.samples, 0u);
    EXPECT_EQ(result.film.mean(7, 7), Rgb(0, 0, 0));
  }
}

TEST(TimeLimit, AStopFromOutsideIsNoLackOfTime) {
  const std::atomic<bool> stop{true};
  RenderOptions options;
  options.stop = &stop;
  const RenderResult result = render(slow_scene(), options);
  EXPECT_TRUE(result.statistics.stopped);
  EXPECT_FALSE(result.statistics.out_of_time);
  EXPECT_EQ(result.statistics.pixels_without_samples, std::uint64_t{size} * size);
}

// More time than clocks can tell is no limit.
TEST(TimeLimit, LongLimitsAreNone) {
  RenderOptions options;
  options.crop = PixelWindow{0, 0, 1, 1};
  options.sample_count = 2;
  for (const double limit : {1e9, 1e300}) {
    options.time_limit = limit;
    EXPECT_EQ(render(slow_scene(), options).statistics.samples, 2u);
  }
}

}  // namespace
}  // namespace tyndall::render
