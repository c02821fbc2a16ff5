// What compiled lights have in common: which questions they answer, and the answers of whole groups of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "optics/light_bounds.h"
#include "optics/light_sampling.h"
#include "optics/sky.h"
#include "scene/scene.h"

namespace tyndall::compile {

// A light in render space, made of what the scene says (scene/lights.h). Specialised for each of
// scene::Light's alternatives in a file of its own, with these members:
//
//   Compiled(light, setting)
//   moved(light, setting)             the same light at another time; what is drawn by stays
//   kind()
//   sample_pivot(u0, u1)              drawn on a flat light, the centre of a sphere, the point itself;
//   nothing
//                                     for lights without a place
//   pivot_on_surface()                whether it is the point of the surface that `sample` then aims at
//   sample(x, pivot, u0, u1)          a direction from x to the light, through the pivot where that is on the
//                                     surface; nothing when the light does not reach x, and for environments
//                                     of one colour, which are gathered where rays end
//   pdf(x, direction, y, normal)      density per solid angle with which `sample` draws, from x, a direction
//                                     that meets the light at y with this unit normal; averaged over pivots
//   emitted(direction, normal)        radiance towards -direction from its surface, for rays that hit it
//   radiance_from_infinity(direction) along a ray that ends there
//   reached_parts(pivot, origin, direction, t_max)
//   importance(segment)               >= 0, for choosing among lights: optics::nearest_irradiance
//   bounds()                          for trees of lights; nothing for lights at infinity
//   shadow_margin()                   of lights that may hide parts of themselves: how far before their
//                                     surface shadow rays end [m]; the surface of others is passed by name
//   toward()                          of lights for distant-light guiding: the direction to them
template <class SceneLight>
class Compiled;

enum class LightKind : std::uint8_t { delta, area, distant_disc, environment };

// Where compiled lights come from: the scene, and the place in the world of render space's zero.
struct LightSetting {
  const scene::Scene& scene;
  Vec3d origin;
  // Skies that were made before, and may be taken over; this light's is added. Null: none are kept.
  std::vector<std::shared_ptr<const optics::Sky>>* skies = nullptr;
};

// Lights that no ray meets: without extent, at a place.
struct WithoutExtent {
  LightKind kind() const { return LightKind::delta; }
  bool pivot_on_surface() const { return false; }
  double pdf(const Vec3d&, const Vec3d&, const Vec3d&, const Vec3d&) const { return 0; }
  Rgb emitted(const Vec3d&, const Vec3d&) const { return {}; }
  Rgb radiance_from_infinity(const Vec3d&) const { return {}; }
  std::optional<double> shadow_margin() const { return std::nullopt; }
  std::optional<Vec3d> toward() const { return std::nullopt; }
};

// Lights without a place: they reach everything, and rays meet them when they leave the scene.
struct AtInfinity {
  std::optional<optics::Pivot> sample_pivot(float, float) const { return std::nullopt; }
  bool pivot_on_surface() const { return false; }
  Rgb emitted(const Vec3d&, const Vec3d&) const { return {}; }
  optics::ReachedParts reached_parts(const optics::Pivot&, const Vec3d&, const Vec3d&, double t_max) const {
    return optics::whole_ray(t_max);
  }
  std::optional<optics::LightBounds> bounds() const { return std::nullopt; }
  std::optional<double> shadow_margin() const { return std::nullopt; }
};

}  // namespace tyndall::compile
