#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

// A tube around a circle.
struct Torus {
  static constexpr std::string_view keyword = "torus";
  static constexpr std::string_view documentation =
      "A tube around a circle. `uv` goes around its axis and around the tube: `uv.y` is 0.5 where that is "
      "farthest from the axis, 0.75 where it is highest along `normal`.";
  static constexpr bool closed = true;
  Vec3d center, normal{0, 1, 0};
  double radius = 1, tube = 0.25;
  template <class F>
  static void fields(F&& field) {
    field(&Torus::center, FieldInfo{"center", "its centre [m]", Quantity::position});
    field(&Torus::normal, FieldInfo{"normal", "the axis that it goes around", Quantity::direction});
    field(&Torus::radius, FieldInfo{"radius", "of the circle along the centre of the tube, > 0 [m]",
                                    Quantity::length, required});
    field(&Torus::tube, FieldInfo{"tube", "the radius of the tube, > 0 and below `radius` [m]",
                                  Quantity::length, required});
  }
  Problems validate() const;

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  // In order; those behind the last are empty.
  std::array<Intervald, 2> inside(const Vec3d& origin, const Vec3d& direction) const;
  double depth(const Vec3d& p) const;
  Bounds bounds() const;
  Bounds turned_bounds() const;
  Ball ball() const;
  double area() const;
  SurfacePoint sample(double u0, double u1) const;
};

}  // namespace tyndall::shapes
