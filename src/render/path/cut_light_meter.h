// Measures the light that `bounces` leaves out (cut_light.h), over the paths of one call of the path tracer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/context/cut_light.h"
#include "render/context/statistics.h"
#include "render/path/path_settings.h"
#include "render/path/path_state.h"
#include "render/surface/transparent_hits.h"

namespace tyndall::render {

class CutLightMeter {
 public:
  // Keeps references; `radiance` is that of the samples, as it grows.
  CutLightMeter(const PathSettings& settings, std::span<const Rgb> radiance);

  // A camera sample begins.
  void note_start() {
    if (late_ + rays_after_bounces_ == 0) sums_.from += Vec3d(1, 1, 1);
  }
  // A ray of the path is about to be traced: its sample's light so far is early, if its late bounces begin here. All
  // paths of a sample are equally far.
  void note_ray(const PathSlot& path);
  // The ray gathered what it meets by itself, which its bounce could have sampled.
  void note_gathered(const PathSlot& path, const Rgb& radiance_before);
  // The throughput where the late bounces begin and where they are cut. A ray that is traced after a bounce meets light
  // that the bounce could have sampled: with such rays both are one bounce later.
  void note_carried(const PathSlot& path, const HitSurfaces& surfaces, Statistics& statistics);
  // All paths have ended.
  void finish(Statistics& statistics);

 private:
  const PathSettings& settings_;
  std::span<const Rgb> radiance_;
  std::uint32_t late_, rays_after_bounces_;
  std::vector<std::optional<Rgb>> early_;  // light of samples before their late bounces, of those that get there
  CutLight sums_;
};

}  // namespace tyndall::render
