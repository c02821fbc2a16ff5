// Surfaces that shine: `light sphere`, `light quad` and their like, and `light mesh`.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <variant>

#include "base/fields.h"
#include "base/problem.h"
#include "base/transform.h"
#include "shapes/shape.h"

namespace tyndall::scene {

// The shapes that have a light of their own name. They are moved themselves (area_light.cpp); any other shape
// that has an end is a `light mesh`, which keeps its transform.
using LightShapes = std::variant<shapes::Sphere, shapes::Quad, shapes::Disk, shapes::Cylinder>;

// "light sphere"
template <class S>
inline constexpr auto light_keyword_characters = [] {
  constexpr std::string_view before = "light ";
  std::array<char, before.size() + S::keyword.size()> all{};
  std::size_t i = 0;
  for (const std::string_view part : {before, S::keyword})
    for (const char c : part) all[i++] = c;
  return all;
}();
template <class S>
inline constexpr std::string_view light_keyword{light_keyword_characters<S>.data(),
                                                light_keyword_characters<S>.size()};

template <class S, class Variant>
inline constexpr bool is_one_of = false;
template <class S, class... T>
inline constexpr bool is_one_of<S, std::variant<T...>> = (std::is_same_v<S, T> || ...);

// Any shape with an end, which shines evenly from its outer or front side.
struct AreaLight {
  static constexpr std::string_view mesh_keyword = "light mesh";
  shapes::Shape shape;
  std::optional<Rgb> power, radiance;
  bool visible = true;
  std::optional<Transform> world_from_shape{};  // of shapes that are none of LightShapes

  // Those that it has whatever its shape.
  template <class F>
  static void fields(F&& field) {
    field(&AreaLight::power,
          FieldInfo{"power", "radiant flux [W]", Quantity::color, optional_field, "power"});
    field(&AreaLight::radiance,
          FieldInfo{"radiance", "emitted radiance [W/m²/sr]", Quantity::color, optional_field, "power"});
    field(&AreaLight::visible, FieldInfo{"visible", "whether the camera sees it", Quantity::plain});
  }
  std::string_view keyword() const;

  Problems validate() const;
  bool to_world(const Transform& world_from_local);
  void translate(const Vec3d& by);  // in the world
  std::optional<Vec3d> point() const { return std::nullopt; }
  std::string_view help_for_size() const { return {}; }

  // Emitted radiance, whichever way it was given, when its area in the world is `area` [m²].
  Rgb radiance_over(double area) const;
};

}  // namespace tyndall::scene
