// Media that are the same everywhere and change while the shutter is open: means over the time, for every
// output and every way through a medium.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"
#include "support/ways.h"

namespace tyndall::render {
namespace UNNAMED {

struct TimedMedium {
  std::string name, body, light;
  double truth;
};

const std::string sky = "light environment { radiance: 1 }\n";
// From where the camera looks, through 2 m of medium.
const std::string sun = "light distant { direction: (0, 0, -1)  irradiance: 1 }\n";

// The time goes from 0 to 1. A sun behind the camera brings p / sigma_t (1 - e^(-4 sigma_t)) / 2 * sigma_s,
// with the phase function p of turning back.
std::vector<TimedMedium> timed_media() {
  const double through = (1 - std::exp(-2.0)) / 2;                   // ∫ e^(-2 t) dt
  const double back = 1 - std::exp(-4.0), isotropic = 1 / (4 * pi);  // of density 1
  return {
      {"density", "density = time  scattering = 0  absorption = 1", sky, through},
      {"absorption", "absorption = time", sky, through},
      {"extinction", "albedo = 0  extinction = time", sky, through},
      {"density towards a light", "density = time  albedo = 1", sun, isotropic / 2 * (1 - back / 4)},
      {"scattering", "scattering = time  absorption = 1 - time", sun, isotropic / 2 * back / 2},
      {"albedo", "albedo = time", sun, isotropic / 2 * back / 2},
      {"emission", "emission = time", "", 1},
      {"density of emission", "density = time  emission = 1", "", 1},
      {"parameter of a phase function", "albedo = 1  phase = hg(0.5 * step(0.5, time))", sun,
       back / 4 * (isotropic + isotropic * 0.75 / std::pow(2.25, 1.5))},
      {"weight of a phase function", "albedo = 1  phase = mix(isotropic, rayleigh, time)", sun,
       back / 4 * (isotropic + 3 / (8 * pi))},
  };
}

scene::Scene scene_with(const TimedMedium& m) {
  return support::scene_of(support::filled(R"(
render { resolution: (4, 4)  samples: 64  bounces: 0 }
animation { fps: 1  frames: 0..1  shutter: 360deg }
camera orthographic { from: (0, 0, 5)  to: (0, 0, 0)  height: 0.1 }
$LIGHT
volume { in: box { min: (-1, -1, -1)  max: (1, 1, 1) }  medium: { $BODY } }
)",
                                           {{"LIGHT", m.light}, {"BODY", m.body}}));
}

class HomogeneousInTime : public testing::TestWithParam<support::Way> {};

TEST_P(HomogeneousInTime, HaveTheMeanOfTheirMoments) {
  for (const TimedMedium& m : timed_media()) {
    const scene::Scene scene = scene_with(m);
    ASSERT_TRUE(scene.media[0].homogeneous()) << m.name;
    const support::Estimate mean = support::measure(scene, GetParam().options()).whole();
    support::expect_truth(mean, m.truth, 2e-6 * m.truth, 0.03, m.name);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, HomogeneousInTime, testing::ValuesIn(support::ways()),
                         [](const auto& way) { return way.param.name; });

}  // namespace UNNAMED
}  // namespace tyndall::render
