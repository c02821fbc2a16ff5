// Closed shapes combined into one: what is in the first and in none of the others, in all of them, or in any.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "base/inline_vector.h"
#include "shapes/query.h"

namespace tyndall::shapes {

struct CombinedParts;  // combined_parts.h

// Where a line is inside: in order and apart from each other.
using Stays = InlineVector<Intervald, 4>;

enum class Combining : unsigned char { difference, intersection, union_ };

// As of the other shapes (query.h).
inline bool crosses(const Stays& stays, double t_min, double t_max) {
  for (const Intervald& stay : stays)
    if (crosses(stay, t_min, t_max)) return true;
  return false;
}

// What the three have in common. Nobody changes the parts.
struct CombinedShape {
  static constexpr bool closed = true;
  std::shared_ptr<const CombinedParts> parts;
  template <class F>
  static void fields(F&&) {}

  std::optional<ShapeHit> hit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max) const;
  Stays inside(const Vec3d& origin, const Vec3d& direction) const;
  double depth(const Vec3d& p) const;
  Bounds bounds() const;
  Ball ball() const;
};

struct Difference : CombinedShape {
  static constexpr std::string_view keyword = "difference";
  static constexpr std::string_view documentation =
      "The first of the closed shapes in its braces, without the others. `uv` is that of the shape whose "
      "surface is met.";
  static constexpr Combining combining = Combining::difference;
};

struct Intersection : CombinedShape {
  static constexpr std::string_view keyword = "intersection";
  static constexpr std::string_view documentation =
      "What all closed shapes in its braces have in common. `uv` is that of the shape whose surface is met.";
  static constexpr Combining combining = Combining::intersection;
};

struct Union : CombinedShape {
  static constexpr std::string_view keyword = "union";
  static constexpr std::string_view documentation =
      "The closed shapes in its braces as one, without the faces inside. `uv` is that of the shape whose "
      "surface is met.";
  static constexpr Combining combining = Combining::union_;
};

}  // namespace tyndall::shapes
