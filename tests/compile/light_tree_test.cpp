// Laws of the light tree: probabilities add up to one and are those of the draws, and a light that reaches a
// stretch can be drawn.
#include "compile/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "base/numerics.h"
#include "optics/light_sampling.h"

namespace tyndall::compile {
namespace {

using optics::Light;
using optics::Stretch;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  Vec3d inside(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Vec3d direction() {
    for (;;) {
      const Vec3d v = inside(1);
      if (length_squared(v) > 1e-4 && length_squared(v) < 1) return normalize(v);
    }
  }

 private:
  std::mt19937_64 engine_;
};

// Of all kinds that have a place, in a cluster of clusters; powers over four decades; two at one place.
std::vector<Light> lights(Random& random, int count) {
  std::vector<Light> all = {optics::DistantLight{{0, -1, 0}, Rgb(1), {}},
                            optics::PointLight{{1, 1, 1}, Rgb(1), {}},
                            optics::PointLight{{1, 1, 1}, Rgb(2), {}}};
  Vec3d cluster;
  for (int i = 0; i < count; ++i) {
    if (i % 10 == 0) cluster = random.inside(20);
    const Vec3d at = cluster + random.inside(1);
    const Rgb power(static_cast<float>(std::pow(10, random.uniform(-2, 2))));
    switch (i % 5) {
      case 0:
        all.push_back(optics::PointLight{at, power, {}});
        break;
      case 1:
        all.push_back(
            optics::SpotLight{at, at + random.direction(), {random.uniform(0.05, 2)}, 0.2, power, {}});
        break;
      case 2:
        all.push_back(optics::SphereLight{at, random.uniform(0.01, 0.5), power, {}, true});
        break;
      case 3:
        all.push_back(optics::QuadLight{at, random.inside(0.3), random.inside(0.3), power, {}, true});
        break;
      default:
        all.push_back(optics::DiskLight{at, random.direction(), random.uniform(0.01, 0.5), power, {}, true});
    }
  }
  return all;
}

Stretch stretch_of(Random& random, int i) {
  const double t0 = random.uniform(0, 5);
  const double lengths[] = {0, 1, 30, infinity};
  return {random.inside(25), random.direction(), t0, t0 + lengths[i % 4]};
}

TEST(LightTree, ProbabilitiesAddUpToOne) {
  Random random(1);
  for (const int count : {0, 1, 2, 17, 300}) {
    const std::vector<Light> all = lights(random, count);
    const LightTree tree(all);
    ASSERT_EQ(tree.others().size(), 1u);  // the distant one
    for (int i = 0; i < 40; ++i) {
      const Stretch stretch = stretch_of(random, i);
      double sum = 0;
      for (std::uint32_t l = 0; l < all.size(); ++l) sum += tree.probability(stretch, l);
      EXPECT_NEAR(sum, 1, 1e-12);
      EXPECT_GE(tree.importance(stretch), 0);
    }
  }
}

// Equidistant numbers go to each light in proportion to the probability told, and what is left of a number is
// uniform again: its mean is 1/2.
TEST(LightTree, DrawsAsItTells) {
  Random random(2);
  const std::vector<Light> all = lights(random, 60);
  const LightTree tree(all);
  constexpr int draws = 20000;
  for (int i = 0; i < 8; ++i) {
    const Stretch stretch = stretch_of(random, i);
    std::vector<int> counts(all.size());
    double rest = 0;
    for (int k = 0; k < draws; ++k) {
      double u = (k + 0.5) / draws;
      const LightTree::Chosen chosen = tree.sample(stretch, u);
      ++counts[chosen.light];
      rest += u / draws;
      EXPECT_NEAR(chosen.probability, tree.probability(stretch, chosen.light), 1e-12);
    }
    EXPECT_NEAR(rest, 0.5, 0.01);
    for (std::uint32_t l = 0; l < all.size(); ++l)
      EXPECT_NEAR(counts[l], draws * tree.probability(stretch, l), 2) << l;
  }
}

// No light that may shine on a part of the stretch is beyond reach of the draws.
TEST(LightTree, ForgetsNoLight) {
  Random random(3);
  const std::vector<Light> all = lights(random, 200);
  const LightTree tree(all);
  int reached_by_some = 0, dark = 0;
  for (int i = 0; i < 400; ++i) {
    const Stretch stretch = stretch_of(random, i);
    if (stretch.t0 == stretch.t1) continue;
    for (std::uint32_t l = 0; l < all.size(); ++l) {
      const auto pivot = optics::sample_pivot(all[l], 0.5f, 0.5f);
      if (!pivot) continue;
      const optics::ReachedParts parts =
          optics::reached_parts(all[l], *pivot, stretch.origin, stretch.direction, std::min(stretch.t1, 1e4));
      bool reached = false;
      for (int k = 0; k < parts.count; ++k)
        reached |= parts.parts[k].hi > stretch.t0 + 1e-6 && parts.parts[k].length() > 1e-6;
      reached_by_some += reached;
      const bool never = !(tree.probability(stretch, l) > 0);
      dark += never;
      EXPECT_FALSE(reached && never) << "light " << l << ", stretch " << i;
    }
  }
  EXPECT_GT(reached_by_some, 10000);
  EXPECT_GT(dark, 100);  // what shines elsewhere is left out
}

}  // namespace
}  // namespace tyndall::compile
