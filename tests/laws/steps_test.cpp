// Steps that nobody chose: pictures at them are right, and what is told of steps that are too long is true.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "base/numerics.h"
#include "render/render.h"
#include "support/filled.h"
#include "support/scene_text.h"

namespace tyndall {
namespace UNNAMED {

scene::Scene bench_scene(const std::string& name) {
  std::ifstream file(TYNDALL_SOURCE_DIR "/tests/bench/steps/" + name + ".tyn", std::ios::binary);
  EXPECT_TRUE(file.good()) << name;
  return support::scene_of({std::istreambuf_iterator<char>(file), {}});
}

// Of a picture, with its standard error.
struct Mean {
  double value = 0, error = 0;
  double segments = 0;  // a sample
};
Mean mean_of(const compile::CompiledScene& world, int samples) {
  constexpr int groups = 16;
  Mean out;
  double squares = 0;
  for (int g = 0; g < groups; ++g) {
    render::RenderOptions options;
    options.first_sample = g * (samples / groups);
    options.sample_count = samples / groups;
    const render::RenderResult result = render::render(world, options);
    const auto [width, height] = world.scene.settings.resolution;
    double mean = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Rgb light = result.film.mean(x, y);
        mean += (double{light.x} + double{light.y} + double{light.z}) / (3.0 * width * height);
      }
    out.value += mean / groups;
    squares += mean * mean / groups;
    out.segments += static_cast<double>(result.statistics.segments) /
                    static_cast<double>(result.statistics.samples) / groups;
  }
  out.error = safe_sqrt((squares - sqr(out.value)) / (groups - 1));
  return out;
}

compile::CompiledScene with_step(scene::Scene scene, const scene::Step& step) {
  scene.settings.step = step;
  return compile::compile(std::move(scene));
}

double metres_of(const compile::CompiledScene& world) {
  for (const compile::CompiledVolume& volume : world.volumes)
    if (volume.grid != compile::no_index) return volume.step.metres;
  return 0;
}

class Steps : public testing::TestWithParam<const char*> {};
class ToldSteps : public Steps {};

// Within half a percent of the picture at an eighth of the step, and 4 standard errors.
TEST_P(Steps, ChosenOnesKeepThePicture) {
  const scene::Scene scene = bench_scene(GetParam());
  const compile::CompiledScene world = with_step(scene, {});
  const Mean usual = mean_of(world, 128), fine = mean_of(with_step(scene, metres_of(world) / 8), 128);
  EXPECT_NEAR(usual.value / fine.value, 1, 0.005 + 4 * std::hypot(usual.error, fine.error) / fine.value);
  EXPECT_LE(world.step_bias.share, 0.0051);
}

TEST_P(ToldSteps, AreOffByWhatIsTold) {
  const scene::Scene scene = bench_scene(GetParam());
  const double metres = metres_of(with_step(scene, {}));
  const compile::CompiledScene coarse = with_step(scene, metres * 5);
  const Mean fine = mean_of(with_step(scene, metres / 8), 128), seen = mean_of(coarse, 128);
  const double error = 4 * std::hypot(seen.error, fine.error) / fine.value,
               bias = std::abs(seen.value / fine.value - 1), told = coarse.step_bias.share;
  ASSERT_GT(bias, 2 * error) << "too few samples to tell";
  EXPECT_GT(told, (bias - error) / 2.5);
  EXPECT_LT(told, (bias + error) * 2.5);
}

std::string word_of(const testing::TestParamInfo<const char*>& name) {
  std::string word = name.param;
  std::erase(word, '-');
  return word;
}
INSTANTIATE_TEST_SUITE_P(OfScenes, Steps, testing::Values("cloud", "smoke-of-a-candle", "soot", "speck"),
                         word_of);
INSTANTIATE_TEST_SUITE_P(OfScenes, ToldSteps, testing::Values("cloud", "smoke-of-a-candle", "soot"), word_of);

// A sheet of 10 m and depth 2 in 20 km of haze: a thousandth of what a ray passes.
TEST(StepsByDefault, AThinSheetIsFoundWithoutThousandsOfSegmentsEverywhere) {
  const scene::Scene scene = support::scene_of(
      "render { resolution: (8, 8)  samples: 64 }\n"
      "camera orthographic { from: (0, 0, 15km)  to: (0, 0, 0)  height: 100m }\n"
      "light environment { radiance: 1 }\n"
      "volume { in: box { min: (-1km, -1km, -10km)  max: (1km, 1km, 10km) }  medium: {\n"
      "  density = 1e-5 * (1 + 0.5 * sin(p.z / 50)) + (if abs(p.z - 3m) < 5m then 0.2 else 0)\n"
      "  scattering = 0  absorption = 1 } }\n");
  const compile::CompiledScene world = with_step(scene, {});
  const Mean mean = mean_of(world, 64);
  EXPECT_NEAR(mean.value, std::exp(-2.2), 0.01 * std::exp(-2.2) + 4 * mean.error);
  EXPECT_LT(mean.segments, 2048);
}

// The same scene in other units: the same picture, for the same segments.
TEST(StepsByDefault, PicturesDoNotDependOnTheScale) {
  const auto world_of = [](double scale) {
    return compile::compile(support::scene_of(support::filled(R"(
render { resolution: (32, 24)  samples: 64  bounces: 2 }
let unit = $SCALE
camera perspective { from: (0, 0, 4 * unit)  to: (0, 0, 0)  fov: 36deg }
volume {
  in: sphere { radius: unit }
  medium: { density = 8 / unit * smoothstep(1, 0.4, length(p) / unit + 0.35 * fbm(p * 3 / unit))  albedo = 0.9 }
}
light distant { direction: (-1, -1, -0.5)  irradiance: 4 }
)",
                                                              {{"SCALE", scale}})));
  };
  const Mean one = mean_of(world_of(1), 64);
  for (const double scale : {1e-3, 1e5}) {
    const Mean other = mean_of(world_of(scale), 64);
    EXPECT_NEAR(other.value, one.value, 4 * std::hypot(other.error, one.error)) << scale;
    EXPECT_NEAR(other.segments / one.segments, 1, 0.05) << scale;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
