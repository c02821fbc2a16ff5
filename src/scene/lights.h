// The lights, as plain structs: what a scene says of them. In `Scene` all are in world space; each has
//
//   keyword, fields()  its statement and parameters (base/fields.h)
//   validate()         what is wrong with them
//   to_world(map)      moves it from its statement's space to the world's: false when it does not survive the
//                      map (a sphere stretched). Power, intensity and irradiance hold whatever the map;
//                      radiance is per world area
//   point()            where it is, of a light without extent at a place
//   help_for_size()    of a light without size: how to give it one; empty for others
//
// and its name in `Light`. How rays meet and sample it: compile/lights.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <variant>

#include "base/fields.h"
#include "base/numerics.h"
#include "base/problem.h"
#include "base/transform.h"
#include "base/vec.h"
#include "optics/sky.h"
#include "optics/spot_cone.h"
#include "scene/area_light.h"

namespace tyndall::scene {

struct PointLight {
  static constexpr std::string_view keyword = "light point";
  Vec3d position;
  std::optional<Rgb> power, intensity;
  template <class F>
  static void fields(F&& field) {
    field(&PointLight::position, FieldInfo{"position", "where it is [m]", Quantity::position, required});
    field(&PointLight::power,
          FieldInfo{"power", "radiant flux in all directions [W]", Quantity::color, optional_field, "power"});
    field(&PointLight::intensity,
          FieldInfo{"intensity", "power per solid angle [W/sr]", Quantity::color, optional_field, "power"});
  }

  Problems validate() const {
    Problems problems;
    want_color(problems, "power", power);
    want_color(problems, "intensity", intensity);
    return problems;
  }
  bool to_world(const Transform& world_from_local) {
    position = world_from_local.point(position);
    return true;
  }
  std::optional<Vec3d> point() const { return position; }
  std::string_view help_for_size() const {
    return "give it a size: `light sphere { center: … radius: 2cm … }`";
  }

  // Whichever way it was given [W/sr].
  Rgb emitted_intensity() const {
    return intensity ? *intensity : power.value_or(Rgb{}) * static_cast<float>(inv_4pi);
  }
};

// Shines into a cone, evenly but for a smooth rim.
struct SpotLight {
  static constexpr std::string_view keyword = "light spot";
  Vec3d position, to{0, 0, -1};
  Angle angle;  // half, from the axis to the rim
  double blend = 0;
  std::optional<Rgb> power, intensity;
  template <class F>
  static void fields(F&& field) {
    field(&SpotLight::position, FieldInfo{"position", "where it is [m]", Quantity::position, required});
    field(&SpotLight::to,
          FieldInfo{"to", "a point on the axis of its cone [m]", Quantity::position, required});
    field(&SpotLight::angle,
          FieldInfo{"angle", "from the axis to the rim, in (0deg, 180deg)", Quantity::angle, required});
    field(&SpotLight::blend,
          FieldInfo{"blend", "part of the angle in which it fades to the rim, 0 to 1", Quantity::plain});
    field(&SpotLight::power,
          FieldInfo{"power", "radiant flux into the cone [W]", Quantity::color, optional_field, "power"});
    field(&SpotLight::intensity, FieldInfo{"intensity", "power per solid angle on the axis [W/sr]",
                                           Quantity::color, optional_field, "power"});
  }

  Problems validate() const {
    Problems problems;
    if (position == to)
      problems.push_back({"to", fmt::format("'to' is the position of the light, {}", text_of(to)),
                          "give a point that the light is turned to"});
    if (!(angle.radians > 0 && angle.radians < pi))
      problems.push_back({"angle", fmt::format("'angle' must be between 0deg and 180deg, found {}deg",
                                               angle.radians * 180 / pi)});
    if (!(blend >= 0 && blend <= 1))
      problems.push_back({"blend", fmt::format("'blend' must be from 0 to 1, found {}", blend)});
    want_color(problems, "power", power);
    want_color(problems, "intensity", intensity);
    return problems;
  }
  bool to_world(const Transform& world_from_local) {
    if (!similarity_scale(world_from_local)) return false;
    position = world_from_local.point(position);
    to = world_from_local.point(to);
    return true;
  }
  std::optional<Vec3d> point() const { return position; }
  std::string_view help_for_size() const {
    return "give it a size: `light disk { center: … normal: … radius: 2cm … }`";
  }

  optics::SpotCone cone() const {
    return optics::SpotCone::around(normalize(to - position), angle.radians, blend);
  }
  // On the axis, whichever way it was given [W/sr].
  Rgb emitted_intensity() const {
    return intensity ? *intensity : power.value_or(Rgb{}) * static_cast<float>(1 / cone().solid_angle());
  }
};

struct DistantLight {
  static constexpr std::string_view keyword = "light distant";
  Vec3d direction;  // of travel
  std::optional<Rgb> irradiance;
  Angle angle;  // full angle of the disc; 0 is a point at infinity
  template <class F>
  static void fields(F&& field) {
    field(&DistantLight::direction,
          FieldInfo{"direction", "the direction in which its light travels", Quantity::direction, required});
    field(&DistantLight::irradiance,
          FieldInfo{"irradiance", "on a surface that faces it [W/m²]", Quantity::color, required});
    field(&DistantLight::angle,
          FieldInfo{"angle", "its angular diameter, below 180deg (the sun: 0.53deg)", Quantity::angle});
  }

  Problems validate() const {
    Problems problems;
    want_direction(problems, "direction", direction);
    want_color(problems, "irradiance", irradiance);
    if (!(angle.radians >= 0 && angle.radians < pi))
      problems.push_back({"angle", fmt::format("'angle' must be from 0deg to below 180deg, found {}deg",
                                               angle.radians * 180 / pi)});
    return problems;
  }
  bool to_world(const Transform& world_from_local) {
    direction = normalize(world_from_local.vector(direction));
    return true;
  }
  std::optional<Vec3d> point() const { return std::nullopt; }
  std::string_view help_for_size() const {
    return angle.radians == 0 ? "give it a disc: `angle: 0.53deg` is the sun's" : "";
  }
};

struct EnvironmentLight {
  static constexpr std::string_view keyword = "light environment";
  optics::SkyRadiance radiance;
  Angle rotation;
  Transform world_from_sky{};  // of the groups around, without their scale; `rotation` comes before it
  template <class F>
  static void fields(F&& field) {
    field(&EnvironmentLight::radiance,
          FieldInfo{"radiance", "from all directions [W/m²/sr]: a colour, an image, or a product of the two",
                    Quantity::color, required});
    field(
        &EnvironmentLight::rotation,
        FieldInfo{"rotation", "turns an image about y, counter-clockwise seen from above", Quantity::angle});
  }

  Problems validate() const {
    Problems problems;
    want_color(problems, "radiance", radiance.color);
    return problems;
  }
  bool to_world(const Transform& world_from_local) {
    if (!radiance.picture[0]) return true;
    const std::optional<double> scale = similarity_scale(world_from_local);
    if (!scale) return false;
    const Transform& t = world_from_local;
    world_from_sky = Transform{t.x / *scale, t.y / *scale, t.z / *scale, {}} * world_from_sky;
    return true;
  }
  std::optional<Vec3d> point() const { return std::nullopt; }
  std::string_view help_for_size() const { return {}; }

  Transform world_from_picture() const {
    return world_from_sky * Transform::rotate({0, 1, 0}, rotation.radians);
  }
};

using Light = std::variant<PointLight, SpotLight, DistantLight, AreaLight, EnvironmentLight>;

}  // namespace tyndall::scene
