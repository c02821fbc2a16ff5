// Which light is sampled: each with a known probability, by what it may bring to a part of a ray.
#pragma once

#include <cstdint>

#include "base/inline_vector.h"
#include "compile/compiled_scene.h"
#include "compile/lights/light_tree.h"
#include "render/lights/light_region.h"

namespace tyndall::render {

// For one part of a ray, or a point (t0 = t1). Few lights are weighed one by one, many by the scene's
// light tree, beside which those at infinity are weighed one by one. Where a region is known that a pilot
// looked at, parts of the tree are weighed instead by what was learned of them.
class LightSelection {
 public:
  // For [t0, t1] of the ray. Keeps references to the scene and the region, which may be null.
  LightSelection(const compile::CompiledScene& world, const compile::Ray& ray, double t0, double t1,
                 const LightRegion* region = nullptr);
  // Whether no light brings anything.
  bool empty() const { return !(total_ > 0); }
  // What all lights bring together, in the measure of their importances.
  double total() const { return total_; }
  // The light for u in [0, 1); rescales u to be used again. Not when empty.
  std::uint32_t sample(float& u) const;
  double probability(std::uint32_t light) const;

 private:
  // A part of the region whose weight is not fixed, of those that are counted.
  const LightRegion::Part& part(std::size_t near) const {
    return region_->parts[inside_ ? region_->near[near] : near];
  }
  std::uint32_t sample_below(std::uint32_t node, double rest, double weight, float& u) const;

  const compile::LightTree* tree_ = nullptr;  // null: few lights
  const LightRegion* region_ = nullptr;
  bool inside_ = false;  // of the region: some weights are fixed
  optics::RaySegment segment_;
  double tree_weight_ = 0, total_ = 0;  // the first without the region's parts that are near
  InlineVector<double, 16> near_;       // of these parts
  InlineVector<double, 16> weights_;    // of all lights, or of those that are in no tree
};

}  // namespace tyndall::render
