// Lights chosen by what a pilot saw of them: every choice has the probability that is told, no light is
// forgotten, no mean changes, and the pilot is the same whoever renders what. Means: significance 0.0012 for
// each, seeds 1 to 16 (support/measure.h).
#include "render/lights/learned_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/numerics.h"
#include "base/sampler.h"
#include "render/distance/density_sampling.h"
#include "render/lights/light_selection.h"
#include "render/lights/ray_pieces.h"
#include "render/march/ray_march.h"
#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

using support::scene_of;

// Streets between houses in fog, with what is named in them.
std::string streets(const std::string& things) {
  return support::filled(R"(
render { resolution: (8, 8)  samples: 6  bounces: 2  step: 0.5 }
camera perspective { from: (0, 5, 9)  to: (0, 0.5, 0)  fov: 45deg }
for i in -2..<2 {
  for j in -2..<2 { box { min: (2 * i + 0.3, 0, 2 * j + 0.3)  max: (2 * i + 1.7, 0.5 + random(i, j), 2 * j + 1.7) } }
}
plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: { base_color = 0.5 } }
medium fog() { density = 0.1 * exp(-p.y)  albedo = 0.9  phase = hg(0.4) }
volume { in: box { min: (-5, 0, -5)  max: (5, 3, 5) }  medium: fog }
$THINGS
)",
                         {{"THINGS", things}});
}
const std::string lamps =
    "for i in -2..2 { for j in -2..2 { light sphere { center: (2 * i, 0.7, 2 * j)  radius: 0.05  power: 2 + "
    "random(i, j) } } }\n";
// Lights of all kinds: some shine one way, one is far brighter, and some stand nowhere.
const std::string all_kinds = lamps + R"(
for i in 0..6 { light spot { position: (i - 3, 1.5, 0.1)  to: (i - 3.5, 0, 0.3)  angle: 25deg  intensity: 2 } }
light point { position: (0, 2.5, 0)  power: 300 }
light quad { center: (1, 2, 1)  u: (0.2, 0, 0)  v: (0, 0, 0.2)  power: 5 }
light distant { direction: (-0.3, -1, -0.2)  irradiance: 0.1  angle: 2deg }
light environment { radiance: 0.01 }
)";

// What is asked of a choice of lights, wherever it is made.
void expect_choice(const LightSelection& lights, std::uint32_t count) {
  ASSERT_FALSE(lights.empty());
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) sum += lights.probability(i);
  EXPECT_NEAR(sum, 1, 1e-9);
  // Equidistant numbers go to each light in proportion to the probability told.
  constexpr int draws = 4096;
  std::vector<int> counts(count);
  double rest = 0;
  for (int k = 0; k < draws; ++k) {
    float u = (static_cast<float>(k) + 0.5f) / draws;
    ++counts[lights.sample(u)];
    rest += u / draws;
  }
  EXPECT_NEAR(rest, 0.5, 0.02);  // and what is left of a number is uniform again
  for (std::uint32_t i = 0; i < count; ++i) EXPECT_NEAR(counts[i], draws * lights.probability(i), 2) << i;
}

class LearnedStreets : public testing::Test {
 protected:
  const compile::CompiledScene world = compile::compile(scene_of(streets(all_kinds)));
  const std::unique_ptr<const LearnedLights> learned = LearnedLights::of(world, Transmittance::march, 2);
  const std::uint32_t count = static_cast<std::uint32_t>(world.lights.size());

  Vec3d place(std::uint32_t i, double size) const {
    const SobolPoint u = sobol_point(i, 5);
    return Vec3d{(2 * u[0] - 1) * size, u[1] * size, (2 * u[2] - 1) * size} - world.origin;
  }
};

TEST_F(LearnedStreets, AreChosenAsIsTold) {
  ASSERT_NE(learned, nullptr);
  for (std::uint32_t i = 0; i < 24; ++i) {
    const Vec3d x = place(i, i % 4 == 0 ? 40 : 3);  // also where the pilot never was
    const Vec3d n{0, i % 2 == 0 ? 1.0 : 0.0, i % 2 == 0 ? 0.0 : -1.0};
    expect_choice({world, {x, n, 0, 0}, 0, 0, learned->in_medium(x)}, count);
    expect_choice({world, {x, n, 0, 0}, 0, 0, learned->on_surface(x, n)}, count);
    expect_choice({world, {x, n, 0, 0}, 0.1, i % 3 == 0 ? infinity : 1.5, learned->in_medium(x)}, count);
  }
}

// No light that the plain tree finds is lost, however well it is hidden.
TEST_F(LearnedStreets, ForgetNoLight) {
  int rare = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Vec3d x = place(i, 4), n{0, 1, 0};
    const LightSelection plain(world, {x, n, 0, 0}, 0, 0),
        with(world, {x, n, 0, 0}, 0, 0, learned->on_surface(x, n));
    const LightSelection endless(world, {x, n, 0, 0}, 0, infinity, learned->in_medium(x));
    for (std::uint32_t l = 0; l < count; ++l) {
      const compile::CompiledLight& light = world.lights[l];
      const auto drawn =
          light.sample(x, light.sample_pivot(0.5f, 0.5f).value_or(optics::Pivot{}), 0.5f, 0.5f);
      if (drawn && !is_black(drawn->radiance_over_pdf)) {
        EXPECT_GT(with.probability(l), 1e-3 * plain.probability(l)) << l;
        EXPECT_GT(endless.probability(l), 0) << l;
      }
      rare += with.probability(l) < 0.2 * plain.probability(l);
    }
  }
  EXPECT_GT(rare, 200);  // but much is learned
}

// The pieces of a ray follow each other, each in one region, and numbers go to them as is told.
TEST_F(LearnedStreets, DivideRays) {
  RayMarcher marcher;
  ThreadContext thread;
  int several = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Vec3d x = place(i, 4), d = normalize(place(i + 64, 3) - x);
    March march;
    marcher.march(world, {{x, d, 20, 0}, compile::RayKind::scattered, 1, &march, false}, thread);
    const DensityDistribution density(march, Rgb(1));
    RayPieces pieces;
    pieces.divide(world, *learned, march, density);
    if (pieces.empty()) continue;
    several += pieces.all().size() > 2;
    double before = 0, end = 0;
    for (const RayPiece& piece : pieces.all()) {
      EXPECT_GE(piece.t.lo, end);
      EXPECT_FALSE(piece.t.empty());
      EXPECT_EQ(learned->in_medium(x + d * ((piece.t.lo + std::min(piece.t.hi, 1e3)) / 2)), piece.region);
      EXPECT_NEAR(piece.before, before, 1e-12);
      EXPECT_EQ(pieces.at(piece.t.lo), &piece);
      float u = static_cast<float>(piece.before + 0.25 * piece.probability);
      if (piece.probability > 1e-3) {
        EXPECT_EQ(&pieces.choose(u), &piece);
        EXPECT_NEAR(u, 0.25, 1e-3);
      }
      before += piece.probability;
      end = piece.t.hi;
    }
    EXPECT_NEAR(before, 1, 1e-9);
  }
  EXPECT_GT(several, 20);
}

Vec3d mean_of_film(const Film& film) {
  Vec3d sum;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) sum += Vec3d(film.mean(x, y));
  return sum / static_cast<double>(film.width() * film.height());
}

TEST(LearnedLights, ChangeNoMean) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"lights of all kinds", all_kinds},
      {"lamps in boxes with a thin gap",
       lamps +
           "box { min: (-1.9, 1.2, -1.9)  max: (-0.02, 1.3, 1.9) }\nbox { min: (0.02, 1.2, -1.9)  max: (1.9, "
           "1.3, 1.9) }\n"},
      {"one lamp far brighter, in a well",
       lamps +
           "light sphere { center: (0, 0.1, 0)  radius: 0.05  power: 500 }\ncylinder { from: (0, 0, 0)  to: "
           "(0, 0.6, 0)  radius: 0.25 }\n"},
      {"a blocker that moves while the shutter is open",
       lamps +
           "box { min: (-3 + 6 * time, 0.9, -3)  max: (-1 + 6 * time, 1, 3) }\nanimation { fps: 1  frames: "
           "0..1  shutter: 360deg }\n"},
      {"pictures on holes and gloss",
       lamps +
           "quad { center: (0, 1.2, 0)  u: (2, 0, 0)  v: (0, 0, 2)  material: { base_color = 0.5  opacity = "
           "0.5 } }\nsphere { center: (1, 1.6, 1)  radius: 0.4  material: { base_color = 0.8  metallic = 1  "
           "roughness = 0.3 } }\n"}};
  for (const auto& [name, things] : cases) {
    const scene::Scene scene = scene_of(streets(things));
    RenderOptions plain;
    plain.learned_lights = false;
    ASSERT_NE(LearnedLights::of(compile::compile(scene), Transmittance::march, 1), nullptr) << name;
    const support::Measurement a = support::measure(scene), b = support::measure(scene, plain);
    Vec3d sum, squares, mean;
    const double n = support::seed_count;
    for (std::size_t i = 0; i < a.films.size(); ++i) {
      const Vec3d difference = mean_of_film(a.films[i]) - mean_of_film(b.films[i]);
      sum += difference;
      squares += difference * difference;
      mean += mean_of_film(b.films[i]) / n;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      const double error = std::sqrt((squares[c] - sqr(sum[c]) / n) / (n * (n - 1)));
      EXPECT_LE(std::abs(sum[c] / n), support::sigmas * error) << name << ", channel " << c;
      EXPECT_LE(error, 0.06 * mean[c]) << name << ": too noisy to tell";
    }
  }
}

// One picture, in parts or whole, by one thread or several.
TEST(LearnedLights, AreTheSameForAnyPart) {
  scene::Scene scene = scene_of(streets(all_kinds));
  scene.settings.samples = 2;
  const compile::CompiledScene world = compile::compile(scene);
  RenderOptions one, several, part;
  one.threads = 1;
  several.threads = 3;
  part.crop = PixelWindow{2, 3, 7, 6};
  const Film whole = render(world, one).film, by_several = render(world, several).film,
             cropped = render(world, part).film;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      EXPECT_EQ(whole.mean(x, y), by_several.mean(x, y));
      if (2 <= x && x < 7 && 3 <= y && y < 6) {
        EXPECT_EQ(whole.mean(x, y), cropped.mean(x, y));
      }
    }
}

// Only where there are many lights, and something that may hide them.
TEST(LearnedLights, AreLearnedWhereThatPays) {
  const auto learns = [](const std::string& text) {
    return LearnedLights::of(compile::compile(scene_of(text)), Transmittance::march, 1) != nullptr;
  };
  const std::string camera = "camera perspective { from: (0, 1, 5)  to: (0, 1, 0) }\n",
                    ball = "sphere { center: (0, 1, 0)  radius: 0.5 }\n";
  EXPECT_TRUE(learns(camera + ball + lamps));
  EXPECT_FALSE(learns(camera + lamps));
  EXPECT_FALSE(learns(camera + ball + "light point { position: (0, 3, 0)  power: 9 }\n"));
}

}  // namespace UNNAMED
}  // namespace tyndall::render
