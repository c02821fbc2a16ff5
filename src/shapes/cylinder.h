#pragma once

#include <optional>
#include <string_view>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

// Closed by flat ends.
struct Cylinder {
  static constexpr std::string_view keyword = "cylinder";
  static constexpr std::string_view documentation =
      "Its ends are flat. `uv` goes around it and from `from` to `to`; on the ends, across them as on a "
      "disk.";
  static constexpr bool closed = true;
  Vec3d from, to{0, 1, 0};
  double radius = 1;
  template <class F>
  static void fields(F&& field) {
    field(&Cylinder::from, FieldInfo{"from", "the centre of one end [m]", Quantity::position, required});
    field(&Cylinder::to, FieldInfo{"to", "the centre of the other end [m]", Quantity::position, required});
    field(&Cylinder::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length, required});
  }
  Problems validate() const {
    Problems problems;
    want_height(problems, from, to, "a cylinder without height is a `disk`");
    want_positive(problems, "radius", radius);
    return problems;
  }

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  Intervald inside(const Vec3d& origin, const Vec3d& direction) const;
  double depth(const Vec3d& p) const;
  Bounds bounds() const;
  Bounds turned_bounds() const;
  Ball ball() const;
  double area() const;
  SurfacePoint sample(double u0, double u1) const;
};

}  // namespace tyndall::shapes
