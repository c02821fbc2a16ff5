#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

struct Box {
  static constexpr std::string_view keyword = "box";
  static constexpr std::string_view documentation = "`uv` goes across each face.";
  static constexpr bool closed = true;
  Vec3d min, max;
  template <class F>
  static void fields(F&& field) {
    field(&Box::min, FieldInfo{"min", "its lowest corner [m]", Quantity::position, required});
    field(&Box::max, FieldInfo{"max", "its highest corner [m]", Quantity::position, required});
  }
  Problems validate() const;

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  Intervald inside(const Vec3d& origin, const Vec3d& direction) const;
  double depth(const Vec3d& p) const;
  Bounds bounds() const;
  Ball ball() const;
  std::vector<Triangle> triangles() const;
};

}  // namespace tyndall::shapes
