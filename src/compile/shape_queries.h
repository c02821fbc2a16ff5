// Rays against analytic shapes (meshes and curves: parts.h), in double and in the shape's own space.
// Directions need not have unit length: t is the caller's.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "base/interval.h"
#include "base/vec.h"
#include "scene/scene.h"

namespace tyndall::compile {

struct ShapeHit {
  double t = 0;
  Vec3d position, normal;  // outward, of any length but zero
  Pair<double> uv;
  Vec3d reach;             // what its error is measured in (hit_error.h), by axis
  Vec3d shading_normal{};  // where the shape smooths its normals; zero: the same
  std::uint32_t part = 0;  // the number of the triangle or piece of a strand
};

// Where a search for hits begins: behind t, and at t itself with parts after this one.
struct After {
  double t = 0;
  std::uint32_t part = std::numeric_limits<std::uint32_t>::max();

  bool before(double hit_t, std::uint32_t hit_part) const {
    return t < hit_t || (t == hit_t && part < hit_part);
  }
};

// The nearest crossing of the surface in (after, t_max). A ray that starts on the surface to rounding is kept
// off it by the caller's offset (hit_error.h).
std::optional<ShapeHit> intersect(const scene::Shape& shape, const Vec3d& origin, const Vec3d& direction,
                                  double t_max, const After& after = {});

// Whether the surface is crossed at any t in (0, t_max).
bool blocks(const scene::Shape& shape, const Vec3d& origin, const Vec3d& direction, double t_max);

// The stay inside a closed shape, clipped to [0, t_max); empty when there is none. Open shapes have none.
Intervald inside(const scene::Shape& shape, const Vec3d& origin, const Vec3d& direction, double t_max);

// Axis-aligned bounds in the shape's space. An infinite plane has none.
struct Bounds {
  Vec3d lo, hi;
};
std::optional<Bounds> bounds(const scene::Shape& shape);

}  // namespace tyndall::compile
