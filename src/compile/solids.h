// Bodies of glass that may overlap: of those that hold a point the one of the highest priority is there, the
// others give way. Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images" (JGT 2002), but asked
// of the scene at each point instead of carried along the path: so cameras and lights may stand inside.
//
// Bodies are the scene's own closed shapes of glass, the boundaries of volumes among them; those inside
// placed objects do not take part.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/parts.h"

namespace tyndall::compile {

class Solids {
 public:
  Solids(const scene::Scene& scene, const Vec3d& origin, std::span<const CompiledMaterial> materials,
         const ShapeParts& parts);
  std::size_t count() const { return list_.size(); }

  // The highest of the bodies at a point of render space, other than the shape `except`.
  struct Holder {
    SolidRank rank;
    double ior = 1;
  };
  std::optional<Holder> at(const Vec3d& position, double time, std::uint32_t except) const;

  // Takes out of the stays of volumes with a priority what lies in bodies above them.
  void cut(const Ray& ray, std::span<const CompiledVolume> volumes,
           std::vector<VolumeInterval>& intervals) const;

 private:
  struct Solid {
    const scene::Shape* shape;
    Transform shape_from_render;
    SolidRank rank;
    double ior;
    const scene::Moving<scene::ShapeInstance>* motion;  // null: it stands still
  };
  // Calls visit(shape, shape_from_render) for the body as it is at a ray's time.
  template <class Visit>
  void placed(const Solid& solid, double time, Visit&& visit) const;
  std::vector<Solid> list_;
  ShapeParts parts_;
  Vec3d origin_;
};

}  // namespace tyndall::compile
