// Next-event estimation: direct light at the places of a path (transport §3).
#pragma once

#include <optional>
#include <span>

#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "optics/light_sampling.h"
#include "render/distance/density_sampling.h"
#include "render/lights/light_selection.h"
#include "render/lights/ray_pieces.h"
#include "render/march/march.h"
#include "render/march/phase_mixture.h"
#include "render/surface/surface_interaction.h"
#include "render/tracking/free_path.h"
#include "render/transmittance/scattering_octaves.h"
#include "render/transmittance/shadow_rays.h"

namespace tyndall::render {

// How much of the light counts that distant lights, lights with a place, and skies bring: what is left of it
// is brought by rays of other techniques.
struct LightShares {
  float distant = 1, lamps = 1, skies = 1;

  float of(const compile::CompiledLight& light) const {
    if (light.toward()) return distant;
    return light.kind() == compile::LightKind::environment ? skies : lamps;
  }
  static constexpr LightShares distant_alone() { return {1, 0, 0}; }
  static constexpr LightShares lamps_alone() { return {0, 1, 0}; }
};

// A ray through media with what is needed to sample direct light on it, and to say with which density (t, y)
// was drawn from it.
struct LitRay {
  const compile::CompiledScene* world = nullptr;
  const March* march = nullptr;
  Rgb throughput;
  std::optional<LightSelection> lights;        // where the march scatters
  RayPieces pieces;                            // that light is sampled in; none: in the whole ray
  std::optional<DensityDistribution> density;  // of methods that keep the whole march
  std::optional<PhaseMixture> typical_phase;   // where a strategy for distances uses it
  std::span<const ScatteringOrder> orders;     // that are added to the first; none where paths go on
  const FreePath* free_path = nullptr;         // of methods that sample free paths
  LightShares shares;                          // of the light that counts here

  // Whether no light brings anything to the ray.
  bool empty() const { return !lights || lights->empty(); }
};

// One sample of the direct light along a ray: how it is drawn, and what it is worth.
struct LightRequest {
  SobolPoint point{};  // light u, light v, t, light
  std::uint32_t shadow_seed = 0;
  Rgb weight;          // multiplies the contribution
  LightTarget target;  // whose light it is
  // Whether the path's own continuation competes for the same light by MIS, with this probability of going on
  // in the volume.
  bool continues = false;
  double volume_probability = 0;
  int samples = 1;       // that are taken in all
  LightShares shares{};  // on surfaces: of the light that counts
};

// Light drawn at x, in a segment of a marched ray. `carried` to the camera but for the phase function;
// `share` is the MIS weight, `share_of_higher` that without the path's own continuation, which brings the
// first order alone.
struct Arrival {
  const optics::LightSample& drawn;
  std::uint32_t light = 0;
  Vec3d x;
  std::uint32_t segment = 0;
  Rgb carried;
  double share = 1, share_of_higher = 1;
};
// Adds its shadow ray. `phase` is that of the segment.
void add_arrival(const LitRay& ray, const Arrival& arrival, const PhaseMixture& phase,
                 const LightRequest& request, std::uint32_t shadow_seed, ShadowBatch& shadows);

// The shadow ray from a point to what was drawn of a light.
ShadowRay shadow_ray(const compile::CompiledScene& world, const Vec3d& from, double time,
                     const optics::LightSample& light, std::uint32_t index, const Rgb& contribution,
                     std::uint32_t seed);

// Adds the shadow ray of one light sample on a surface. `lights` are those of the place; the surface's own
// sampling competes where the request `continues`.
void sample_surface_light(const compile::CompiledScene& world, const SurfacePoint& surface,
                          const LightSelection& lights, const LightRequest& request, ShadowBatch& shadows);

// Balance heuristic of `samples` draws with density p against one draw with density q: the weight of p.
inline double balance(double samples, double p, double q) {
  const double sum = samples * p + q;
  return sum > 0 ? samples * p / sum : 0.0;
}

}  // namespace tyndall::render
