// Which light is sampled: each with a known probability, by what it may bring to a stretch of a ray.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.h"
#include "compile/light_tree.h"

namespace tyndall::render {

// For one stretch of a ray, or a point (t0 = t1). Few lights are weighed one by one, many by the scene's
// light tree, beside which those at infinity are weighed one by one.
class LightChoice {
 public:
  // Keeps a reference to the scene.
  void set(const compile::CompiledScene& world, const Vec3d& origin, const Vec3d& direction, double t0,
           double t1, double time);
  // Whether no light brings anything.
  bool empty() const { return !(total_ > 0); }
  // The light for u in [0, 1); rescales u to be used again. Not when empty.
  std::uint32_t sample(float& u) const;
  double probability(std::uint32_t light) const;

 private:
  const compile::LightTree* tree_ = nullptr;  // null: few lights
  optics::Stretch stretch_;
  double tree_weight_ = 0, total_ = 0;
  std::vector<double> weights_;  // of all lights, or of those that are in no tree
};

}  // namespace tyndall::render
