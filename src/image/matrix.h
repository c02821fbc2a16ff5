// Matrices between spaces of colours.
#pragma once

#include "base/vec.h"

namespace tyndall::image {

// By rows.
struct Matrix {
  Vec3d r, g, b;

  constexpr Vec3d operator*(const Vec3d& v) const { return {dot(r, v), dot(g, v), dot(b, v)}; }
  constexpr Matrix operator*(const Matrix& m) const {
    const auto row = [&m](const Vec3d& of) { return m.r * of.x + m.g * of.y + m.b * of.z; };
    return {row(r), row(g), row(b)};
  }
};

constexpr Matrix inverse(const Matrix& m) {
  const Vec3d x = cross(m.g, m.b), y = cross(m.b, m.r), z = cross(m.r, m.g);
  const double det = dot(m.r, x);
  return {Vec3d{x.x, y.x, z.x} / det, Vec3d{x.y, y.y, z.y} / det, Vec3d{x.z, y.z, z.z} / det};
}

}  // namespace tyndall::image
