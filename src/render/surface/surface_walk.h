// The surfaces that a ray meets, one after the other and each once: told apart by what they are, not by how
// far apart they are. Boundaries of glass in one place are crossed together, as one.
#pragma once

#include <optional>
#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::render {

class SurfaceWalk {
 public:
  // Keeps references.
  SurfaceWalk(const compile::CompiledScene& world, const compile::Ray& ray, compile::RayKind kind)
      : world_(world), ray_(ray), kind_(kind) {}

  // In order of t; nothing after the last one. Boundaries that other bodies of glass hide are left out.
  std::optional<compile::SurfaceHit> next();

 private:
  bool is_boundary(const compile::SurfaceHit& hit) const;
  // A thin pane of glass: an open surface that transmits.
  bool is_pane(const compile::SurfaceHit& hit) const;
  bool stops(const compile::SurfaceHit& hit) const;
  void gather(const compile::SurfaceHit& first);
  void cross_together();

  const compile::CompiledScene& world_;
  const compile::Ray& ray_;
  compile::RayKind kind_;
  compile::HitOrder after_;
  // What stands in one place, and how much of it was told.
  std::vector<compile::SurfaceHit> together_;
  std::size_t told_ = 0;
};

}  // namespace tyndall::render
