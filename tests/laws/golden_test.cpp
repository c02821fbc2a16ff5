// What `tyndall golden --statistical` promises: an error of 1 % in the extinction of one medium is caught in
// at least 19 of 20 seeds, and where nothing has changed at least 99 of 100 other seeds pass.
#include <gtest/gtest.h>

#include "image/z_test.h"
#include "render/render.h"
#include "support/filled.h"
#include "support/scene_text.h"

namespace tyndall {
namespace UNNAMED {

struct GoldenScene {
  const char* name;
  int samples;
  const char* media;  // with $ERROR as a factor of the extinction of one
};
const GoldenScene golden_scenes[] = {
    {"two homogeneous media", 64, R"(
volume { in: box { min: (-1.2, -1.2, -1.2)  max: (1.2, 1.2, 1.2) }
         medium: { density = 0.8 * $ERROR  albedo = (0.9, 0.6, 0.3)  phase = hg(0.4) } }
volume { in: sphere { center: (0, -1, 1.5)  radius: 0.6 }  medium: { density = 2  albedo = 0.8 } })"},
    {"dark smoke over a floor", 256, R"(
volume { in: box { min: (-1.2, -1, -1.2)  max: (1.2, 1.4, 1.2) }
         medium: { density = $ERROR * 3 * smoothstep(1.1, 0.3, length(p) + 0.4 * fbm(p * 2, octaves: 3))
                   albedo = 0.3  phase = hg(0.2) } }
plane { point: (0, -1, 0)  normal: (0, 1, 0)  material: { base_color = 0.5 } })"},
};

class GoldenLaws {
 public:
  explicit GoldenLaws(const GoldenScene& row) : samples_(row.samples), media_(row.media) {}

  image::Image picture(std::uint64_t seed, const char* error) const {
    scene::Scene scene = support::scene_of(R"(render { resolution: (32, 24)  bounces: 64 }
camera perspective { from: (0, 0.3, 5)  to: (0, 0, 0)  fov: 40deg }
light sphere { center: (3, 3, 1)  radius: 0.5  radiance: 20 }
light environment { radiance: 0.5 }
)" + support::filled(media_, {{"ERROR", error}}));
    scene.settings.samples = samples_;
    scene.settings.seed = seed;
    const compile::CompiledScene world = compile::compile(std::move(scene));
    render::RenderOptions options;
    options.aovs.add(render::Aov::variance);
    return render::render(world, options).film.image();
  }

 private:
  int samples_;
  std::string media_;
};

TEST(GoldenLaws, AnErrorOfOnePercentIsCaught) {
  for (const GoldenScene& row : golden_scenes) {
    const GoldenLaws law(row);
    const image::Image reference = law.picture(0, "1");
    int caught = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      caught += !image::z_test(law.picture(seed, "1.01"), reference)->agrees();
    EXPECT_GE(caught, 19) << row.name;
    fmt::print("{}: {}\n", row.name, caught);
  }
}

TEST(GoldenLaws, OtherSeedsOfTheSamePass) {
  for (const GoldenScene& row : golden_scenes) {
    const GoldenLaws law(row);
    const image::Image reference = law.picture(0, "1");
    int passed = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
      passed += image::z_test(law.picture(seed, "1"), reference)->agrees();
    EXPECT_GE(passed, 99) << row.name;
    fmt::print("{}: {}\n", row.name, passed);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
