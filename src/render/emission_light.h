// Light from media that emit, taken as direct light: in directions drawn towards fire.
#pragma once

#include "base/sampler.h"
#include "render/emission_field.h"
#include "render/path_state.h"
#include "render/propagation.h"
#include "render/surface.h"

namespace tyndall::render {

// Adds one of `samples` rays from a surface. `continues`: rays that go on by themselves compete.
void sample_surface_emission(const EmissionField& field, const SurfacePoint& surface, const SobolPoint& point,
                             std::uint32_t seed, const Rgb& weight, bool continues, int samples,
                             Worker& worker);
// The same from where a ray is scattered by a medium. `continuation`: the probability of going on there.
void sample_volume_emission(const compile::CompiledScene& world, const EmissionField& field,
                            const March& march, const Scattering& at, const SobolPoint& point,
                            std::uint32_t seed, const Rgb& weight, double continuation, int samples,
                            Worker& worker);

// MIS weight of the emission that a path meets by going on, against `light_samples` of these rays from where
// it was scattered first and one from later places.
float weight_of_met_emission(const EmissionField& field, int light_samples, const PathState& s);

}  // namespace tyndall::render
