// The scene at the end of the language's description, and settings: text becomes the right numbers.
#include <numbers>

#include "resolved.h"

namespace tyndall {
namespace UNNAMED {

constexpr const char* whole_scene = R"(
// Light through a drifting cloud.
render    { resolution: (640, 360)  samples: 64  step: 0.05  light_samples: 2  bounces: 8 }
animation { fps: 24  frames: 1..48  shutter: 180deg }
camera perspective { from: (0, 1, 6 - 0.2 * time)  to: (0, 1, 0)  fov: 40deg }

medium cloud(height = 1) {
  density = 20 * smoothstep(1, 0.4, length(p / (1, height, 1)) + 0.35 * fbm(p * 2.3 - (0, 0.4 * time, 0), octaves: 6))
  albedo  = 0.99
  phase   = hg(0.6)
}
volume { in: sphere { radius: 1.4 }  medium: cloud(height: 0.7)  transform: translate((0, 1, 0)) }
light sphere { center: (2, 3, 1)  radius: 0.2  power: 100 }
light environment { radiance: (0.05, 0.08, 0.12) }
)";

constexpr double degree = std::numbers::pi / 180;

TEST(WholeScene, HasTheNumbersOfItsText) {
  const Resolved r = resolve_text(whole_scene);
  ASSERT_TRUE(r.diagnostics.all().empty()) << r.messages();
  const scene::Scene& s = r.scene;
  EXPECT_EQ(s.settings.resolution.width, 640);
  EXPECT_EQ(s.settings.resolution.height, 360);
  EXPECT_EQ(s.settings.samples, 64);
  EXPECT_EQ(s.settings.step, 0.05);
  EXPECT_EQ(s.settings.light_samples, 2);
  EXPECT_EQ(s.settings.bounces, 8);
  EXPECT_EQ(s.animation.fps, 24);
  EXPECT_EQ(s.animation.first_frame, 1);
  EXPECT_EQ(s.animation.last_frame, 48);
  EXPECT_NEAR(s.animation.shutter.closes.radians, std::numbers::pi, 1e-15);
  EXPECT_EQ(s.frame, 1);
  EXPECT_EQ(s.time, 1 / 24.0);

  const auto& camera = std::get<scene::PerspectiveCamera>(s.camera);
  EXPECT_EQ(camera.from, Vec3d(0, 1, 6 - 0.2 * (1 / 24.0)));
  EXPECT_EQ(camera.to, Vec3d(0, 1, 0));
  EXPECT_NEAR(camera.fov.radians, 40 * degree, 1e-15);

  ASSERT_EQ(s.volumes.size(), 1u);
  EXPECT_EQ(std::get<scene::Sphere>(s.volumes[0].shape).radius, 1.4);
  EXPECT_EQ(s.volumes[0].world_from_medium, Transform::translate({0, 1, 0}));
  EXPECT_EQ(s.volumes[0].world_from_shape, Transform::translate({0, 1, 0}));
  ASSERT_EQ(s.media.size(), 1u);
  EXPECT_EQ(s.media[0].name, "cloud");
  EXPECT_FALSE(s.media[0].homogeneous());
  ASSERT_EQ(s.media[0].phase.size(), 1u);
  EXPECT_EQ(s.media[0].phase[0].kind, optics::phase_kind<optics::HenyeyGreenstein>);
  EXPECT_EQ(s.media[0].phase[0].parameters[0].value, 0.6f);

  ASSERT_EQ(s.lights.size(), 2u);
  const auto& lamp = std::get<scene::AreaLight>(s.lights[0].light);
  const auto& sphere = std::get<scene::Sphere>(lamp.shape);
  EXPECT_EQ(sphere.center, Vec3d(2, 3, 1));
  EXPECT_EQ(sphere.radius, 0.2);
  EXPECT_EQ(lamp.power, Rgb(100, 100, 100));
  EXPECT_EQ(std::get<scene::EnvironmentLight>(s.lights[1].light).radiance.color, Rgb(0.05f, 0.08f, 0.12f));
}

TEST(WholeScene, FollowsTheFrame) {
  resolve::Options options;
  options.frame = 24;
  const Resolved r = resolve_text(whole_scene, options);
  ASSERT_TRUE(r.diagnostics.all().empty()) << r.messages();
  EXPECT_EQ(r.scene.frame, 24);
  EXPECT_EQ(r.scene.time, 1);
  EXPECT_EQ(std::get<scene::PerspectiveCamera>(r.scene.camera).from, Vec3d(0, 1, 6 - 0.2));
}

TEST(Animation, DecidesTheTimeOfWhatStandsAboveIt) {
  const Resolved r = resolve_clean(
      R"(
let rate = 10
sphere { radius: 1 + time }
animation { fps: rate * 2  frames: 30..40 }
sphere { radius: frame }
)");
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(0).shape).radius, 2.5);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(1).shape).radius, 30);
}

TEST(Animation, LeavesTheLastFrameOutWhenAsked) {
  const Resolved r = resolve_clean("animation { fps: 24 frames: 0..<48 }");
  EXPECT_EQ(r.scene.animation.first_frame, 0);
  EXPECT_EQ(r.scene.animation.last_frame, 47);
}

TEST(Animation, WithoutItTimeIsZero) {
  resolve::Options options;
  options.frame = 7;
  const Resolved r = resolve_clean("sphere { radius: 1 + time + frame }", options);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(0).shape).radius, 8);
  EXPECT_EQ(r.scene.time, 0);
}

TEST(Units, AreMetresAndRadians) {
  const Resolved r = resolve_clean(
      R"(
sphere { radius: 3mm }
sphere { radius: 2cm }
sphere { radius: 1.5km }
sphere { center: (1cm, 2m, 3) }
render { step: 25mm  samples: 2 }
light distant { direction: (0, -1, 0)  irradiance: 50%  angle: 90deg }
)");
  const auto radius = [&](std::size_t i) {
    return std::get<scene::Sphere>(r.scene.shapes.at(i).shape).radius;
  };
  EXPECT_DOUBLE_EQ(radius(0), 0.003);
  EXPECT_DOUBLE_EQ(radius(1), 0.02);
  EXPECT_DOUBLE_EQ(radius(2), 1500);
  expect_near(std::get<scene::Sphere>(r.scene.shapes.at(3).shape).center, {0.01, 2, 3});
  EXPECT_DOUBLE_EQ(r.scene.settings.step.metres, 0.025);
  const auto& light = std::get<scene::DistantLight>(r.scene.lights.at(1).light);
  EXPECT_EQ(light.irradiance, Rgb(0.5f, 0.5f, 0.5f));
  EXPECT_NEAR(light.angle.radians, 90 * degree, 1e-15);
}

TEST(Print, IsTheSameForTheSameScene) {
  EXPECT_EQ(scene::print(resolve_text(whole_scene).scene), scene::print(resolve_text(whole_scene).scene));
}

TEST(Print, DoesNotKnowTheLayout) {
  const std::string spread = std::string("\n\n/* moved */\n") + whole_scene;
  EXPECT_EQ(scene::print(resolve_text(whole_scene).scene), scene::print(resolve_text(spread).scene));
}

// Each of these changes one number of the scene: the print, and so the hash, must change.
TEST(Print, ShowsEveryNumber) {
  const std::string print = scene::print(resolve_text(whole_scene).scene);
  const std::pair<std::string, std::string> changes[] = {{"640", "641"},
                                                         {"samples: 64", "samples: 65"},
                                                         {"step: 0.05", "step: 0.051"},
                                                         {"light_samples: 2", "light_samples: 3"},
                                                         {"bounces: 8", "bounces: 9"},
                                                         {"1..48", "1..49"},
                                                         {"180deg", "90deg"},
                                                         {"fps: 24", "fps: 25"},
                                                         {"40deg", "41deg"},
                                                         {"density = 20", "density = 21"},
                                                         {"0.99", "0.98"},
                                                         {"hg(0.6)", "hg(0.61)"},
                                                         {"hg(0.6)", "rayleigh"},
                                                         {"radius: 1.4", "radius: 1.5"},
                                                         {"translate((0, 1", "translate((0, 2"},
                                                         {"(2, 3, 1)", "(2, 3, 2)"},
                                                         {"radius: 0.2", "radius: 0.3"},
                                                         {"power: 100", "power: 101"},
                                                         {"power: 100", "radiance: 100"},
                                                         {"0.12", "0.13"},
                                                         {"octaves: 6", "octaves: 5"}};
  for (const auto& [from, to] : changes) {
    std::string text = whole_scene;
    text.replace(text.find(from), from.size(), to);
    const Resolved r = resolve_text(text);
    ASSERT_FALSE(r.diagnostics.has_errors()) << r.messages();
    EXPECT_NE(scene::print(r.scene), print) << to;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
