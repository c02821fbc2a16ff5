// What one path keeps from ray to ray.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/sampler.h"
#include "compile/compiled_scene.h"
#include "render/context/sample_dimensions.h"
#include "render/film/aov.h"
#include "render/method/medium_ray.h"
#include "render/surface/transparent_hits.h"

namespace tyndall::render {

// Where a ray comes from, as far as the MIS weight of what it meets needs to know.
struct PathOrigin {
  // delta: a mirror or smooth glass, for which light is not sampled.
  enum class Kind : std::uint8_t { camera, volume, surface, delta } kind = Kind::camera;
  Vec3d position;
  double pdf = 0;                 // volume: per metre and steradian; surface: per steradian
  double direction_pdf = 0;       // of both, per steradian, once the place is there
  LightShares shares;             // of the light that counts where the ray before ended
  const LitRay* light = nullptr;  // volume: of the ray that was scattered
  std::uint32_t segment = 0;
  double t = 0;
  const LightRegion* region = nullptr;  // surface: that its lights were chosen by
};

// A ray to be traced, with all that was decided before it.
struct PathState {
  compile::Ray ray;
  Rgb throughput{1};
  // Product of the squared relative indices of the boundaries passed: radiance in glass is larger by it,
  // which roulette must not take for throughput.
  float index_scale = 1;
  std::uint32_t depth = 0;              // scatterings so far
  std::uint32_t media_scatterings = 0;  // of them in media
  std::uint32_t branch = 0;             // sample_dimensions.h
  // Of the light that lights bring to media along this ray, and lamps to the surface it ends at: the rest is
  // left to rays that are sent for it (distant_light_guiding.h, lamp_guiding.h).
  LightShares shares;
  bool first_in_volume = false;  // the first scattering was in a medium
  PathOrigin origin;

  bool is_guided() const { return (branch & (guided_branch | lamp_branch)) != 0; }
  // Of direct light on surfaces: distant lights are left to other rays in media alone.
  LightShares surface_shares() const { return is_guided() ? shares : LightShares{1, shares.lamps, 1}; }
  bool is_sent_to_lamp() const { return (branch & lamp_branch) != 0; }
  // The part of the picture that light belongs to which arrives here after being scattered so often.
  LightPart part(std::uint32_t scatterings) const {
    if (!first_in_volume)
      return scatterings == 0 ? LightPart::seen : scatterings == 1 ? LightPart::direct : LightPart::indirect;
    return scatterings == 1 ? LightPart::volume_direct : LightPart::volume_indirect;
  }
  // Of direct light along the ray in media, and of light scattered more often that is approximated there.
  LightPart direct_part() const { return depth == 0 ? LightPart::volume_direct : part(depth + 1); }
  LightPart higher_part() const { return depth == 0 ? LightPart::volume_indirect : part(depth + 2); }
};

// A path on its way. Slots are reused, with the memory of their marches.
struct PathSlot {
  PathState state;
  std::uint32_t sample = 0;  // the caller's number of the camera sample
  std::optional<Sampler> sampler;
  std::optional<compile::SurfaceHit> hit;  // of the current ray, its end
  std::vector<Crossing> crossings;         // surfaces that it goes through before
  // Of the current ray and of the one before, which weights what the current one meets.
  MediumRay rays[2];
  std::uint32_t current = 0;

  MediumRay& ray() { return rays[current]; }
  const MediumRay& ray() const { return rays[current]; }
  March& march() { return ray().march; }
  const March& march() const { return ray().march; }
  PathNumbers numbers(const PathState& s) const { return {&*sampler, s.depth, s.branch}; }
  // The ray before keeps what MIS asks it for, and no outputs of media.
  void next_ray() {
    march().outputs.reset();
    current ^= 1;
  }
  // The path has ended.
  void release() {
    for (MediumRay& ray : rays) ray.march.outputs.reset();
  }
};

}  // namespace tyndall::render
