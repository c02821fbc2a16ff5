// Invariants without numbers: scaling, addition of lights, addition of media.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "support/law_scenes.h"
#include "support/measure.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

MediumColors smoke() {
  MediumColors colors;
  colors.sigma_t = Rgb(1, 1.5f, 2);
  colors.albedo = Rgb(0.9f, 0.8f, 0.7f);
  colors.phase = hg(0.5f);
  return colors;
}

// A lumpy ball in thin fog over a floor; everything `k` times as large, and as optically thick.
SceneBuilder room(double k) {
  SceneBuilder builder;
  builder.image(16, 16, 16)
      .bounces(4)
      .step(0.1 * k)
      .perspective(Vec3d(0, 1, 4) * k, Vec3d(0, 0.3, 0) * k, 45);
  const auto inverse = static_cast<float>(1 / k);
  MediumColors ball = smoke(), fog = smoke();
  ball.sigma_t *= inverse;
  fog.sigma_t *= 0.1f * inverse;
  const Density lumps = [inverse](const Point& p) {
    return cos(p.x * (6 * inverse)) * cos(p.y * (5 * inverse)) + 1.f;
  };
  builder.surface(scene::Plane{Vec3d(0, -1, 0) * k, {0, 1, 0}}, Rgb(0.6f, 0.5f, 0.4f))
      .volume(scene::Sphere{{}, k}, builder.shader(ball, lumps))
      .volume(scene::Box{Vec3d(-6, -2, -6) * k, Vec3d(6, 6, 6) * k}, builder.constant(fog));
  return builder;
}

// σ/k with geometry, step ·k and power ·k²: the same picture. Powers of two change no mantissa, so the same
// random numbers meet the same decisions: pixels agree to the rounding of offsets and of the few constants
// with a length.
TEST(Scaling, GivesTheSamePicture) {
  const auto lit = [](double k) {
    SceneBuilder builder = room(k);
    const auto power = static_cast<float>(k * k);
    builder.sphere_light(Vec3d(2, 3, 1) * k, 0.3 * k, Rgb(100 * power))
        .quad_light(Vec3d(-3, 3, 0) * k, Vec3d(0.5, 0, 0) * k, Vec3d(0, 0, 0.5) * k, Rgb(60 * power));
    return measure(builder.scene);
  };
  const Measurement one = lit(1), large = lit(64), small = lit(1.0 / 64);
  for (const Measurement* other : {&large, &small})
    for (int y = 0; y < one.height; y += 8)
      for (int x = 0; x < one.width; x += 8) {
        const Estimate a = one.region(x, y, x + 8, y + 8), b = other->region(x, y, x + 8, y + 8);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(a.mean[c], b.mean[c], 1e-3 * a.mean[c]) << x << "," << y;
      }
}

// Lights that do not shine stay where they are: a black sphere still stands in the others' light.
TEST(Lights, Add) {
  const auto lit = [](float a, float b, float c) {
    SceneBuilder builder = room(1);
    builder.image(16, 16, 64)
        .sphere_light({2, 3, 1}, 0.3, Rgb(100, 50, 20) * a)
        .quad_light({-3, 3, 0}, {0.5, 0, 0}, {0, 0, 0.5}, Rgb(60) * b)
        .environment(0.3f * c)
        .distant_light({1, -2, -1}, Rgb(0.5f, 1, 2) * c, 2);
    return measure(builder.scene).whole();
  };
  const Estimate a = lit(1, 0, 0), b = lit(0, 1, 0), c = lit(0, 0, 1);
  Estimate sum{a.mean + b.mean + c.mean, {}};
  for (std::size_t i = 0; i < 3; ++i)
    sum.standard_error[i] = std::hypot(a.standard_error[i], b.standard_error[i], c.standard_error[i]);
  expect_same(lit(1, 1, 1), sum, 0, 0.01, "three lights");
}

// Two media in one place are one medium with the summed coefficients; here of equal phase functions.
TEST(OverlappingMedia, Add) {
  const auto lit = [](bool two, bool marched) {
    SceneBuilder builder;
    builder.image(16, 16, 64)
        .bounces(8)
        .step(0.1)
        .perspective({0, 0, 4}, {0, 0, 0}, 30)
        .environment(0.2f)
        .sphere_light({2, 2, 2}, 0.3, Rgb(100));
    const auto add = [&](float amount, const Rgb& albedo) {
      MediumColors colors;
      colors.sigma_t = Rgb(amount);
      colors.albedo = albedo;
      colors.phase = hg(0.4f);
      const Density bump = [](const Point& p) {
        const Expression r = length(p);
        return exp(r * r * -2.f) * 2.f;
      };
      builder.volume(scene::Sphere{{}, 1}, marched ? builder.shader(colors, bump) : builder.constant(colors));
    };
    if (two) {
      add(1, Rgb(0.9f, 0.5f, 0.1f));
      add(0.5f, Rgb(0.3f, 0.8f, 1));
    } else {
      add(1.5f, Rgb((0.9f + 0.15f) / 1.5f, (0.5f + 0.4f) / 1.5f, (0.1f + 0.5f) / 1.5f));
    }
    return measure(builder.scene).whole();
  };
  for (const bool marched : {false, true})
    expect_same(lit(true, marched), lit(false, marched), 0, 0.01, marched ? "marched" : "constant");
}

// A mixture of phase functions is the same whether it is two media or one medium of two lobes.
TEST(OverlappingMedia, MixTheirPhaseFunctions) {
  const auto lit = [](bool two) {
    SceneBuilder builder;
    builder.image(16, 16, 64)
        .bounces(8)
        .perspective({0, 0, 4}, {0, 0, 0}, 30)
        .sphere_light({2, 2, -2}, 0.3, Rgb(100));
    const scene::Sphere ball{{}, 1};
    MediumColors forward, backward;
    forward.sigma_t = Rgb(1.2f);
    backward.sigma_t = Rgb(0.4f);
    forward.phase = hg(0.7f);
    backward.phase = hg(-0.5f);
    if (two) {
      builder.volume(ball, builder.constant(forward)).volume(ball, builder.constant(backward));
    } else {
      scene::ConstantMedium both;
      both.sigma_t = both.sigma_s = Rgb(1.6f);
      both.phase = {forward.phase, backward.phase};
      both.phase[0].weight.value = 0.75f;
      both.phase[1].weight.value = 0.25f;
      builder.volume(ball, add_constant_medium(builder.scene, both));
    }
    return measure(builder.scene).whole();
  };
  expect_same(lit(true), lit(false), 0, 0.01, "lobes");
}

}  // namespace
}  // namespace tyndall
