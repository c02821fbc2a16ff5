// Shapes for the reference renderer, apart from what the renderer asks them (src/shapes).
#pragma once

#include <optional>

#include "base/interval.h"
#include "scene/scene.h"

namespace tyndall::reference {

// A ray in a shape's own space; the direction is not unit, so that t is the world's.
struct LocalRay {
  Vec3d origin, direction;
};

struct LocalHit {
  double t = 0;
  Vec3d normal;
};

// Where a line may be inside of a closed shape.
Intervald interval_inside(const scene::Scene& scene, const scene::Shape& shape, const LocalRay& ray);
std::optional<LocalHit> hit(const scene::Scene& scene, const scene::Shape& shape, const LocalRay& ray,
                            double t_min, double t_max);
bool contains(const scene::Scene& scene, const scene::Shape& shape, const Vec3d& p);

}  // namespace tyndall::reference
