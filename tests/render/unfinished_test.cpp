// Renders that are left unfinished and go on: the film is that of a render that was not, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "render/render.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

compile::CompiledScene small_fog() {
  return compile::compile(support::scene_of(R"(
render { resolution: (56, 40)  samples: 21  step: 0.4  bounces: 2 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0)  fov: 40deg }
volume { in: sphere { radius: 1.3 }
         medium: { density = 2 + sin(p.x * 9)  albedo = 0.9 } }
light sphere { center: (2, 3, 1)  radius: 0.5  power: 100 }
plane { point: (0, -1, 0)  normal: (0, 1, 0) }
)"));
}

bool same_sums(const Film& a, const Film& b) {
  const auto equal = [](auto p, auto q) { return std::equal(p.begin(), p.end(), q.begin(), q.end()); };
  return equal(a.bytes().first, b.bytes().first) && equal(a.bytes().second, b.bytes().second);
}

struct Way {
  const char* name;
  RenderOptions options;
};
std::vector<Way> ways() {
  RenderOptions plain, range, error;
  range.first_sample = 5;
  range.sample_count = 9;
  range.crop = PixelWindow{3, 5, 50, 31};
  range.aovs.add(Aov::depth);
  range.aovs.add(Aov::variance);
  error.error = 0.15;
  error.aovs.add(Aov::albedo);
  return {{"plain", plain}, {"part with outputs", range}, {"error", error}};
}

// Stops after so many blocks of pixels, and pauses before each third: what there is then.
struct Interruption {
  std::atomic<bool> stop{false};
  std::atomic<int> blocks{0};
  int last;
  Progress progress;

  explicit Interruption(int blocks_until_stop) : last(blocks_until_stop) {
    progress.wants_pause = [this](double) {
      const int n = ++blocks;
      if (n >= last) stop = true;
      return n % 3 == 0;
    };
  }
};

TEST(Unfinished, GoesOnAsIfItHadNotStopped) {
  const compile::CompiledScene world = small_fog();
  for (const Way& way : ways()) {
    RenderOptions alone = way.options;
    alone.threads = 1;
    Interruption none(1 << 30);
    const RenderResult whole = render(world, alone, none.progress);
    // How often one thread asks whether to pause.
    const int all = none.blocks;
    ASSERT_GE(all, 12) << way.name;
    for (const int blocks : {1, 2, all / 4, all / 2, all - 1}) {
      // In three runs: two are stopped.
      std::optional<Unfinished> from;
      int runs = 0;
      for (bool done = false; !done; ++runs) {
        RenderOptions options = way.options;
        options.threads = 1 + runs % 2;
        Interruption interruption(runs < 2 ? blocks : 1 << 30);
        options.stop = &interruption.stop;
        if (from) {
          ASSERT_TRUE(fits(world, options, *from)) << way.name;
        }
        RenderResult result = render(world, options, interruption.progress, std::move(from));
        done = !result.statistics.stopped;
        if (done) {
          EXPECT_TRUE(same_sums(result.film, whole.film)) << way.name << " " << blocks;
          EXPECT_EQ(result.statistics.samples, whole.statistics.samples) << way.name << " " << blocks;
          EXPECT_EQ(result.statistics.estimated_error, whole.statistics.estimated_error) << way.name;
          EXPECT_FALSE(result.statistics.uneven);
        }
        from = Unfinished{std::move(result.film), std::move(result.rest)};
      }
      // Both were stopped, the second unless the first had left little.
      EXPECT_GE(runs, 2) << way.name << " " << blocks << " of " << all;
      if (blocks <= all / 4) {
        EXPECT_EQ(runs, 3) << way.name << " " << blocks << " of " << all;
      }
    }
  }
}

// What is saved in a pause, as a process that is killed leaves it.
TEST(Unfinished, APauseHasAllThatIsNeeded) {
  const compile::CompiledScene world = small_fog();
  for (const Way& way : ways()) {
    const RenderResult whole = render(world, way.options);
    for (const int wanted : {1, 4, 11}) {
      std::optional<Unfinished> saved;
      int pauses = 0;
      Progress progress;
      progress.wants_pause = [n = std::make_shared<std::atomic<int>>(0)](double) { return ++*n % 2 == 0; };
      progress.pass = [&](const Film& film, const Statistics&, const std::string& rest) {
        if (++pauses == wanted) saved = Unfinished{film, rest};
      };
      const RenderResult paused = render(world, way.options, progress);
      EXPECT_TRUE(same_sums(paused.film, whole.film)) << way.name << ": pauses change nothing";
      ASSERT_TRUE(saved) << way.name << " " << wanted << " of " << pauses;
      EXPECT_FALSE(same_sums(saved->film, whole.film)) << way.name << " " << wanted;
      const RenderResult again = render(world, way.options, {}, std::move(saved));
      EXPECT_TRUE(same_sums(again.film, whole.film)) << way.name << " " << wanted;
      EXPECT_EQ(again.statistics.samples, whole.statistics.samples);
    }
  }
}

TEST(Unfinished, WhatDoesNotFitIsRefused) {
  const compile::CompiledScene world = small_fog();
  const std::vector<Way> all = ways();
  for (const Way& way : all) {
    const RenderResult result = render(world, way.options);
    for (const Way& other : all)
      EXPECT_EQ(fits(world, other.options, {result.film, result.rest}), way.name == other.name)
          << way.name << " for " << other.name;
    for (std::size_t size = 0; size < result.rest.size(); size += 3)
      EXPECT_FALSE(fits(world, way.options, {result.film, result.rest.substr(0, size)})) << size;
    EXPECT_FALSE(fits(world, way.options, {result.film, result.rest + '\0'}));
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
