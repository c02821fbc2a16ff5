// The surfaces and volume bounds of a compiled scene, placed in render space.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/geometry/bounds_tree.h"
#include "compile/geometry/bvh_group.h"
#include "compile/geometry/shape_hit.h"

namespace tyndall::compile {

class Geometry {
 public:
  // Keeps pointers to the elements of the scene's vectors and of `volumes`, which must not move (moving the
  // vectors themselves is fine). `origin` is the zero of render space. `glows`: the light of each of the
  // scene's shapes, or empty. `meshes` are the scene's.
  Geometry(const scene::Scene& scene, const Features& features, const Vec3d& origin,
           std::span<const std::uint32_t> glows, std::span<const CompiledVolume> volumes,
           std::vector<CompiledMesh> meshes);

  std::optional<SurfaceHit> closest_hit(const Ray& ray, RayKind kind, const HitOrder& after) const;
  bool occluded(const Ray& ray, std::uint32_t target_light) const;
  ShapeParts parts() const { return {meshes_, curves_}; }
  // Of any shape in its own space; nothing when it is infinite.
  std::optional<Bounds> bounds_of(const scene::Shape& shape) const { return bounds(shape, parts()); }
  void volume_intervals(const Ray& ray, RayKind kind, std::vector<VolumeInterval>& out) const;

  // Whether the box of one of the scene's shapes touches that of anything else but a light.
  bool touches_another(std::uint64_t shape) const { return world_.touches_another(shape); }
  // The box of a volume in render space, over all of its way, or within fractions of the shutter's time.
  Bounds volume_bounds(const CompiledVolume& volume, const Intervald& time = {0, 1}) const;

 private:
  const scene::Moving<scene::ShapeInstance>* moving_light_surface(const scene::Scene& scene,
                                                                  std::uint32_t light, const Vec3d& origin);
  std::vector<CompiledMesh> meshes_;
  std::vector<CompiledCurves> curves_;
  std::vector<Group> prototypes_;
  std::vector<scene::ShapeInstance> light_surfaces_;
  std::deque<scene::Moving<scene::ShapeInstance>> light_surface_motions_;
  Group world_;
  std::span<const CompiledVolume> volumes_;
  std::optional<BoundsTree> volume_tree_;
  Vec3d origin_;
};

}  // namespace tyndall::compile
