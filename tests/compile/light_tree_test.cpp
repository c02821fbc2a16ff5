// Laws of the light tree: probabilities add up to one and are those of the draws, and a light that reaches a
// segment can be drawn.
#include "compile/lights/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "base/numerics.h"

namespace tyndall::compile {
namespace UNNAMED {

using optics::RaySegment;

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
std::vector<CompiledLight> lights(Random& random, int count) {
  std::vector<scene::Light> all = {scene::DistantLight{{0, -1, 0}, Rgb(1), {}},
                                   scene::PointLight{{1, 1, 1}, Rgb(1), {}},
                                   scene::PointLight{{1, 1, 1}, Rgb(2), {}}};
  Vec3d cluster;
  for (int i = 0; i < count; ++i) {
    if (i % 10 == 0) cluster = random.inside(20);
    const Vec3d at = cluster + random.inside(1);
    const Rgb power(static_cast<float>(std::pow(10, random.uniform(-2, 2))));
    switch (i % 6) {
      case 0:
        all.push_back(scene::PointLight{at, power, {}});
        break;
      case 1:
        all.push_back(
            scene::SpotLight{at, at + random.direction(), {random.uniform(0.05, 2)}, 0.2, power, {}});
        break;
      case 2:
        all.push_back(scene::AreaLight{scene::Sphere{at, random.uniform(0.01, 0.5)}, power, {}});
        break;
      case 3:
        all.push_back(scene::AreaLight{scene::Quad{at, random.inside(0.3), random.inside(0.3)}, power, {}});
        break;
      case 4:
        all.push_back(scene::AreaLight{scene::Cylinder{at, at + random.inside(0.3), 0.05}, power, {}});
        break;
      default:
        all.push_back(
            scene::AreaLight{scene::Disk{at, random.direction(), random.uniform(0.01, 0.5)}, power, {}});
    }
  }
  static const scene::Scene empty;
  std::vector<CompiledLight> out;
  for (const scene::Light& light : all) out.emplace_back(light, LightSetting{empty, {}});
  return out;
}

RaySegment interval_of(Random& random, int i) {
  const double t0 = random.uniform(0, 5);
  const double lengths[] = {0, 1, 30, infinity};
  return {random.inside(25), random.direction(), t0, t0 + lengths[i % 4]};
}

TEST(LightTree, ProbabilitiesAddUpToOne) {
  Random random(1);
  for (const int count : {0, 1, 2, 17, 300}) {
    const std::vector<CompiledLight> all = lights(random, count);
    const LightTree tree(all);
    ASSERT_EQ(tree.others().size(), 1u);  // the distant one
    for (int i = 0; i < 40; ++i) {
      const RaySegment interval = interval_of(random, i);
      double sum = 0;
      for (std::uint32_t l = 0; l < all.size(); ++l) sum += tree.probability(interval, l);
      EXPECT_NEAR(sum, 1, 1e-12);
      EXPECT_GE(tree.importance(interval), 0);
    }
  }
}

// Equidistant numbers go to each light in proportion to the probability told, and what is left of a number is
// uniform again: its mean is 1/2.
TEST(LightTree, DrawsAsItTells) {
  Random random(2);
  const std::vector<CompiledLight> all = lights(random, 60);
  const LightTree tree(all);
  constexpr int draws = 20000;
  for (int i = 0; i < 8; ++i) {
    const RaySegment interval = interval_of(random, i);
    std::vector<int> counts(all.size());
    double rest = 0;
    for (int k = 0; k < draws; ++k) {
      double u = (k + 0.5) / draws;
      const LightTree::Chosen chosen = tree.sample(interval, u);
      ++counts[chosen.light];
      rest += u / draws;
      EXPECT_NEAR(chosen.probability, tree.probability(interval, chosen.light), 1e-12);
    }
    EXPECT_NEAR(rest, 0.5, 0.01);
    for (std::uint32_t l = 0; l < all.size(); ++l)
      EXPECT_NEAR(counts[l], draws * tree.probability(interval, l), 2) << l;
  }
}

// No light that may shine on a part of the segment is beyond reach of the draws.
TEST(LightTree, ForgetsNoLight) {
  Random random(3);
  const std::vector<CompiledLight> all = lights(random, 200);
  const LightTree tree(all);
  int reached_by_some = 0, dark = 0;
  for (int i = 0; i < 400; ++i) {
    const RaySegment interval = interval_of(random, i);
    if (interval.t0 == interval.t1) continue;
    for (std::uint32_t l = 0; l < all.size(); ++l) {
      const auto pivot = all[l].sample_pivot(0.5f, 0.5f);
      if (!pivot) continue;
      const optics::ReachedParts parts =
          all[l].reached_parts(*pivot, interval.origin, interval.direction, std::min(interval.t1, 1e4));
      bool reached = false;
      for (int k = 0; k < parts.count; ++k)
        reached |= parts.parts[k].hi > interval.t0 + 1e-6 && parts.parts[k].length() > 1e-6;
      reached_by_some += reached;
      const bool never = !(tree.probability(interval, l) > 0);
      dark += never;
      EXPECT_FALSE(reached && never) << "light " << l << ", stretch " << i;
    }
  }
  EXPECT_GT(reached_by_some, 10000);
  EXPECT_GT(dark, 100);  // what shines elsewhere is left out
}

}  // namespace
}  // namespace tyndall::compile
