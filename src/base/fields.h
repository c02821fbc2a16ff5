// fields(): a struct states its parameters once; reading with positions, errors, printing and the manual
// derive from it.
//
//   struct SphereLight {
//     static constexpr std::string_view keyword = "light sphere";
//     Vec3d center; double radius = 0; …
//     template <class F> static void fields(F&& field) {
//       field(&SphereLight::center, {"center", "where it is", Quantity::position, required});
//       …
//     }
//   };
//
// Member types that readers know: double, bool, Angle, Vec3d, Rgb, Transform, std::string,
// std::optional<those>, and in `scene` typed ids. A field's default is its member's initialiser.
#pragma once

#include <string_view>

namespace tyndall {

// An angle in radians: a type of its own, so that no bare number is taken for one.
struct Angle {
  double radians = 0;
  constexpr bool operator==(const Angle&) const = default;
};

// What a number or vec measures: settles which units fit, and whether a number widens to a vec (colours and
// scales widen; positions and directions do not).
enum class Quantity : unsigned char {
  plain,   // a ratio or count
  length,  // metres
  time,    // seconds
  position,
  direction,  // vecs that never widen
  color,      // any colour quantity: a number is that much in each of R, G, B
  angle,
};

enum class Presence : bool { optional, required };
inline constexpr Presence required = Presence::required;
inline constexpr Presence optional_field = Presence::optional;

struct FieldInfo {
  std::string_view name;
  std::string_view documentation;  // with unit and range
  Quantity quantity = Quantity::plain;
  Presence presence = Presence::optional;
  // "radiance": exactly one of the fields with the same non-empty group must be given.
  std::string_view one_of = {};
};

}  // namespace tyndall
