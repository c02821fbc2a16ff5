// What is hidden from where: before rendering begins, a pilot looks from places where paths will sample
// lights and learns, for each region of space, which parts of the light tree bring light there
// (light_region.h). What it does not see, or only roughly, costs noise and never light.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/lights/light_places.h"
#include "render/lights/light_region.h"
#include "render/lights/region_tree.h"
#include "render/transmittance/transmittance.h"

namespace tyndall::render {

class LearnedLights {
 public:
  // Null where nothing can be learned that pays: lights are few, or nothing hides them. The same for any
  // number of threads.
  static std::unique_ptr<const LearnedLights> of(const compile::CompiledScene& world,
                                                 Transmittance transmittance, int threads);

  // The region of a place in a medium, or on the side of a surface that the unit normal points to; null far
  // from all that the pilot looked at.
  const LightRegion* in_medium(const Vec3d& x) const;
  const LightRegion* on_surface(const Vec3d& x, const Vec3d& normal) const;
  // Calls visit(region or null, part) for the parts of a ray through media, in order.
  template <class Visit>
  void walk(const compile::Ray& ray, const Intervald& t, Visit&& visit) const {
    const Kind& media = *kinds_[0];
    media.tree.walk(ray.origin, ray.direction, t, [&](std::uint32_t region, const Intervald& part) {
      visit(&media.regions[region], part);
    });
  }
  bool knows_media() const { return kinds_[0].has_value(); }

 private:
  // Of media, or of surfaces that face one of six ways.
  struct Kind {
    RegionTree tree;
    std::vector<LightRegion> regions;
  };
  static constexpr std::size_t kind_count = 7;
  static std::size_t kind_of(const Vec3d& normal);
  const LightRegion* region_at(std::size_t kind, const Vec3d& x) const;

  std::optional<Kind> kinds_[kind_count];
};

}  // namespace tyndall::render
