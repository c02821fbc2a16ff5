// Every way through a medium gives one picture (invariant 5): the unbiased ones by z-test against the
// reference renderer, which shares nothing with them; the marching ones within a bias stated with the scene.
// 4 standard errors from 16 scramblings (support/measure.h).
#include <gtest/gtest.h>

#include "support/measure.h"
#include "support/method_scenes.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using namespace support;
class Methods : public testing::TestWithParam<int> {};

TEST_P(Methods, GiveOnePicture) {
  const MethodScene one = method_scenes()[static_cast<std::size_t>(GetParam())];
  const Estimate truth = measure_reference(one.scene, 14, 1 << 14);
  for (const Way& way : ways()) {
    scene::Scene scene = one.scene;
    if (way.method == render::Method::brute_force)
      scene.settings.samples /= 8;  // it takes 20 times as many light samples
    const double allowance = way.unbiased ? 0 : one.bias * truth.mean.y;
    expect_same(measure(scene, way.options()).whole(), truth, allowance, 0.03, one.name + ", " + way.name);
  }
}
INSTANTIATE_TEST_SUITE_P(Laws, Methods, testing::Range(0, 6));

}  // namespace
}  // namespace tyndall
