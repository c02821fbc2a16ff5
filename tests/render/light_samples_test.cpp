// Many samples of light on one ray: the mean is right however many they are.
#include <gtest/gtest.h>

#include <cmath>

#include "render/lights/light_sum.h"
#include "render/render.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

// A million equal parts of 1: floats alone would end at 0.25 or at 1.01.
TEST(LightSum, GrowsToTheLast) {
  Rgb radiance[2];
  AovSample aovs[2];
  LightSum sum(radiance, aovs);
  constexpr int parts = 1'000'000;
  for (int i = 0; i < parts; ++i) sum.add(1, LightPart::volume_direct, Rgb(1.0f / parts));
  sum.add(0, LightPart::volume_direct, Rgb(3));
  sum.add(0, LightPart::volume_indirect, Rgb(4));
  sum.finish();
  EXPECT_FLOAT_EQ(radiance[1].x, 1);
  EXPECT_FLOAT_EQ(aovs[1].volume_direct.x, 1);
  EXPECT_EQ(radiance[0].y, 7);
  EXPECT_EQ(aovs[0].volume_direct.y, 3);
  EXPECT_EQ(aovs[0].volume_indirect.y, 4);
}

// A lamp beside a ray through fog, single scattering: 1.13752231e-02 by quadrature.
TEST(LightSamples, AreRightUpToTheLimit) {
  const scene::Scene scene = support::scene_of(
      R"(
render { resolution: (1, 1)  samples: 1  step: 0.1  bounces: 0  light_samples: 65536 }
camera perspective { from: (0, 0, 0)  to: (0, 0, 1)  fov: 0.00001deg }
volume { in: box { min: (-20, -20, -20)  max: (20, 20, 20) }  medium: { density = 0.1  albedo = 1 } }
light point { position: (1, 0, 5)  intensity: 1 }
quad { center: (0, 0, 10)  u: (30, 0, 0)  v: (0, 30, 0)  material: { base_color = 0 } }
)");
  const RenderResult result = render(compile::compile(scene), {});
  EXPECT_NEAR(result.film.mean(0, 0).x, 1.13752231e-2f, 2e-6f);
  EXPECT_EQ(result.statistics.shadow_rays, 65536u);
}

}  // namespace UNNAMED
}  // namespace tyndall::render
