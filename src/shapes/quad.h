#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/fields.h"
#include "base/problem.h"
#include "shapes/query.h"

namespace tyndall::shapes {

// Half edges u, v around center; faces u × v.
struct Quad {
  static constexpr std::string_view keyword = "quad";
  static constexpr std::string_view documentation = "`uv` goes along `u` and `v`.";
  static constexpr bool closed = false;
  Vec3d center, u, v;
  template <class F>
  static void fields(F&& field) {
    field(&Quad::center, FieldInfo{"center", "its centre [m]", Quantity::position, required});
    field(&Quad::u, FieldInfo{"u", "half of one edge [m]", Quantity::direction, required});
    field(&Quad::v, FieldInfo{"v", "half of the other edge [m]", Quantity::direction, required});
  }
  Problems validate() const {
    Problems problems;
    want_area(problems, u, v);
    return problems;
  }

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  Bounds bounds() const;
  Ball ball() const;
  std::vector<Triangle> triangles() const;
};

}  // namespace tyndall::shapes
