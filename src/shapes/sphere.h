#pragma once

#include <optional>
#include <string_view>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

struct Sphere {
  static constexpr std::string_view keyword = "sphere";
  static constexpr std::string_view documentation =
      "`uv` is the longitude, 0.5 towards +z, and the latitude, 1 at the top.";
  static constexpr bool closed = true;
  Vec3d center;
  double radius = 1;
  template <class F>
  static void fields(F&& field) {
    field(&Sphere::center, FieldInfo{"center", "its centre [m]", Quantity::position});
    field(&Sphere::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length});
  }
  Problems validate() const {
    Problems problems;
    want_positive(problems, "radius", radius);
    return problems;
  }

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  Intervald inside(const Vec3d& origin, const Vec3d& direction) const;
  double depth(const Vec3d& p) const;
  Bounds bounds() const;
  Ball ball() const;
  double area() const;
  SurfacePoint sample(double u0, double u1) const;
};

}  // namespace tyndall::shapes
