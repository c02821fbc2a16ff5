// Lines through points: smooth ones, where they have corners, and whether they cross.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/vec.h"

namespace tyndall::generate {

// Corners that turn by more are edges; flatter ones are shaded as if they were round.
inline constexpr double crease_degrees = 30;
inline constexpr std::size_t pieces_of_curve = 8;  // between two points of a smooth line

// A point of a line that may carry a fourth number along.
using Knot = std::array<double, 4>;

// Straight pieces along the smooth curve through the points, no two of which in a row coincide: Catmull and
// Rom's spline with the knots of Yuksel et al. ("Parameterization and applications of Catmull-Rom curves",
// 2011), centripetal, so that it makes no loops between points. `closed`: the last point, which is the first
// again, is passed through smoothly.
std::vector<Knot> smooth_line(const std::vector<Knot>& points, bool closed);

// A piece of a line in the plane with the normals at its ends, to the right of its direction.
struct Piece {
  Pair<double> from, to, normal_from, normal_to;
  bool begins_anew = true;  // the normal at its beginning is not that of the end of the piece before
  double along_from = 0, along_to = 0;  // 0 to 1 over the line, by length
};
// Those of a line, without points given twice. `closed`: the last meets the first.
std::vector<Piece> pieces_of(const std::vector<Pair<double>>& line, bool closed);

// Where sides of closed outlines cross each other, but for common ends; at most so many. The last point of
// each is joined to the first.
struct Crossing {
  std::size_t outline, other_outline;
  Pair<double> at;
};
std::vector<Crossing> crossings(const std::vector<std::vector<Pair<double>>>& outlines, std::size_t most);

}  // namespace tyndall::generate
