// The hazards of transport §7, met on purpose: far away, tiny, long, dense, and shaders that misbehave.
#include <gtest/gtest.h>

#include <cmath>

#include "compile/compiled_scene.h"
#include "render/march/ray_march.h"
#include "render/render.h"
#include "support/scene_builder.h"

namespace tyndall {
namespace UNNAMED {

using support::SceneBuilder;

// A cloudlet over a floor, a lamp and a sky; everything moved by `offset`, then scaled by `scale`.
scene::Scene placed(const Vec3d& offset, double scale) {
  SceneBuilder b;
  const auto at = [&](const Vec3d& p) { return (p + offset) * scale; };
  b.image(12, 8, 16).bounces(4).step(0.1 * scale);
  b.perspective(at({0, 0.5, 5}), at({0, 0, 0}), 40);
  const auto inverse_scale = static_cast<float>(1 / scale);
  const scene::MediumId medium = b.shader({Rgb(3 * inverse_scale), Rgb(0.9f)}, [&](const support::Point& p) {
    return p.x * 0.0f + 1.0f;  // a constant that the march does not know of
  });
  b.volume(scene::Sphere{{0, 0, 0}, scale}, medium, Transform::translate(at({0, 0, 0})));
  b.surface(scene::Plane{at({0, -1, 0}), {0, 1, 0}}, Rgb(0.5f));
  b.sphere_light(at({1.5, 2, 1}), 0.2 * scale, Rgb(static_cast<float>(50 * scale * scale)));
  b.environment(0.1f);
  return b.scene;
}

// Mean over the picture of |a - b| / (a + b), the same random numbers in both.
double difference(const scene::Scene& a, const scene::Scene& b) {
  const compile::CompiledScene first = compile::compile(a), second = compile::compile(b);
  const render::RenderResult fa = render::render(first, {}), fb = render::render(second, {});
  EXPECT_EQ(fa.statistics.bad_samples, 0u);
  EXPECT_EQ(fb.statistics.bad_samples, 0u);
  double sum = 0;
  for (int y = 0; y < fa.film.height(); ++y)
    for (int x = 0; x < fa.film.width(); ++x) {
      const double p = luminance(fa.film.mean(x, y)), q = luminance(fb.film.mean(x, y));
      EXPECT_GT(p, 0);
      sum += std::abs(p - q) / (p + q);
    }
  return sum / (fa.film.width() * fa.film.height());
}

// At 1e7 m a float's step is a metre; the recentred world keeps the picture. A double's step there is 2e-9 m:
// a few paths may fall out otherwise at edges, the rest is the same to rounding.
TEST(Extremes, FarFromTheOrigin) { EXPECT_LT(difference(placed({}, 1), placed({1e7, -2e7, 1e7}, 1)), 1e-4); }

// A scene of micrometres, or of thousands of kilometres, with the same optical depths and light per area.
TEST(Extremes, TinyAndHuge) {
  EXPECT_LT(difference(placed({}, 1), placed({}, 1e-6)), 1e-4);
  EXPECT_LT(difference(placed({}, 1), placed({}, 1e6)), 1e-4);
}

// 1e5 m of heterogeneous haze at a step of 1 mm: the march is widened, told in the statistics, and still
// right for a medium that is in truth constant, though its bounds do not show it.
TEST(Extremes, LongIntervalsWithSmallStepsAreWidenedAndTold) {
  SceneBuilder b;
  b.image(1, 1, 4).step(1e-3).orthographic({0, 0, 0}, {0, 0, 1}, 1);
  b.volume(scene::Box{{-1e5, -1e5, -1}, {1e5, 1e5, 1e5}},
           b.shader({Rgb(1e-5f), Rgb(0)}, [](const support::Point& p) {
             const support::Expression c = cos(p.x), s = cos(p.x - 1.57079633f);
             return c * c + s * s;
           }));
  b.environment(1);
  const compile::CompiledScene world = compile::compile(b.scene);
  const render::RenderResult result = render::render(world, {});
  EXPECT_EQ(result.statistics.widened_steps.rays, 4u);
  EXPECT_EQ(result.statistics.widened_steps.asked, 1e-3);
  EXPECT_DOUBLE_EQ(result.statistics.widened_steps.reached, 1e5 / 4096);
  EXPECT_NEAR(result.film.mean(0, 0).x, std::exp(-1.0), 1e-5);
}

// sigma * length from 1e-30 to 1e30 in one medium: transmittance is its closed form, nothing overflows.
TEST(Extremes, OpticalDepthsOverSixtyDecades) {
  for (int exponent = -30; exponent <= 30; exponent += 3) {
    const double tau = std::pow(10.0, exponent);
    SceneBuilder b;
    b.image(1, 1, 8).bounces(0).orthographic({0, 0, 5}, {0, 0, 0}, 0.1);
    b.volume(scene::Box{{-1, -1, 0}, {1, 1, 1}},
             b.constant({.sigma_t = Rgb(static_cast<float>(tau)), .albedo = Rgb(0.5f)}));
    b.quad_light({0, 0, -5}, {10, 0, 0}, {0, 10, 0}, Rgb(1));
    const compile::CompiledScene world = compile::compile(b.scene);
    render::ThreadContext thread;
    render::RayMarcher marcher;
    render::March march;
    marcher.march(world, {{{0, 0, 0}, {0, 0, -1}, 1e9}, compile::RayKind::camera, 1, &march}, thread);
    ASSERT_EQ(march.count, 1u);
    EXPECT_NEAR(march.transmittance[0][1], std::exp(-static_cast<double>(static_cast<float>(tau))), 1e-7)
        << tau;
    // ∫ sigma_s T = albedo (1 - e^-tau), kept to the last digits for thin media.
    EXPECT_NEAR(march.scattered[0][1] / (-0.5 * std::expm1(-tau)), 1, 1e-6) << tau;
    EXPECT_EQ(render::render(world, {}).statistics.bad_samples, 0u) << tau;
  }
}

struct Misbehaviour {
  const char* name;
  float density;
  render::BadValue::Kind kind;
};
class BadShader : public testing::TestWithParam<Misbehaviour> {};

// What a shader must not give is clamped, counted and named by its place; the picture stays finite and is the
// same for one thread and for three.
TEST_P(BadShader, IsClampedCountedAndNamed) {
  SceneBuilder b;
  b.image(4, 4, 4).step(0.1).orthographic({0, 0, 5}, {0, 0, 0}, 1).environment(1);
  const scene::MediumId medium =
      b.shader({Rgb(1), Rgb(0.5f)}, [](const support::Point& p) { return p.x * 0.0f + GetParam().density; });
  const Span place{SourceId(std::size_t{0}), 10, 20};
  for (Span& span : b.scene.media[medium.index].output_spans) span = place;
  b.volume(scene::Box{{-1, -1, -1}, {1, 1, 1}}, medium);
  const compile::CompiledScene world = compile::compile(b.scene);
  render::RenderOptions one, three;
  one.threads = 1;
  three.threads = 3;
  const render::RenderResult result = render::render(world, one), again = render::render(world, three);
  ASSERT_FALSE(result.statistics.bad_values.empty());
  for (const render::BadValue& bad : result.statistics.bad_values) {
    EXPECT_EQ(bad.kind, GetParam().kind);
    EXPECT_EQ(bad.span, place);
    EXPECT_EQ(bad.shader, "shader");
    EXPECT_GT(bad.count, 0u);
  }
  EXPECT_EQ(result.statistics.bad_samples, 0u);
  EXPECT_EQ(result.film.image().pixels, again.film.image().pixels);
  for (const float v : result.film.image().pixels) EXPECT_TRUE(std::isfinite(v));
}

INSTANTIATE_TEST_SUITE_P(Extremes, BadShader,
                         testing::Values(Misbehaviour{"NaN", NAN, render::BadValue::Kind::undefined},
                                         Misbehaviour{"Infinity", INFINITY, render::BadValue::Kind::above},
                                         Misbehaviour{"Negative", -2, render::BadValue::Kind::below}),
                         [](const auto& named) { return named.param.name; });

}  // namespace UNNAMED
}  // namespace tyndall
