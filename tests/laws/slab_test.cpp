// Van de Hulst's slabs: reflection and transmission with all orders of scattering.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include <cmath>

#include "support/law_scenes.h"
#include "support/measure.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;

constexpr double truth_digits = 5e-6;

class Slabs : public testing::TestWithParam<Slab> {};

TEST_P(Slabs, PublishedReflectionAndTransmission) {
  for (const SlabView view : {SlabView::reflection, SlabView::transmission}) {
    SceneBuilder builder = slab(GetParam(), view);
    builder.image(32, 32, 16);
    expect_truth(measure(builder.scene).whole(), view == SlabView::reflection ? GetParam().R : GetParam().T,
                 truth_digits, 0.01, describe(GetParam(), view));
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, Slabs, testing::ValuesIn(slab_rows));

// The same rows with the extinction varying in depth at equal optical thickness, so that the march is what is
// tested.
struct Profile {
  std::string name;
  Density density;
  double total_variation;  // of the density, over the depth [1/m]
  double step;
};

std::vector<Profile> profiles() {
  const auto spikes = [](const Point& p) {
    constexpr float width = 0.02f;
    const auto spike = [&](float at) {
      const Expression d = (p.y - at) * (1 / width);
      return exp(d * d * -0.5f) * static_cast<float>(1 / (3 * width * std::sqrt(2 * pi)));
    };
    return (spike(0.2f) + spike(0.5f) + spike(0.85f)) * 0.9f + 0.1f;
  };
  return {
      {"3x²", [](const Point& p) { return p.y * p.y * 3.f; }, 3, 1.0 / 256},
      {"layers", [](const Point& p) { return 1.8f - less(fract(p.y * 4.f), 0.5f) * 1.6f; }, 11.2, 1.0 / 512},
      {"spikes", spikes, 36, 1.0 / 1024}};
}

class SlabsInDepth : public testing::TestWithParam<int> {};

// The bias bound, stated before: each march has E[τ̂] = τ and |τ̂ - τ| <= step τ TV / 2, so a transmittance is
// too large by at most (step τ TV)²/8 of itself; a path of this τ has about four of them to a vertex that
// counts.
TEST_P(SlabsInDepth, PublishedReflectionAndTransmission) {
  const Profile profile = profiles()[static_cast<std::size_t>(GetParam())];
  for (const std::size_t index : {std::size_t{2}, std::size_t{5}, std::size_t{8}}) {
    const Slab& row = slab_rows[index];
    for (const SlabView view : {SlabView::reflection, SlabView::transmission}) {
      SceneBuilder builder = slab(row, view, profile.density);
      builder.image(32, 32, 4).step(profile.step);
      const double truth = view == SlabView::reflection ? row.R : row.T;
      const double bias = 0.5 * std::pow(profile.step * row.tau * profile.total_variation, 2);
      expect_truth(measure(builder.scene).whole(), truth, truth_digits + bias * truth, 0.02,
                   profile.name + " " + describe(row, view));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, SlabsInDepth, testing::Range(0, 3));

}  // namespace
}  // namespace tyndall
