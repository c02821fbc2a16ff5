#include "shapes/box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::shapes {

namespace {

// Where the line passes between the two faces of a box across an axis that it does not run along.
Intervald between_faces(const Box& b, const Vec3d& origin, const Vec3d& direction, int axis) {
  const double t0 = (b.min[axis] - origin[axis]) / direction[axis],
               t1 = (b.max[axis] - origin[axis]) / direction[axis];
  return {std::min(t0, t1), std::max(t0, t1)};
}

}  // namespace

Problems Box::validate() const {
  Problems problems;
  for (std::size_t i = 0; i < 3; ++i) {
    if (min[i] < max[i]) continue;
    problems.push_back({"max", fmt::format("'max' must be above 'min' on every axis, found {} and {} on {}",
                                           min[i], max[i], "xyz"[i])});
    break;
  }
  return problems;
}

// By slabs, without branches that are hard to foretell.
Intervald Box::inside(const Vec3d& origin, const Vec3d& direction) const {
  Intervald inside{-infinity, infinity};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < min[axis] || origin[axis] >= max[axis]) return {};
      continue;
    }
    const Intervald slab = between_faces(*this, origin, direction, axis);
    inside.lo = std::max(inside.lo, slab.lo);
    inside.hi = std::min(inside.hi, slab.hi);
  }
  return inside;
}

// uv goes across each face, each in [0, 1].
std::optional<ShapeHit> Box::hit(const Vec3d& origin, const Vec3d& direction, double t_min,
                                 double t_max) const {
  const Intervald i = inside(origin, direction);
  const double t = first_crossing(i, t_min, t_max);
  if (t < 0) return std::nullopt;
  const bool entering = t == i.lo;
  // Through the first face that lies there.
  int axis = 0;
  for (; axis < 2; ++axis) {
    if (direction[axis] == 0) continue;
    const Intervald slab = between_faces(*this, origin, direction, axis);
    if ((entering ? slab.lo : slab.hi) == t) break;
  }
  const bool at_max = (direction[axis] > 0) != entering;
  Vec3d position = origin + direction * t, normal;
  position[axis] = at_max ? max[axis] : min[axis];
  normal[axis] = at_max ? 1 : -1;
  const int a = (axis + 1) % 3, c = (axis + 2) % 3;
  const Vec3d size = max - min;
  const Pair<double> uv{(position[a] - min[a]) / size[a], (position[c] - min[c]) / size[c]};
  return ShapeHit{t, position, normal, uv, larger(min, max)};
}

double Box::depth(const Vec3d& p) const { return std::min(min_component(p - min), min_component(max - p)); }
Bounds Box::bounds() const { return {min, max}; }
Ball Box::ball() const { return {(min + max) * 0.5, length(max - min) / 2}; }

std::vector<Triangle> Box::triangles() const {
  std::vector<Triangle> out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool at_max : {false, true}) {
      Vec3d corner[4];
      for (std::size_t k = 0; k < 4; ++k) {
        corner[k][axis] = at_max ? max[axis] : min[axis];
        corner[k][u] = k == 1 || k == 2 ? max[u] : min[u];
        corner[k][v] = k >= 2 ? max[v] : min[v];
      }
      if (!at_max) std::swap(corner[1], corner[3]);
      out.push_back({corner[0], corner[1], corner[2]});
      out.push_back({corner[0], corner[2], corner[3]});
    }
  }
  return out;
}

}  // namespace tyndall::shapes
