// Light scattered once: what the tables of docs/verification.md, whose rows verification_test.cpp holds, do
// not say. Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include "support/law_scenes.h"
#include "support/measure.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;
using render::Distance;

// Without extinction equi-angular sampling is exact: the weights of all samples are one number. At σ = 1e-6
// the transmittance still moves by 1e-5 from one end of the ray to the other.
TEST(AirlightWithoutExtinction, EquiangularHasNoVariance) {
  SceneBuilder builder = airlight({1e-6, 1, 5, 10, {}}, 0);
  builder.image(32, 32, 1);
  render::RenderOptions options;
  options.distance = Distance::equiangular;
  const Measurement measurement = measure(builder.scene, options);
  double sum = 0, sum_of_squares = 0, count = 0;
  for (const render::Film& film : measurement.films)
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) {
        const double value = film.mean(x, y).y;
        sum += value;
        sum_of_squares += value * value;
        count += 1;
      }
  const double mean = sum / count;
  EXPECT_LE(std::sqrt(std::max(0.0, sum_of_squares / count - mean * mean)) / mean, 1e-5);
  // σs = 0.1 gives 2.18583521e-02; the path through the fog is at most 25 m long.
  EXPECT_NEAR(mean / 2.18583521e-02 * 1e5, 1, 3e-5);
}

// A slab under a distant light straight above, seen straight on: c/(8π) (1 - e^-2τ) and c/(4π) τ e^-τ.
TEST(DistantLight, SlabScatteringOnce) {
  const Slab row{0, 0.9f, 1, 0.03096352, 0.02634742};
  for (const SlabView view : {SlabView::reflection, SlabView::transmission}) {
    SceneBuilder builder = slab(row, view);
    builder.scene.lights.clear();
    builder.image(32, 32, 16).bounces(0).distant_light({0, -1, 0}, Rgb(1));
    expect_truth(measure(builder.scene).whole(), view == SlabView::reflection ? row.R : row.T, 1e-8, 0.01,
                 describe(row, view));
  }
}

// A small disc of the same irradiance gives the same to the second order of its angle: cos and path lengths
// differ by at most (1°)²/8 = 4e-5.
TEST(DistantLight, DiscHasTheIrradianceOfThePoint) {
  const Slab row{0, 0.9f, 1, 0.03096352, 0.02634742};
  SceneBuilder builder = slab(row, SlabView::reflection);
  builder.scene.lights.clear();
  builder.image(32, 32, 16).bounces(0).distant_light({0, -1, 0}, Rgb(1), 1);
  expect_truth(measure(builder.scene).whole(), row.R, 1e-4 * row.R, 0.01, "disc");
}

}  // namespace
}  // namespace tyndall
