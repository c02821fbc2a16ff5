// The distance along a marched ray at which one light is taken: the strategies of `--distance` in one
// mixture, divided by the sum of their densities.
#pragma once

#include <optional>

#include "compile/compiled_scene.h"
#include "optics/light_sampling.h"
#include "render/equiangular.h"
#include "render/march.h"
#include "render/product.h"
#include "render/render.h"

namespace tyndall::render {

struct Worker;

// Appends the parts of the ray that scatter and that the light reaches, in order.
void reached_stretches(const optics::Light& light, const optics::Pivot& pivot, const March& march,
                       std::vector<Intervald>& out);

// The segment from which most is scattered, whose phase functions stand for those of all.
std::uint32_t brightest_segment(const March& march);

class DistanceMixture {
 public:
  // For a light that is to be aimed at through `pivot` (none for lights without a place). `phase`, that of a
  // typical segment, is asked for by the product alone. Uses the worker's scratch: holds until the next one
  // is made.
  DistanceMixture(const optics::Light& light, const March& march, const DensityDistribution& density,
                  const Rgb& throughput, Distance distance, const std::optional<optics::Pivot>& pivot,
                  const PhaseMixture& phase, Worker& worker);
  DistanceMixture(const DistanceMixture&) = delete;

  bool available() const { return toward_light_ > 0 || density_.available(); }
  // The distance for three numbers in [0, 1): which strategy, and two for it.
  MarchPlace sample(float u_strategy, float u_channel, float u) const;
  // Per metre.
  double pdf(const MarchPlace& at) const;

 private:
  const March& march_;
  const DensityDistribution& density_;
  const std::vector<Intervald>& stretches_;  // that scatter and that the light reaches
  std::optional<Equiangular> equiangular_;
  const Product* product_ = nullptr;
  double toward_light_ = 0;  // probability of the strategy that knows the light
};

}  // namespace tyndall::render
