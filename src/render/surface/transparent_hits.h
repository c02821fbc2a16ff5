// Surfaces that light goes straight through: opacity below 1. Those that a ray meets are entries of the
// discrete distribution of where its path goes on (transport §3); shadow rays multiply the same (1 -
// opacity).
#pragma once

#include <optional>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/surface/surface_interaction.h"

namespace tyndall::render {

struct Crossing {
  double t = 0;
  SurfacePoint surface;
};

// A surface on a ray, with the throughput up to it and for the part of it that is there.
struct HitSurface {
  const SurfacePoint* point = nullptr;
  Rgb throughput;
  double mass = 0;  // in choosing among them
};

// All surfaces that a ray meets: the discrete part of where its path goes on.
class HitSurfaces {
 public:
  void clear() { list_.clear(), mass_ = 0; }
  // The point must stay.
  void add(const SurfacePoint& point, const Rgb& throughput);
  bool empty() const { return list_.empty(); }
  bool several() const { return list_.size() > 1; }
  double mass() const { return mass_; }
  // About what all of them scatter on.
  Rgb scattered() const;
  // One, in proportion to mass, for u in [0, 1); there must be mass.
  const HitSurface& choose(double u) const;

 private:
  std::vector<HitSurface> list_;
  double mass_ = 0;
};

// What the ray ends at, t from its own start; the surfaces it goes through before, in order, in `crossings`.
std::optional<compile::SurfaceHit> trace_through(const compile::CompiledScene& world, const compile::Ray& ray,
                                                 compile::RayKind kind, ThreadContext& thread,
                                                 std::vector<Crossing>& crossings);

// What surfaces let through towards a light: the product of 1 - opacity.
float pass_to_light(const compile::CompiledScene& world, const compile::Ray& ray, std::uint32_t target_light,
                    ThreadContext& thread);

}  // namespace tyndall::render
