// The light that the limit of bounces leaves out, as it is told and as it is.
#include "render/context/cut_light.h"

#include <gtest/gtest.h>

#include <string>

#include "render/render.h"
#include "support/filled.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

struct Cut {
  double mean = 0, share = 0;
};
Cut render_with(const std::string& things, int bounces) {
  scene::Scene scene = support::scene_of(
      "render { resolution: (8, 8)  samples: 256 }\n"
      "camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 1.2 }\n" +
      things);
  scene.settings.bounces = bounces;
  const RenderResult result = render(compile::compile(std::move(scene)), {});
  double sum = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Rgb c = result.film.mean(x, y);
      sum += (c.x + c.y + c.z) / (3 * 64);
    }
  return {sum, result.statistics.cut_share()};
}

std::string cloud(const std::string& albedo, const std::string& light) {
  return support::filled(R"(
volume { in: sphere {}  medium: { density = 20  albedo = $ALBEDO } }
$LIGHT
)",
                         {{"ALBEDO", albedo}, {"LIGHT", light}});
}

// In a white furnace every path that is cut would have brought 1, whatever is left of the picture.
TEST(CutLight, IsExactInAWhiteFurnace) {
  for (const int bounces : {0, 1, 2, 7, 24}) {
    const Cut cut = render_with(cloud("1", "light environment { radiance: 1 }"), bounces);
    EXPECT_GT(cut.share, 0.1);
    EXPECT_NEAR(cut.share, 1 - cut.mean, 0.02) << bounces << " bounces";
  }
}

// Elsewhere it is an estimate: half to one and a half of what is left out, with rays after the last bounce
// and, under a point light, without. Where not even one bounce tells what leaves the cloud it may be more.
TEST(CutLight, IsNearWhatMoreBouncesBring) {
  for (const std::string light :
       {"light environment { radiance: (2, 1, 0.5) }", "light point { position: (0, 2, 2)  power: 9 }"})
    for (const std::string albedo : {"0.95", "(0.99, 0.9, 0.7)"}) {
      const std::string things = cloud(albedo, light);
      const Cut whole = render_with(things, 1024);
      EXPECT_LT(whole.share, 0.001) << things;
      for (const int bounces : {0, 3, 8}) {
        const Cut cut = render_with(things, bounces);
        const double left_out = 1 - cut.mean / whole.mean;
        EXPECT_GT(cut.share, 0.5 * left_out) << things << bounces << " bounces";
        if (bounces > 0) {
          EXPECT_LT(cut.share, 1.5 * left_out + 0.01) << things << bounces << " bounces";
        }
      }
    }
}

// A white floor carries all of a path on, but to where no light is.
TEST(CutLight, ThroughputThatFindsNoLightIsNone) {
  const std::string things =
      "plane { point: (0, 0, -1)  normal: (0, 0, 1)  material: { base_color = 1 } }\n"
      "light point { position: (0, 0, 2)  power: 9 }\n";
  EXPECT_LT(render_with(things, 1).share, 0.001);
}

}  // namespace UNNAMED
}  // namespace tyndall::render
