#include "base/transform.h"

#include <cmath>

#include "base/check.h"

namespace tyndall {

std::optional<Transform> Transform::inverse() const {
  const double det = determinant();
  if (det == 0 || !std::isfinite(det) || !std::isfinite(1 / det)) return std::nullopt;
  const Vec3d rx = cross(y, z) / det, ry = cross(z, x) / det, rz = cross(x, y) / det;  // rows of the inverse
  Transform inv{{rx.x, ry.x, rz.x}, {rx.y, ry.y, rz.y}, {rx.z, ry.z, rz.z}, {}};
  inv.t = -inv.vector(t);
  return inv;
}

Transform inverse_of(const Transform& t) {
  const auto inverse = t.inverse();
  CHECK(inverse.has_value());
  return *inverse;
}

Vec3d Transform::normal(const Vec3d& n) const {
  // The cofactor matrix is det * inverse transpose; its sign is mended so that mirrors keep the normal's
  // side.
  const Vec3d mapped = cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
  return determinant() < 0 ? -mapped : mapped;
}

Transform Transform::rotate(const Vec3d& axis, double radians) {
  const Vec3d a = normalize(axis);
  const double s = std::sin(radians), c = std::cos(radians), k = 1 - c;
  return {{c + a.x * a.x * k, a.y * a.x * k + a.z * s, a.z * a.x * k - a.y * s},
          {a.x * a.y * k - a.z * s, c + a.y * a.y * k, a.z * a.y * k + a.x * s},
          {a.x * a.z * k + a.y * s, a.y * a.z * k - a.x * s, c + a.z * a.z * k},
          {}};
}

std::optional<Transform> Transform::look_at(const Vec3d& from, const Vec3d& to, const Vec3d& up) {
  const Vec3d back = from - to;
  const Vec3d right = cross(up, back);
  if (!(length(back) > 0) || !(length(right) > 0)) return std::nullopt;
  const Vec3d z = normalize(back), x = normalize(right);
  return Transform{x, cross(z, x), z, from};
}

std::optional<double> similarity_scale(const Transform& t) {
  constexpr double tolerance = 1e-6;
  const double x2 = length_squared(t.x), y2 = length_squared(t.y), z2 = length_squared(t.z);
  const double scale2 = (x2 + y2 + z2) / 3;
  const auto close = [&](double a, double b) { return std::abs(a - b) <= tolerance * scale2; };
  if (!close(x2, scale2) || !close(y2, scale2) || !close(z2, scale2)) return std::nullopt;
  if (!close(dot(t.x, t.y), 0) || !close(dot(t.y, t.z), 0) || !close(dot(t.z, t.x), 0)) return std::nullopt;
  return std::sqrt(scale2);
}

}  // namespace tyndall
