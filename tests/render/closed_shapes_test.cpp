// Every closed shape as what closed shapes may be: filled with a medium, of glass, moving. Over the family.
// Significance 0.0012 for each comparison, seeds 1 to 16 (support/measure.h).
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>

#include "support/measure.h"
#include "support/scene_builder.h"
#include "support/shape_cases.h"

namespace tyndall::render {
namespace UNNAMED {

using support::depth_in;
using support::expect_truth;
using support::for_closed_shapes;
using support::measure;
using support::SceneBuilder;

constexpr double sigma = 0.7;

// Of combinations one of each kind: they differ in their intervals alone, which tests/shapes has more of.
template <class Visit>
void for_kinds_of_closed_shapes(Visit&& visit) {
  std::set<std::string_view> combined;
  for_closed_shapes([&](const auto& s) {
    if (!std::is_base_of_v<shapes::CombinedShape, std::decay_t<decltype(s)>> ||
        combined.insert(s.keyword).second)
      visit(s);
  });
}

SceneBuilder looked_at_from_the_side() {
  SceneBuilder builder;
  builder.image(8, 8, 64).orthographic({3, 2, 4}, {0, 0, 0}, 4).environment(1);
  return builder;
}

// The mean of exp(-sigma l) over the picture, l the length inside: lines through a fine grid of the picture,
// each cut into short pieces.
double mean_transmittance(const auto& shape) {
  const Transform world_from_camera = *Transform::look_at({3, 2, 4}, {0, 0, 0}, {0, 1, 0});
  constexpr int grid = 96, pieces = 800;
  constexpr double length = 12;
  double sum = 0;
  for (int i = 0; i < grid; ++i)
    for (int j = 0; j < grid; ++j) {
      const Vec3d o =
          world_from_camera.point({4 * ((i + 0.5) / grid - 0.5), 4 * ((j + 0.5) / grid - 0.5), 0});
      int inside = 0;
      for (int k = 0; k < pieces; ++k)
        inside += depth_in(shape, o - world_from_camera.z * (length * (k + 0.5) / pieces)) > 0;
      sum += std::exp(-sigma * length * inside / pieces);
    }
  return sum / (grid * grid);
}

// A piece is 15 mm long and the grid meets edges anywhere in its cells: over the picture that is below the
// allowance.
TEST(ClosedShapes, AbsorbAsTheirLengthsInside) {
  support::MediumColors black;
  black.sigma_t = Rgb(static_cast<float>(sigma));
  black.albedo = {};
  for_kinds_of_closed_shapes([&](const auto& s) {
    SceneBuilder builder = looked_at_from_the_side();
    builder.volume(s, builder.constant(black));
    expect_truth(measure(builder.scene).whole(), mean_transmittance(s), 5e-4, 0.01, std::string(s.keyword));
  });
}

// White media and clear glass in a white room cannot be seen.
TEST(ClosedShapesSlow, AreInvisibleInAWhiteRoom) {
  support::MediumColors white;
  white.sigma_t = Rgb(3);
  scene::ConstantSurface glass;
  glass.parameters.transmission = 1;
  glass.parameters.base_color = Rgb(1);
  for_kinds_of_closed_shapes([&](const auto& s) {
    SceneBuilder filled = looked_at_from_the_side(), clear = looked_at_from_the_side(),
                 both = looked_at_from_the_side();
    filled.volume(s, filled.constant(white));
    expect_truth(measure(filled.scene).whole(), 1, 1e-5, 0.02, std::string(s.keyword) + " of a white medium");
    clear.surface(s, glass);
    expect_truth(measure(clear.scene).whole(), 1, 1e-4, 0.02, std::string(s.keyword) + " of glass");
    both.volume(s, both.constant(white)).bounded_by(glass);
    expect_truth(measure(both.scene).whole(), 1, 1e-4, 0.02, std::string(s.keyword) + " of milky glass");
  });
}

}  // namespace UNNAMED
}  // namespace tyndall::render
