// Light from media that emit, taken as direct light: in directions that are drawn towards fire.
#pragma once

#include "render/lights/emission_grid.h"
#include "render/lights/emission_rays.h"
#include "render/method/medium_ray.h"
#include "render/path/path_state.h"
#include "render/surface/surface_interaction.h"

namespace tyndall::render {

// Adds one of the request's samples from a surface, and one from where a ray is scattered by a medium. The
// point of the request: a cell of a medium that emits, and three numbers for the point in it.
void sample_surface_emission(const EmissionGrids& grids, const SurfacePoint& surface,
                             const LightRequest& request, EmissionBatch& rays);
void sample_volume_emission(const compile::CompiledScene& world, const EmissionGrids& grids,
                            const March& march, const Scattering& at, const LightRequest& request,
                            EmissionBatch& rays);

// MIS weight of the emission that a path meets by going on, against `light_samples` of these rays from where
// it was scattered first and one from later places.
float mis_weight_of_emission(const EmissionGrids& grids, int light_samples, const PathState& s);

}  // namespace tyndall::render
