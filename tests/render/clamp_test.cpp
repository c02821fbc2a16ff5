// Limits of the light of one path: nothing changes within them, and what is beyond is told to the last bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "render/path/light_clamp.h"
#include "render/render.h"
#include "support/scene_text.h"

namespace tyndall::render {
namespace UNNAMED {

// Lamps near a ray in mist, a wall, and light that is scattered often. The camera ray meets no light.
const std::string mist = R"(
render { resolution: (16, 9)  samples: 8  step: 0.3 }
camera perspective { from: (0, 0, 6)  to: (0, 0, 0)  fov: 50deg }
medium mist() { density = 0.3 + 0.2 * p.x  albedo = (0.9, 0.8, 0.95)  phase = hg(0.6) }
volume { in: box { min: (-4, -3, -4)  max: (4, 3, 4) }  medium: mist }
light sphere { center: (3, 4, 0)  radius: 0.1  power: (900, 600, 300) }
light point { position: (0.5, 0.2, 0)  power: 40 }
)";
const std::string misty_room =
    mist + "quad { center: (0, 0, -3.9)  u: (4, 0, 0)  v: (0, 3, 0)  material: { base_color = 0.7 } }\n";

RenderResult rendered(const scene::Clamp& clamp, RenderOptions options = {}, int light_samples = 1) {
  scene::Scene scene = support::scene_of(misty_room);
  scene.settings.clamp = clamp;
  scene.settings.light_samples = light_samples;
  return render(compile::compile(std::move(scene)), options);
}

AovSet layers() {
  AovSet aovs;
  for (const Aov aov : {Aov::volume_direct, Aov::volume_indirect, Aov::volume_emission, Aov::variance})
    aovs.add(aov);
  return aovs;
}

std::string bytes_of(const Film& film) {
  std::string all;
  for (const auto bytes : {film.bytes().first, film.bytes().second})
    all.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return all;
}

// The sums of each channel over all pixels, exactly.
std::array<FixedSum, 3> light_of(const Film& film) {
  constexpr std::size_t pixel_bytes = 64, half = 8;
  std::array<FixedSum, 3> sums;
  const auto bytes = film.bytes().first;
  for (std::size_t at = 0; at < bytes.size(); at += pixel_bytes)
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint64_t lower = 0, upper = 0;
      std::memcpy(&lower, bytes.data() + at + 2 * half * c, half);
      std::memcpy(&upper, bytes.data() + at + 2 * half * c + half, half);
      sums[c].add(FixedSum::of_halves(upper, lower));
    }
  return sums;
}

TEST(Clamp, ChangesNoBitWhereNothingIsBeyondIt) {
  RenderOptions options;
  options.aovs = layers();
  for (const int light_samples : {1, 3}) {
    const RenderResult off = rendered({}, options, light_samples),
                       on = rendered({1e30, 1e30}, options, light_samples);
    EXPECT_TRUE(bytes_of(off.film) == bytes_of(on.film));
    EXPECT_EQ(on.statistics.clamped_light.share(), 0);
    EXPECT_GT(on.statistics.clamped_light.kept[0].value(), 0);
    EXPECT_EQ(off.statistics.clamped_light.kept[0].value(), 0) << "nothing is summed where there is no clamp";
  }
}

TEST(Clamp, WhatIsGoneAndWhatIsLeftAreTheWhole) {
  for (const scene::Clamp clamp :
       {scene::Clamp{0.5, 0.5}, scene::Clamp{infinity, 0.05}, scene::Clamp{0.3, infinity}})
    for (const int light_samples : {1, 3}) {
      const RenderResult off = rendered({}, {}, light_samples), on = rendered(clamp, {}, light_samples);
      const ClampedLight& sums = on.statistics.clamped_light;
      EXPECT_GT(sums.share(), 0.001) << scene::describe(clamp);
      std::array<FixedSum, 3> whole = light_of(on.film);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(sums.kept[c].halves(), whole[c].halves());
        whole[c].add(sums.removed[c]);
        EXPECT_EQ(whole[c].halves(), light_of(off.film)[c].halves()) << scene::describe(clamp);
      }
    }
}

TEST(Clamp, NoPixelIsBeyondBothLimits) {
  for (const scene::Clamp clamp : {scene::Clamp{0.2, 0.1}, scene::Clamp{0.02, 0.3}}) {
    const RenderResult result = rendered(clamp);
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 16; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_LE(result.film.mean(x, y)[c], (clamp.direct + clamp.indirect) * (1 + 1e-6));
  }
}

// The layers are limited as the picture is: on a ray that ends in media they are all there is.
TEST(Clamp, LayersAddUpToThePicture) {
  scene::Scene scene = support::scene_of(mist);
  scene.settings.clamp = {0.3, 0.1};
  RenderOptions options;
  options.aovs = layers();
  const RenderResult result = render(compile::compile(std::move(scene)), options);
  const image::Image picture = result.film.image();
  const auto at = [&](const std::string& channel, int x, int y) {
    const auto found = std::find(picture.channels.begin(), picture.channels.end(), channel);
    return picture.at(x, y, static_cast<std::size_t>(found - picture.channels.begin()));
  };
  EXPECT_GT(result.statistics.clamped_light.share(), 0.01);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 16; ++x)
      EXPECT_NEAR(at("R", x, y), at("volume_direct.R", x, y) + at("volume_indirect.R", x, y), 1e-5);
}

TEST(Clamp, IsTheSameForAnyNumberOfThreads) {
  RenderOptions one, three;
  one.threads = 1;
  three.threads = 3;
  const scene::Clamp clamp{0.3, 0.1};
  const RenderResult a = rendered(clamp, one), b = rendered(clamp, three);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_EQ(a.statistics.clamped_light.removed[c].halves(), b.statistics.clamped_light.removed[c].halves());
  EXPECT_TRUE(bytes_of(a.film) == bytes_of(b.film));
}

// A hue is kept; light below zero is limited like light above; samples that are no numbers are left alone.
TEST(Clamp, LimitsTheGreatestChannel) {
  const float nan = std::nanf("");
  std::array<Rgb, 4> radiance{Rgb(9, 4, 2), Rgb(-6, 2, 0), Rgb(1, 1, 1), Rgb(nan, 0, 0)};
  const std::array<ScatteredLight, 4> scattered{
      ScatteredLight{Rgb(8, 4, 2), Rgb(0), Rgb(1, 0, 0)}, ScatteredLight{Rgb(0), Rgb(-6, 2, 0), Rgb(0)},
      ScatteredLight{Rgb(1), Rgb(0), Rgb(0)}, ScatteredLight{Rgb(nan), Rgb(0), Rgb(0)}};
  ClampedLight sums;
  clamp_light({2, 3}, scattered, radiance, {}, sums);
  EXPECT_EQ(radiance[0], Rgb(3, 1, 0.5f));
  EXPECT_EQ(radiance[1], Rgb(-3, 1, 0));
  EXPECT_EQ(radiance[2], Rgb(1));
  EXPECT_TRUE(std::isnan(radiance[3].x));
  EXPECT_EQ(sums.removed[0].value(), 6 - 3);
  EXPECT_EQ(sums.kept[0].value(), 3 - 3 + 1);
}

// A run that goes on has what the runs before it counted.
TEST(Clamp, IsCarriedFromRunToRun) {
  ClampedLight sums, back;
  sums.add(Rgb(1e6f, 1e-6f, 0.1f), Rgb(3e5f, -2.5f, 0.1f));
  std::vector<std::pair<std::uint64_t, std::uint64_t>> halves;
  sums.each([&](const FixedSum& sum) { halves.push_back(sum.halves()); });
  std::size_t i = 0;
  back.each([&](FixedSum& sum) {
    sum = FixedSum::of_halves(halves[i].first, halves[i].second);
    ++i;
  });
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(back.removed[c].value(), sums.removed[c].value());
    EXPECT_EQ(back.kept[c].value(), sums.kept[c].value());
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::render
