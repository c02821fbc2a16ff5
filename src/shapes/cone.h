#pragma once

#include <optional>
#include <string_view>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

// Or a part of one between two heights, closed by flat ends.
struct Cone {
  static constexpr std::string_view keyword = "cone";
  static constexpr std::string_view documentation =
      "A cone, or with `tip_radius` a part of one; its ends are flat. `uv` is that of a cylinder.";
  static constexpr bool closed = true;
  Vec3d from, to{0, 1, 0};
  double radius = 1, tip_radius = 0;
  template <class F>
  static void fields(F&& field) {
    field(&Cone::from, FieldInfo{"from", "the centre of its base [m]", Quantity::position, required});
    field(&Cone::to,
          FieldInfo{"to", "its tip, or the centre of its other end [m]", Quantity::position, required});
    field(&Cone::radius, FieldInfo{"radius", "the radius of its base, > 0 [m]", Quantity::length, required});
    field(&Cone::tip_radius, FieldInfo{"tip_radius", "the radius at `to`, >= 0 [m]", Quantity::length});
  }
  Problems validate() const {
    Problems problems;
    want_height(problems, from, to, "a cone without height is a `disk`");
    want_positive(problems, "radius", radius);
    want_not_negative(problems, "tip_radius", tip_radius);
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
