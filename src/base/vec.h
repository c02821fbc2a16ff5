// Small vectors of two and three numbers, and linear RGB colours.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace tyndall {

template <class T>
struct Pair {
  T x{}, y{};

  constexpr bool operator==(const Pair&) const = default;
};

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  constexpr Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  constexpr explicit Vec3(T s) : x(s), y(s), z(s) {}
  template <class U>
  constexpr explicit Vec3(const Vec3<U>& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  constexpr T& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr const T& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr bool operator==(const Vec3&) const = default;

  constexpr Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
  constexpr Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
  constexpr Vec3& operator*=(const Vec3& b) { return *this = *this * b; }
  constexpr Vec3& operator*=(T s) { return *this = *this * s; }
  constexpr Vec3& operator/=(T s) { return *this = *this / s; }

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr Vec3 operator/(const Vec3& a, const Vec3& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
  friend constexpr Vec3 operator*(const Vec3& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3 operator*(T s, const Vec3& a) { return a * s; }
  friend constexpr Vec3 operator/(const Vec3& a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

// Linear Rec. 709 red, green, blue.
using Rgb = Vec3<float>;

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
constexpr T length_squared(const Vec3<T>& a) {
  return dot(a, a);
}
template <class T>
T length(const Vec3<T>& a) {
  return std::sqrt(dot(a, a));
}
// The unit vector along a; a must not be zero.
template <class T>
Vec3<T> normalize(const Vec3<T>& a) {
  return a / length(a);
}
template <class T>
constexpr T max_component(const Vec3<T>& a) {
  return a.x > a.y ? (a.x > a.z ? a.x : a.z) : (a.y > a.z ? a.y : a.z);
}
template <class T>
constexpr T min_component(const Vec3<T>& a) {
  return a.x < a.y ? (a.x < a.z ? a.x : a.z) : (a.y < a.z ? a.y : a.z);
}
template <class T>
bool all_finite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
// Rec. 709 luminance of a linear colour.
constexpr float luminance(const Rgb& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }
constexpr bool is_black(const Rgb& c) { return c.x == 0 && c.y == 0 && c.z == 0; }

// An orthonormal frame whose z axis is a given direction.
template <class T>
struct Frame {
  Vec3<T> x, y, z;

  // Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017); z_axis must have unit length.
  static Frame around(const Vec3<T>& z_axis) {
    const T sign = std::copysign(T(1), z_axis.z);
    const T a = T(-1) / (sign + z_axis.z);
    const T b = z_axis.x * z_axis.y * a;
    return {{T(1) + sign * z_axis.x * z_axis.x * a, sign * b, -sign * z_axis.x},
            {b, sign + z_axis.y * z_axis.y * a, -z_axis.y},
            z_axis};
  }
  Vec3<T> world(const Vec3<T>& local) const { return x * local.x + y * local.y + z * local.z; }
  Vec3<T> local(const Vec3<T>& world_v) const { return {dot(x, world_v), dot(y, world_v), dot(z, world_v)}; }
};

}  // namespace tyndall
