// `light sky` is an environment and a disc, and `sky` is what the environment shows.
#include "optics/atmosphere.h"
#include "resolved.h"

namespace tyndall {
namespace UNNAMED {

const std::string sky_camera = "camera perspective { from: (0, 0, 5) to: (0, 0, 0) }\n";

TEST(SkyLight, AndTheFunctionAreOneSky) {
  const Resolved r = resolve_text(sky_camera + R"(
let sun = (3, 2, 1)
light sky { sun: sun  turbidity: 4 }
for d in [(0.02, 1, 0.01), (1, 0.2, 0.1), (-2, 0.01, 3), (0.1, 0.4, -7), (1, -0.5, 0), (3, 2, 1.1)] {
  light distant { direction: -d  irradiance: sky(d, sun, turbidity: 4) }
}
)");
  ASSERT_FALSE(r.diagnostics.has_errors()) << r.messages();
  ASSERT_EQ(r.scene.lights.size(), 8u);
  const auto& sky = std::get<scene::EnvironmentLight>(r.scene.lights[0].light);
  const auto& disc = std::get<scene::DistantLight>(r.scene.lights[1].light);
  expect_near(disc.direction, -normalize(Vec3d{3, 2, 1}));
  EXPECT_NEAR(disc.angle.radians * 180 / pi, 2 * 0.2665, 1e-12);
  for (std::size_t i = 2; i < r.scene.lights.size(); ++i) {
    const auto& looked_up = std::get<scene::DistantLight>(r.scene.lights[i].light);
    const Rgb seen = optics::sky_radiance(sky.radiance, sky.world_from_picture(), -looked_up.direction);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR((*looked_up.irradiance)[c], seen[c], 2e-3f * seen[c]) << i << ' ' << c;
  }
  // The picture is brightest where the disc stands.
  const auto at = [&](const Vec3d& d) {
    return optics::sky_radiance(sky.radiance, sky.world_from_picture(), normalize(d))[1];
  };
  EXPECT_GT(at({3, 2, 1}), 3 * at({-3, 2, 1}));
  EXPECT_GT(at({3, 2, 1}), 3 * at({3, 2, -3}));
}

TEST(SkyLight, HasNoDiscWhenTheSunIsDown) {
  const Resolved r = resolve_text(sky_camera + "light sky { sun: (1, -0.1, 0) }\nsphere {}\n");
  ASSERT_FALSE(r.diagnostics.has_errors()) << r.messages();
  EXPECT_EQ(r.scene.lights.size(), 1u);
}

}  // namespace UNNAMED
}  // namespace tyndall
