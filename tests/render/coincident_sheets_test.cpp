// Sheets in one place that light goes through in part: each takes its share, of camera rays, of shadow rays
// and by every method.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/filled.h"
#include "support/measure.h"
#include "support/scene_text.h"
#include "support/ways.h"

namespace tyndall {
namespace UNNAMED {

using support::filled;
using support::repeated;
using support::scene_of;

const double let_through = std::pow(1 - 0.01, 100);  // 0.366

// What a hundred sheets are as, all in one plane.
const std::pair<std::string, std::string> kinds[] = {
    {"quads",
     "for i in 0..<100 { quad { center: (0, 0, 0)  u: (2, 0, 0)  v: (0, 0, -2)  material: gauze } }"},
    {"disks",
     "for i in 0..<100 { disk { center: (0, 0, 0)  normal: (0, 1, 0)  radius: 2  material: gauze } }"},
    {"planes", "for i in 0..<100 { plane { point: (0, 0, 0)  normal: (0, 1, 0)  material: gauze } }"},
    {"objects", R"(
object sheet { quad { center: (0, 0, 0)  u: (2, 0, 0)  v: (0, 0, -2)  material: gauze } }
for i in 0..<100 { place sheet {} }
)"},
    {"a mesh", filled(R"(
mesh {
  points: [(-2, 0, -2), (2, 0, -2), (0, 0, 3)]
  triangles: [$TRIANGLES]
  material: gauze
}
)",
                      {{"TRIANGLES", repeated("(0, 1, 2), ", 100)}})},
};

std::string looked_through(const std::string& sheets) {
  return filled(R"(
render { resolution: (4, 4)  samples: 4 }
camera orthographic { from: (0.3, 5, 0)  to: (0, 0, 0.1)  height: 0.5 }
light environment { radiance: 1 }
material gauze() { base_color = 0  opacity = 0.01 }
$SHEETS
)",
                {{"SHEETS", sheets}});
}

TEST(CoincidentSheets, EachTakesItsShareOfWhatIsBehind) {
  for (const auto& [name, things] : kinds) {
    const auto result = render::render(compile::compile(scene_of(looked_through(things))), {});
    EXPECT_NEAR(result.film.mean(1, 1).x, let_through, 1e-5) << name;
  }
}

TEST(CoincidentSheets, ByEveryMethod) {
  for (const auto& [name, method] : support::all_methods()) {
    render::RenderOptions options;
    options.method = method;
    support::expect_truth(support::measure(scene_of(looked_through(kinds[0].second)), options).whole(),
                          let_through, 1e-5, 0.06, name);
  }
}

// A floor beneath them, lit from above by lights with and without size.
TEST(CoincidentSheets, EachTakesItsShareOfLight) {
  for (const std::string light : {"light point { position: (0, 3, 0)  intensity: 10 }",
                                  "light distant { direction: (0, -1, 0)  irradiance: 2 }",
                                  "light sphere { center: (0, 3, 0)  radius: 0.5  power: 10 }"})
    for (const auto& [name, things] : kinds) {
      const auto floor = [&](const std::string& above) {
        const std::string text = filled(R"(
render { resolution: (2, 2)  samples: 16  bounces: 0 }
camera orthographic { from: (0, -0.5, 0)  to: (0, -1, 0)  height: 0.01  up: (0, 0, 1) }
plane { point: (0, -1, 0)  normal: (0, 1, 0) }
material gauze() { base_color = 0  opacity = 0.01 }
$LIGHT
$ABOVE
)",
                                        {{"LIGHT", light}, {"ABOVE", above}});
        return render::render(compile::compile(scene_of(text)), {}).film.mean(0, 0).x;
      };
      const float lit = floor("");
      EXPECT_GT(lit, 0);
      EXPECT_NEAR(floor(things) / lit, let_through, 1e-4) << name << " under " << light;
    }
}

// One sheet in another's plane stops what the other lets through, whichever comes first.
TEST(CoincidentSheets, OpaqueOnesStopLight) {
  const std::string
      gauze = "quad { center: (0, 0, 0)  u: (2, 0, 0)  v: (0, 0, -2)  material: gauze }",
      black = "quad { center: (0, 0, 0)  u: (2, 0, 0)  v: (0, 0, -2)  material: { base_color = 0 } }";
  for (const std::string& things : {gauze + black, black + gauze, gauze + black + gauze}) {
    const auto result = render::render(compile::compile(scene_of(looked_through(things))), {});
    EXPECT_EQ(result.film.mean(1, 1).x, 0);
  }
}

}  // namespace UNNAMED
}  // namespace tyndall
