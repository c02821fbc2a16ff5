// What the methods for media (medium_sampler.h) are asked, and what they keep of a path's ray.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"
#include "render/context/sample_dimensions.h"
#include "render/lights/next_event.h"
#include "render/march/ray_march.h"
#include "render/tracking/free_path.h"
#include "render/transmittance/scattering_octaves.h"

namespace tyndall::render {

// One ray of a path through media. The path keeps it until its next ray has ended: it weights what that one
// meets.
struct MediumRay {
  March march;
  LitRay light;
  FreePath free_path;  // of the methods that sample free paths
};

// A ray that is to go through media, up to ray.t_max.
struct PropagationRequest {
  MediumRay* out = nullptr;
  compile::Ray ray;
  compile::RayKind kind{};
  Rgb throughput;
  PathNumbers numbers;
  bool jitters = false;                     // places in segments are random
  bool may_end_early = false;               // its march, by Russian roulette
  std::span<const ScatteringOrder> orders;  // that direct light on it has besides the first
};

// A light that the path hit by its own continuation from t, in a segment of an earlier ray, along
// `direction`; at y of its surface with this normal.
struct LightHit {
  std::uint32_t light = 0, segment = 0;
  double t = 0;
  Vec3d direction, y, normal;
};

// Where a path is scattered by the medium.
struct Scattering {
  double t = 0;
  std::uint32_t segment = 0;
  double pdf = 0;  // [1/m], times the probability of going on in the volume
  Rgb weight;      // sigma_s T / pdf
};

// What the rest of the renderer needs to know of a method.
struct MethodTraits {
  bool many_light_samples = false;  // `light_samples` of them a ray; one otherwise
  bool always_jitters = false;      // random places in segments, also where no medium varies
  bool guides = false;              // rays towards distant lights (distant_light_guiding.h)
  bool samples_emission = true;     // rays that sum the emission of media along marches
  bool aims = false;                // light is sampled at a place that is chosen before the ray is followed
};

// Rays that are marched, for the methods that do.
class MarchQueue {
 public:
  void add(const PropagationRequest& r, bool may_end_by_roulette) {
    const std::uint32_t seed = r.jitters ? r.numbers.bits(Decision::jitter, 0) : 0;
    requests_.push_back({r.ray, r.kind, seed, &r.out->march, may_end_by_roulette});
  }
  void run(const compile::CompiledScene& world, ThreadContext& thread) {
    marcher_.march(world, requests_, thread);
    requests_.clear();
  }

 private:
  RayMarcher marcher_;
  std::vector<MarchRequest> requests_;
};

// A light, and how it is seen from a ray.
struct ChosenLight {
  std::uint32_t light = 0;
  std::optional<optics::Pivot> pivot;
  double probability = 0;
};
// By point[3], the pivot by point[0] and point[1]. Not where the ray is empty.
ChosenLight choose_light(const LitRay& ray, const SobolPoint& point);

// The pivot that would lead to the place of the light that was hit: that place on a flat light, the centre of
// a sphere.
std::optional<optics::Pivot> pivot_to(const compile::CompiledLight& light, const LightHit& hit);

// Begins the light of a ray whose march is known.
void begin_light(const compile::CompiledScene& world, const Rgb& throughput,
                 std::span<const ScatteringOrder> orders, MediumRay& ray);

// A place of a march, drawn by what is scattered there; for a number in [0, 1).
Scattering scatter_by_density(const LitRay& light, float u, double volume_probability);

}  // namespace tyndall::render
