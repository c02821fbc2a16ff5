// Steps that are chosen for volumes: what a march does to a line in the mean, and the pilot's choice.
#include "compile/steps/choose_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "compile/steps/line_profile.h"
#include "support/filled.h"
#include "support/scene_text.h"

namespace tyndall::compile {
namespace UNNAMED {

using Extinction = std::function<double(double)>;

LineProfile profile_of(double length, const Extinction& extinction, std::size_t places = 4096) {
  std::vector<double> at(places);
  std::vector<PlaceCoefficients> values(places);
  for (std::size_t k = 0; k < places; ++k) {
    at[k] =
        (static_cast<double>(k) + open_unit_double(hash_bits(k, 7))) * length / static_cast<double>(places);
    const auto sigma = static_cast<float>(extinction(at[k]));
    values[k] = {sigma, 0.5f * sigma, 2 * sigma};
  }
  return {length, at, values};
}

TEST(LineProfile, OfWhatIsUniformIsRightAtAnyStep) {
  for (const double depth : {1e-6, 0.3, 4.0, 40.0}) {
    const LineProfile profile = profile_of(
        2, [&](double) { return depth / 2; }, 64);
    for (const double step : {5.0, 0.7, 0.11}) {
      const LineProfile::Compared c = profile.compared(step);
      EXPECT_NEAR(c.marched.transmitted / std::exp(-depth), 1, 1e-5 * (1 + depth)) << depth << " " << step;
      EXPECT_NEAR(c.marched.emitted / c.exact.emitted, 1, 1e-5) << depth << " " << step;
      EXPECT_NEAR(c.marched.scattered / c.exact.scattered, 1, 1e-4) << depth << " " << step;
    }
  }
}

// By chance, as marches go: segments of one length, places in mirrored pairs.
TEST(LineProfile, HasTheMeanOfMarches) {
  const Extinction lumps = [](double t) { return 4 * sqr(std::sin(5 * t)) * std::exp(-sqr(t - 1)); };
  const LineProfile profile = profile_of(2, lumps);
  for (const int count : {3, 8, 17}) {
    const double h = 2.0 / count;
    double sum = 0, squares = 0;
    constexpr int marches = 40000;
    for (int march = 0; march < marches; ++march) {
      double depth = 0, place = 0;
      for (int k = 0; k < count; ++k) {
        place = k % 2 == 0 ? open_unit_double(
                                 hash_bits(static_cast<std::uint64_t>(march), static_cast<std::uint64_t>(k)))
                           : 1 - place;
        depth += h * lumps((k + place) * h);
      }
      sum += std::exp(-depth);
      squares += std::exp(-2 * depth);
    }
    const double mean = sum / marches, error = std::sqrt((squares / marches - mean * mean) / marches);
    // The profile's own error: straight lines between 4096 places.
    EXPECT_NEAR(profile.compared(2.0 / (count - 0.5)).marched.transmitted, mean, 4 * error + 2e-3 * mean)
        << count;
  }
}

TEST(LineProfile, KnowsWhereAShareIsReached) {
  const LineProfile profile = profile_of(3, [](double t) { return t < 1 ? 0.0 : 2.0; });
  EXPECT_NEAR(profile.place_of_share(0), 1, 0.01);
  // Half of 1 - e^-4.
  EXPECT_NEAR(profile.place_of_share(0.5), 1 - std::log(1 - 0.5 * -std::expm1(-4.0)) / 2, 0.01);
}

// A cloud whose size is the unit: `scale` metres.
CompiledScene cloud_of(double scale, const std::string& step = "") {
  return compile(support::scene_of(support::filled(R"(
render { resolution: (32, 32)  samples: 4 $STEP }
camera perspective { from: (0, 0, 4 * $SCALE)  to: (0, 0, 0)  fov: 36deg }
volume {
  in: sphere { radius: $SCALE }
  medium: { density = 8 / $SCALE * smoothstep(1, 0.4, length(p) / $SCALE + 0.35 * fbm(p * 3 / $SCALE))  albedo = 0.9 }
}
light distant { direction: (-1, -1, -0.5)  irradiance: 4 }
)",
                                                   {{"SCALE", scale}, {"STEP", step}})));
}

TEST(ChosenSteps, ScaleWithTheScene) {
  const double one = cloud_of(1).volumes[0].step.metres;
  EXPECT_GT(one, 0.01);
  EXPECT_LT(one, 0.2);
  for (const double scale : {1e-3, 0.1, 1e5})
    EXPECT_NEAR(cloud_of(scale).volumes[0].step.metres / scale / one, 1, 0.05) << scale;
}

TEST(ChosenSteps, AreTheSameEachTime) {
  EXPECT_EQ(cloud_of(1).volumes[0].step.metres, cloud_of(1).volumes[0].step.metres);
}

TEST(ChosenSteps, AreFinerForLessBias) {
  double before = infinity;
  for (const char* step : {"", "step: adaptive(0.1%)", "step: adaptive(0.02%)"}) {
    const double metres = cloud_of(1, step).volumes[0].step.metres;
    EXPECT_LT(metres, before) << step;
    before = metres;
  }
}

TEST(ChosenSteps, OnesThatAreGivenAreKeptAndTheirBiasIsTold) {
  const CompiledScene fine = cloud_of(1, "step: 0.01"), coarse = cloud_of(1, "step: 0.8");
  EXPECT_EQ(fine.volumes[0].step.metres, 0.01);
  EXPECT_EQ(coarse.volumes[0].step.metres, 0.8);
  EXPECT_TRUE(fine.step_bias.known);
  EXPECT_LT(fine.step_bias.share, 0.005);
  EXPECT_GT(coarse.step_bias.share, 0.02);
  EXPECT_LT(coarse.step_bias.enough, 0.2);
}

// A slab of fog in a box a thousand times as thick: segments where bounds are apart, few elsewhere.
TEST(ChosenSteps, ChangeFromCellToCellWhereThatSavesMost) {
  const auto world_of = [](const std::string& density) {
    return compile(
        support::scene_of("render { resolution: (8, 8) }\n"
                          "camera orthographic { from: (0, 0, 15)  to: (0, 0, 0)  height: 1 }\n"
                          "volume { in: box { min: (-1, -1, -10)  max: (1, 1, 10) }  medium: {\n"
                          "  albedo = 0  density = " +
                          density + " } }\nlight environment { radiance: 1 }\n"));
  };
  EXPECT_GT(world_of("0.01 + (if abs(p.z - 0.003) < 0.01 then 100 else 0)").volumes[0].most_spread, 0);
  EXPECT_EQ(world_of("0.01 + 0.005 * sin(p.z)").volumes[0].most_spread, 0);
}

TEST(ChosenSteps, NothingIsToldOfWhatIsHomogeneous) {
  const CompiledScene world =
      compile(support::scene_of("camera perspective { from: (0, 0, 4)  to: (0, 0, 0) }\n"
                                "volume { in: sphere {}  medium: { density = 3  albedo = 0.5 } }\nlight "
                                "environment { radiance: 1 }\n"));
  EXPECT_FALSE(world.step_bias.known);
}

}  // namespace UNNAMED
}  // namespace tyndall::compile
