// Light of many rays of one sample, summed as doubles: floats would stop growing.
#pragma once

#include <cstdint>
#include <span>

#include "base/vec.h"
#include "render/film/aov.h"
#include "render/lights/scattered_light.h"

namespace tyndall::render {

// Adds to radiances and, where they are recorded, to the outputs beside the picture and to the light by its
// scatterings, as often as the sample
// or the part of the picture changes; the last time by `finish`.
class LightSum {
 public:
  LightSum(std::span<Rgb> radiance, std::span<AovSample> aovs, std::span<ScatteredLight> scattered = {})
      : radiance_(radiance), aovs_(aovs), scattered_(scattered) {}

  void add(std::uint32_t sample, LightPart part, const Rgb& light) {
    if (sample != sample_ || part != part_) finish();
    sample_ = sample;
    part_ = part;
    sum_ += Vec3d(light);
  }
  void finish() {
    if (sum_ == Vec3d{}) return;
    radiance_[sample_] += Rgb(sum_);
    if (!aovs_.empty()) aovs_[sample_].add(part_, Rgb(sum_));
    if (!scattered_.empty()) scattered_[sample_].add(part_, Rgb(sum_));
    sum_ = {};
  }

 private:
  std::span<Rgb> radiance_;
  std::span<AovSample> aovs_;
  std::span<ScatteredLight> scattered_;
  std::uint32_t sample_ = 0;
  LightPart part_{};
  Vec3d sum_;
};

}  // namespace tyndall::render
