// Rays against triangle meshes, in double and in the mesh's space, without cracks: neighbours decide a shared
// edge by the same exact test. After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT
// 2013), with edges owned by one side as in rasterisation, so that every line crosses a closed mesh as often
// inwards as outwards.
#pragma once

#include <optional>
#include <vector>

#include "compile/bounds_tree.h"
#include "compile/shape_queries.h"

namespace tyndall::compile {

class CompiledMesh {
 public:
  // The mesh must stay where it is.
  explicit CompiledMesh(const scene::TriangleMesh& mesh);
  // Whether the mesh has an inside; true until it was looked into, which only glass needs.
  bool closed() const { return closed_; }
  void find_whether_closed() { closed_ = scene::open_edges(*mesh_) == 0; }

  // As intersect() of shape_queries.h.
  std::optional<ShapeHit> intersect(const Vec3d& origin, const Vec3d& direction, double t_max,
                                    const After& after = {}) const;
  // Appends the stays where the winding number is not zero, clipped to [0, t_max), in order.
  void inside(const Vec3d& origin, const Vec3d& direction, double t_max, std::vector<Intervald>& out) const;
  const Bounds& bounds() const { return bounds_; }

 private:
  template <class Test>
  void visit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max, Test&& test) const;

  const scene::TriangleMesh* mesh_;
  Bounds bounds_;
  std::optional<BoundsTree> tree_;
  bool closed_ = true;
};

}  // namespace tyndall::compile
