#pragma once

#include <optional>
#include <string_view>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

struct Disk {
  static constexpr std::string_view keyword = "disk";
  static constexpr std::string_view documentation = "`uv` goes across it, (0.5, 0.5) at its centre.";
  static constexpr bool closed = false;
  Vec3d center, normal{0, 1, 0};
  double radius = 1;
  template <class F>
  static void fields(F&& field) {
    field(&Disk::center, FieldInfo{"center", "its centre [m]", Quantity::position, required});
    field(&Disk::normal, FieldInfo{"normal", "its normal", Quantity::direction, required});
    field(&Disk::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length, required});
  }
  Problems validate() const {
    Problems problems;
    want_direction(problems, "normal", normal);
    want_positive(problems, "radius", radius);
    return problems;
  }

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  Bounds bounds() const;
  Bounds turned_bounds() const;
  Ball ball() const;
  double area() const;
  SurfacePoint sample(double u0, double u1) const;
};

}  // namespace tyndall::shapes
