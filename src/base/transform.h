// Affine maps between spaces, in double. Names say the spaces: world_from_object.point(p_object).
#pragma once

#include <array>
#include <optional>

#include "base/vec.h"

namespace tyndall {

// The affine map x -> M x + t, stored with no inverse.
struct Transform {
  // Columns of M: the images of the axes; then t.
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t{0, 0, 0};

  bool operator==(const Transform&) const = default;

  Vec3d point(const Vec3d& p) const { return x * p.x + y * p.y + z * p.z + t; }
  Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  // Applies `b` first.
  friend Transform operator*(const Transform& a, const Transform& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.t)};
  }

  // Volume scale with sign: negative when the map mirrors.
  double determinant() const { return dot(x, cross(y, z)); }
  // The inverse, or nothing when the map flattens space (the determinant is zero or not finite).
  std::optional<Transform> inverse() const;
  // Maps a normal given in the source space: the inverse transpose of M applied to n (not normalised).
  Vec3d normal(const Vec3d& n) const;

  static Transform translate(const Vec3d& offset) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, offset}; }
  static Transform scale(const Vec3d& s) { return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}}; }
  // Counter-clockwise by `radians` seen from the tip of `axis` (any length but zero).
  static Transform rotate(const Vec3d& axis, double radians);
  // The space whose -z looks from `from` to `to`, with +x to the right and `up` upwards.
  // Nothing when from = to or up is parallel to the view.
  static std::optional<Transform> look_at(const Vec3d& from, const Vec3d& to, const Vec3d& up);
};

// The inverse of a map that is known not to flatten space: resolve refuses those that do.
Transform inverse_of(const Transform& t);

// The factor by which all lengths grow when the map is a rotation, mirroring and uniform scale (to 1e-6 of
// it); nothing for others.
std::optional<double> similarity_scale(const Transform& t);

}  // namespace tyndall
