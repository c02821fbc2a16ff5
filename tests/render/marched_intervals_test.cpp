// Skipping what is proven empty changes neither what is marched elsewhere nor the picture, and saves the
// work.
#include "render/march/marched_intervals.h"

#include <gtest/gtest.h>

#include <random>

#include "compile/compiled_scene.h"
#include "render/march/ray_march.h"
#include "render/render.h"
#include "support/measure.h"
#include "support/scene_builder.h"

namespace tyndall::render {
namespace UNNAMED {

using support::Expression;
using support::Point;
using support::SceneBuilder;

// Two balls of noise in a box, which they fill to a few hundredths.
Expression balls(const Point& p) {
  const Expression n{p.x.builder, p.x.builder->emit(vm::Op::fbm3, {p.x.node, p.y.node, p.z.node}, {}, 3)};
  const Point q = {p.x - 0.9f, p.y + 0.4f, p.z};
  return (max(0.4f - length(p) + n * 0.1f, 0) + max(0.3f - length(q), 0)) * 20.f;
}

SceneBuilder scene_of(const support::Density& density) {
  SceneBuilder builder;
  builder.image(12, 8, 4).bounces(3).step(0.05).perspective({0.3, 0.4, 3.6}, {0.2, 0, 0}, 45);
  builder.volume(scene::Box{{-1.5, -1, -1}, {1.5, 1, 1}}, builder.shader({Rgb(1), Rgb(0.9f)}, density),
                 Transform::rotate({1, 1, 0}, 0.4));
  builder.distant_light({0.3, -1, 0.2}, Rgb(3)).environment(0.2f);
  return builder;
}

std::vector<compile::Ray> random_rays(std::size_t count) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<compile::Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d from = {3 * uniform(random), 2 * uniform(random), 3 * uniform(random)};
    const Vec3d to = {uniform(random), uniform(random) * 0.7, uniform(random) * 0.7};
    rays.push_back({from - Vec3d{0.3, 0.4, 3.6}, normalize(to - from), i % 5 == 0 ? 2.0 : 100.0});
  }
  return rays;
}

// Whether t is in an interval.
bool holds(const std::vector<MarchedInterval>& marched, double t) {
  return std::any_of(marched.begin(), marched.end(),
                     [&](const MarchedInterval& s) { return s.t0 <= t && t < s.t1; });
}

TEST(MarchedIntervals, LeaveOutNothingThatIsThere) {
  const compile::CompiledScene world = compile::compile(scene_of(balls).scene);
  ThreadContext whole;
  whole.skips_empty = false;
  RayMarcher marcher;
  MarchedIntervals finder;
  double left_out = 0, all = 0;
  for (const compile::Ray& ray : random_rays(400)) {
    March m;
    marcher.march(world, {ray, compile::RayKind::scattered, 9, &m}, whole);
    std::vector<MarchedInterval> marched;
    finder.find(world, ray, compile::RayKind::scattered, true, marched);
    for (std::uint32_t i = 0; i < m.count; ++i) {
      const double t = m.t0[i] + jitter(9, i) * m.dt[i];
      const bool there = holds(marched, t);
      if (!there) {
        ASSERT_EQ(m.sigma_t[0][i], 0) << t;
      }
      ++all;
      left_out += !there;
    }
    for (std::size_t k = 1; k < marched.size(); ++k) ASSERT_LE(marched[k - 1].t1, marched[k].t0);
  }
  EXPECT_GT(left_out, 0.7 * all);
}

TEST(MarchedIntervals, KeepThePicture) {
  for (const bool is_auto : {false, true}) {
    SceneBuilder builder = scene_of(balls);
    RenderOptions plain;
    plain.skip_empty = false;
    const support::Measurement a = support::measure(builder.scene, plain);
    if (is_auto) builder.scene.settings.step = scene::Step::proven_within(0.005);
    const support::Measurement b = support::measure(builder.scene);
    for (const int x : {0, 3, 6, 9})
      for (const int y : {0, 4})
        support::expect_same(a.region(x, y, x + 3, y + 4), b.region(x, y, x + 3, y + 4), is_auto ? 0.003 : 0,
                             0.2, is_auto ? "automatic step" : "skipping");
  }
}

TEST(MarchedIntervals, SaveTheEmptyPartOfTheWork) {
  const compile::CompiledScene world = compile::compile(scene_of(balls).scene);
  RenderOptions options;
  const std::uint64_t skipping = render(world, options).statistics.lanes_used;
  options.skip_empty = false;
  const std::uint64_t whole = render(world, options).statistics.lanes_used;
  EXPECT_LT(static_cast<double>(skipping), 0.3 * static_cast<double>(whole));
}

TEST(MarchedIntervals, AreOneSegmentWhereTheMediumIsProvenUniform) {
  const compile::CompiledScene world =
      compile::compile(scene_of([](const Point& p) { return less(p.x, 0) * 3.f; }).scene);
  ThreadContext thread;
  const Vec3d from = Transform::rotate({1, 1, 0}, 0.4).point({-3, 0.1, 0.2}) - world.origin;
  const Vec3d along = Transform::rotate({1, 1, 0}, 0.4).vector({1, 0, 0});
  March m;
  RayMarcher().march(world, {{from, along, 100}, compile::RayKind::scattered, 1, &m}, thread);
  ASSERT_GE(m.count, 1u);
  EXPECT_LE(m.count, 6u);  // 1.5 m at steps of 0.05 m: the uniform part, and the cell with the jump
  EXPECT_GT(m.dt[0], 1.3);
  EXPECT_NEAR(m.end_transmittance().x, std::exp(-4.5), 0.1 * std::exp(-4.5));
}

TEST(MarchedIntervals, AreTheSameForAnyNumberOfThreads) {
  SceneBuilder builder = scene_of(balls);
  builder.scene.settings.step = scene::Step::proven_within(0.02);
  const auto picture = [&](int threads) {
    const compile::CompiledScene world = compile::compile(builder.scene);
    RenderOptions options;
    options.threads = threads;
    return render(world, options);
  };
  const RenderResult one = picture(1), four = picture(4);
  for (int y = 0; y < one.film.height(); ++y)
    for (int x = 0; x < one.film.width(); ++x) EXPECT_EQ(one.film.mean(x, y), four.film.mean(x, y));
}

}  // namespace UNNAMED
}  // namespace tyndall::render
