// Direct light at the places of a path: how many samples of it, with which random numbers, for which part of
// the picture.
#pragma once

#include "render/lights/emission_rays.h"
#include "render/method/medium_sampler.h"
#include "render/path/path_settings.h"
#include "render/path/path_state.h"
#include "render/transmittance/shadow_rays.h"

namespace tyndall::render {

// What the parts of a path tracer work with.
struct PathContext {
  const compile::CompiledScene& world;
  const PathSettings& settings;
  MediumSampler& media;
  ShadowBatch& shadows;
  EmissionBatch& emission_rays;
  ThreadContext& thread;
};

// Readies direct light on the path's ray in media, which it has `shares` of.
void prepare_light(const PathContext& context, PathSlot& path, const PathState& s,
                   std::span<const ScatteringOrder> orders, const LightShares& shares);
// The region whose lights a surface is lit by; null: none is known.
const LightRegion* light_region(const PathContext& context, const SurfacePoint& surface);
// Along the ray of state `s` of a path, in media. `continues`: rays that go on there compete, with this
// probability of going on in media.
void light_volume(const PathContext& context, const PathSlot& path, const PathState& s, bool continues,
                  double volume_probability);
// From the point that a free path was aimed at.
void light_aimed(const PathContext& context, const PathSlot& path, const PathState& s, bool continues);
// On a surface that the ray meets.
void light_surface(const PathContext& context, const PathSlot& path, const PathState& s,
                   const SurfacePoint& surface, bool continues);

}  // namespace tyndall::render
