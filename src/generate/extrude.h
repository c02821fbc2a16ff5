// Flat areas with holes, cut into triangles, and bodies that are made of them by giving them a thickness.
#pragma once

#include <vector>

#include "generate/made.h"

namespace tyndall::generate {

using Outline = std::vector<Pair<double>>;

enum class Filled : bool {
  odd,     // what the outlines go around an odd number of times: one within another is a hole
  nonzero  // what they go around, on balance, as those of letters do
};

// An area as triangles, counter-clockwise, and the loops around it, with the area to their left. By GLU's
// tessellator.
struct Area {
  std::vector<Pair<double>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::vector<std::uint32_t>> loops;
  std::size_t facets() const { return triangles.size() + points.size(); }  // that its body would have, about
};
// Empty where the outlines surround nothing.
Area fill(const std::vector<Outline>& outlines, Filled rule);

// Adds the body over the area between two heights. A point (x, y) of it at a height h is at
// origin + x·across + y·along + h·up, a right-handed frame. The uv of its faces goes from 0 to 1 over the box
// `from` to `to`; at its sides u goes around each loop, and v from one face to the other.
struct Extrusion {
  double low = 0, high = 1;
  Pair<double> from{}, to{};
  Vec3d origin{}, across{1, 0, 0}, along{0, 1, 0}, up{0, 0, 1};

  Vec3d position(const Pair<double>& p, double height) const { return origin + direction(p) + up * height; }
  Vec3d direction(const Pair<double>& d) const { return across * d.x + along * d.y; }
};
void extrude(MeshMaker& maker, const Area& area, const Extrusion& how);

// The box around outlines.
void bounds_of(const std::vector<Outline>& outlines, Pair<double>& from, Pair<double>& to);

}  // namespace tyndall::generate
