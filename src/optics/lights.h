// The lights, as plain structs: what a scene says of them. How they are sampled is in light_sampling.h.
//
// All positions are in the space of the scene file's statement; `resolve` moves them to world space, so below
// it every light is in world space and has no transform.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <variant>

#include "base/fields.h"
#include "base/plane.h"
#include "base/transform.h"
#include "base/vec.h"

namespace tyndall::optics {

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
};

struct SphereLight {
  static constexpr std::string_view keyword = "light sphere";
  Vec3d center;
  double radius = 1;
  std::optional<Rgb> power, radiance;
  bool visible = true;
  template <class F>
  static void fields(F&& field) {
    field(&SphereLight::center, FieldInfo{"center", "its middle [m]", Quantity::position, required});
    field(&SphereLight::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length, required});
    field(&SphereLight::power,
          FieldInfo{"power", "radiant flux [W]", Quantity::color, optional_field, "power"});
    field(&SphereLight::radiance,
          FieldInfo{"radiance", "emitted radiance [W/m²/sr]", Quantity::color, optional_field, "power"});
    field(&SphereLight::visible, FieldInfo{"visible", "whether the camera sees it", Quantity::plain});
  }
};

// Half edges u, v; shines from the side u × v points to.
struct QuadLight {
  static constexpr std::string_view keyword = "light quad";
  Vec3d center, u, v;
  std::optional<Rgb> power, radiance;
  bool visible = true;
  template <class F>
  static void fields(F&& field) {
    field(&QuadLight::center, FieldInfo{"center", "its middle [m]", Quantity::position, required});
    field(&QuadLight::u, FieldInfo{"u", "half of one edge [m]", Quantity::direction, required});
    field(&QuadLight::v,
          FieldInfo{"v", "half of the other edge; it shines along u×v [m]", Quantity::direction, required});
    field(&QuadLight::power,
          FieldInfo{"power", "radiant flux [W]", Quantity::color, optional_field, "power"});
    field(&QuadLight::radiance,
          FieldInfo{"radiance", "emitted radiance [W/m²/sr]", Quantity::color, optional_field, "power"});
    field(&QuadLight::visible, FieldInfo{"visible", "whether the camera sees it", Quantity::plain});
  }
};

// Shines from the side that `normal` points to.
struct DiskLight {
  static constexpr std::string_view keyword = "light disk";
  Vec3d center, normal{0, -1, 0};
  double radius = 1;
  std::optional<Rgb> power, radiance;
  bool visible = true;
  template <class F>
  static void fields(F&& field) {
    field(&DiskLight::center, FieldInfo{"center", "its middle [m]", Quantity::position, required});
    field(&DiskLight::normal, FieldInfo{"normal", "the way it shines", Quantity::direction, required});
    field(&DiskLight::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length, required});
    field(&DiskLight::power,
          FieldInfo{"power", "radiant flux [W]", Quantity::color, optional_field, "power"});
    field(&DiskLight::radiance,
          FieldInfo{"radiance", "emitted radiance [W/m²/sr]", Quantity::color, optional_field, "power"});
    field(&DiskLight::visible, FieldInfo{"visible", "whether the camera sees it", Quantity::plain});
  }
};

class Emitter;

// Any shape, which shines from its outer or front side. The shape itself is the scene's
// (scene::LightInstance).
struct MeshLight {
  static constexpr std::string_view keyword = "light mesh";
  std::optional<Rgb> power, radiance;
  bool visible = true;
  Transform world_from_shape{};
  bool both_sides = false;                   // of shapes whose material glows
  bool drawn = true;                         // false: never drawn, only met
  std::shared_ptr<const Emitter> emitter{};  // the shape where it stands, made by `compile`
  template <class F>
  static void fields(F&& field) {
    field(&MeshLight::power,
          FieldInfo{"power", "radiant flux [W]", Quantity::color, optional_field, "power"});
    field(&MeshLight::radiance,
          FieldInfo{"radiance", "emitted radiance [W/m²/sr]", Quantity::color, optional_field, "power"});
    field(&MeshLight::visible, FieldInfo{"visible", "whether the camera sees it", Quantity::plain});
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
          FieldInfo{"direction", "the way its light travels", Quantity::direction, required});
    field(&DistantLight::irradiance,
          FieldInfo{"irradiance", "on a surface that faces it [W/m²]", Quantity::color, required});
    field(&DistantLight::angle,
          FieldInfo{"angle", "of its disc, across, below 180deg (the sun: 0.53deg)", Quantity::angle});
  }
};

// One radiance for all directions, or that times a picture of them.
struct SkyRadiance {
  Rgb color;
  ColorPlanes picture{};  // none: the colour alone
  bool operator==(const SkyRadiance&) const = default;
};
class Sky;

struct EnvironmentLight {
  static constexpr std::string_view keyword = "light environment";
  SkyRadiance radiance;
  Angle rotation;
  Transform world_from_sky{};        // of the groups around, without their scale; `rotation` comes before it
  std::shared_ptr<const Sky> sky{};  // densities of the picture, made by `compile`
  template <class F>
  static void fields(F&& field) {
    field(&EnvironmentLight::radiance,
          FieldInfo{"radiance", "from all directions [W/m²/sr]: a colour, an image, or a product of the two",
                    Quantity::color, required});
    field(
        &EnvironmentLight::rotation,
        FieldInfo{"rotation", "turns an image about y, counter-clockwise seen from above", Quantity::angle});
  }
};

using Light = std::variant<PointLight, SpotLight, SphereLight, QuadLight, DiskLight, MeshLight, DistantLight,
                           EnvironmentLight>;

// Emitted radiance of the area lights, whichever way it was given [W/m²/sr].
Rgb radiance(const SphereLight& light);
Rgb radiance(const QuadLight& light);
Rgb radiance(const DiskLight& light);
Rgb radiance(const MeshLight& light);  // compiled: its area must be known
// Intensity of a point light [W/sr].
Rgb intensity(const PointLight& light);

// What a spot light gives: `axis` is unit, angles are as 1 - cos, which keeps the digits of narrow cones.
struct SpotCone {
  Vec3d axis;
  double full = 0, rim = 0;  // 1 - cos where the fading begins, and where it ends
  Rgb intensity;             // on the axis [W/sr]

  // The part of the intensity that leaves in a unit direction: a smooth step between `full` and `rim`.
  double share(const Vec3d& direction) const;
};
SpotCone cone(const SpotLight& light);

}  // namespace tyndall::optics
