// A point of a surface with its material evaluated: what it emits and how it scatters, in world directions.
#pragma once

#include <optional>

#include "base/numerics.h"
#include "base/vec.h"
#include "compile/compiled_scene.h"
#include "optics/surface_model.h"
#include "render/context/thread_context.h"

namespace tyndall::render {

struct SurfacePoint {
  Vec3d position, normal;  // the geometric normal on the side of the ray that hit it, unit
  // Off the surface before and behind it, where rays that leave it start.
  Vec3d offset_position, behind_position;
  Rgb emission;       // [W/m²/sr]
  Rgb reflectance;    // about what part of the light is scattered on, in [0, 1]
  float opacity = 1;  // all else is of the part that is there
  double time = 0;    // the ray's
  double eta = 1;     // index behind over that before; 1 where no light goes to another medium
  bool transmits = false, only_deltas = false;
  Frame<double> frame;                        // z: the normal to shade with
  std::optional<optics::SurfaceModel> model;  // none: Lambert's law with `reflectance`

  const Vec3d& start(const Vec3d& direction) const {
    return dot(normal, direction) > 0 ? offset_position : behind_position;
  }
  // The BSDF times the cosine for light from `direction`, and the density of `sample`; without deltas.
  // Nothing passes where the normal to shade with and the geometric one disagree about the side.
  Rgb value(const Vec3d& direction) const;
  double pdf(const Vec3d& direction) const;
  // Draws the direction of a ray that goes on, from (layer, 2 of the direction, choice).
  std::optional<optics::SurfaceSample> sample(float u_layer, float u0, float u1, float u2) const;
};

// Runs the material's program at a hit by a ray of this direction.
SurfacePoint evaluate_surface(const compile::CompiledScene& world, const compile::SurfaceHit& hit,
                              const Vec3d& direction, ThreadContext& thread);
// The opacity alone.
float evaluate_opacity(const compile::CompiledScene& world, const compile::SurfaceHit& hit,
                       ThreadContext& thread);

}  // namespace tyndall::render
