// A point of a surface with its material evaluated: a Lambertian reflector that may emit.
#pragma once

#include "base/numerics.h"
#include "base/vec.h"
#include "compile/compiled_scene.h"

namespace tyndall::render {

struct Worker;

struct SurfacePoint {
  Vec3d position, normal;  // the normal on the side of the ray that met it, unit
  Vec3d offset_position;   // off the surface, where rays that leave it start
  Rgb reflectance;         // in [0, 1]
  Rgb emission;            // [W/m²/sr]
};

// Runs the material's program at a hit by a ray of this direction.
SurfacePoint evaluate_surface(const compile::CompiledScene& world, const compile::SurfaceHit& hit,
                              const Vec3d& direction, Worker& worker);

// Density per solid angle of the cosine-weighted directions that `sample_cosine` draws.
inline double cosine_pdf(double cosine) { return cosine > 0 ? cosine / pi : 0.0; }
Vec3d sample_cosine(const Vec3d& normal, float u0, float u1);

}  // namespace tyndall::render
