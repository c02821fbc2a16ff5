// Bodies of glass that may overlap: of those that hold a point the one of the highest priority is there, the
// others give way. Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images" (JGT 2002), but asked
// of the scene at each point instead of carried along the path: so cameras and lights may stand inside.
//
// Bodies are the closed shapes of glass, the boundaries of volumes and those inside placed objects among
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/geometry/bvh_group.h"
#include "compile/geometry/shape_dispatch.h"

namespace tyndall::compile {

class Solids {
 public:
  // Keeps pointers to the scene's things and to the materials, which must not move.
  Solids(const scene::Scene& scene, const Vec3d& origin, std::span<const CompiledMaterial> materials,
         const ShapeParts& parts);
  // Those of placed objects counted where they stand.
  double count() const { return count_; }
  // The one body, by its number among the scene's own shapes.
  std::optional<std::uint64_t> single() const { return single_; }

  // The highest of the bodies at a point of render space, of those that rays of a kind meet.
  struct Holder {
    SolidRank rank;
    double ior = 1;
    std::uint32_t material = 0;
  };
  std::optional<Holder> at(const Vec3d& position, double time, RayKind kind) const;

  // Takes out of the stays of volumes with a priority what lies in bodies above them, and in other volumes of
  // a higher priority.
  void cut(const Ray& ray, RayKind kind, std::span<const CompiledVolume> volumes,
           std::vector<VolumeInterval>& intervals) const;

 private:
  std::span<const CompiledMaterial> materials_;
  std::vector<Group> prototypes_;
  Group world_;
  double count_ = 0;
  std::optional<std::uint64_t> single_;
};

// Of all_volumes(scene): their ranks among the bodies, where they have a priority.
std::vector<std::optional<SolidRank>> volume_ranks(const scene::Scene& scene);

}  // namespace tyndall::compile
