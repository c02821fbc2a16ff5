#pragma once

#include <optional>
#include <string_view>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

// Reaches to infinity: it has no bounds and no area.
struct Plane {
  static constexpr std::string_view keyword = "plane";
  static constexpr std::string_view documentation = "It has no end. `uv` is in metres, from `point`.";
  static constexpr bool closed = false;
  Vec3d point, normal{0, 1, 0};
  template <class F>
  static void fields(F&& field) {
    field(&Plane::point, FieldInfo{"point", "any point of it [m]", Quantity::position, required});
    field(&Plane::normal, FieldInfo{"normal", "its normal", Quantity::direction, required});
  }
  Problems validate() const {
    Problems problems;
    want_direction(problems, "normal", normal);
    return problems;
  }

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  Ball ball() const;
};

}  // namespace tyndall::shapes
