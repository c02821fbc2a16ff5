// Rays against triangle meshes, in double and in the mesh's space, without cracks: neighbours decide a shared
// edge by the same exact test. After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT
// 2013), with edges owned by one side as in rasterisation, so that every line crosses a closed mesh as often
// inwards as outwards.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "compile/geometry/bounds_tree.h"
#include "compile/geometry/shape_hit.h"

namespace tyndall::compile {

class CompiledMesh {
 public:
  explicit CompiledMesh(scene::SharedMesh mesh);
  // Whether this is what the mesh would become: it is the same one, or no number of it differs.
  bool is_like(const scene::SharedMesh& mesh) const { return mesh_ == mesh || *mesh_ == *mesh; }
  // Of a mesh that it is like.
  CompiledMesh made_of(scene::SharedMesh mesh) const {
    CompiledMesh out = *this;
    out.mesh_ = std::move(mesh);
    return out;
  }
  // Whether the mesh has an inside; true until it was looked into, which only glass needs.
  bool closed() const { return closed_; }
  bool deforms() const { return !mesh_->later.empty(); }
  void find_whether_closed() { closed_ = !mesh_->thin && scene::open_edges(mesh_) == 0; }

  // As intersect() of shape_dispatch.h.
  std::optional<ShapeHit> intersect(const Vec3d& origin, const Vec3d& direction, double t_max,
                                    const After& after = {}, double time = 0) const;
  // Appends the stays where the winding number is not zero, clipped to [0, t_max), in order.
  void inside(const Vec3d& origin, const Vec3d& direction, double t_max, std::vector<Intervald>& out,
              double time = 0) const;
  // Over all the time that the shutter is open.
  const Bounds& bounds() const { return bounds_; }
  // Within fractions of it.
  Bounds bounds_within(const Intervald& time) const;
  const scene::TriangleMesh& mesh() const { return *mesh_; }

 private:
  template <class Test>
  void visit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max, double time,
             Test&& test) const;

  scene::SharedMesh mesh_;
  Bounds bounds_;
  std::shared_ptr<const BoundsTree> tree_;
  bool closed_ = true;
};

}  // namespace tyndall::compile
