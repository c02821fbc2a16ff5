#include "render/light_choice.h"

#include <algorithm>

#include "base/numerics.h"
#include "optics/light_sampling.h"

namespace tyndall::render {

void LightChoice::set(const compile::CompiledScene& world, const Vec3d& origin, const Vec3d& direction,
                      double t0, double t1, double time) {
  tree_ = world.light_tree.get();
  stretch_ = {origin, direction, t0, t1};
  total_ = tree_weight_ = tree_ ? tree_->importance(stretch_) : 0;
  weights_.resize(tree_ ? tree_->others().size() : world.lights.size());
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const compile::LightAt light(world, tree_ ? tree_->others()[i] : static_cast<std::uint32_t>(i), time);
    weights_[i] = optics::importance(*light, origin, direction, t0, t1);
    total_ += weights_[i];
  }
}

std::uint32_t LightChoice::sample(float& u) const {
  double rest = u * total_;
  if (rest < tree_weight_) {
    double u_tree = std::min(rest / tree_weight_, one_minus_ulp);
    const std::uint32_t light = tree_->sample(stretch_, u_tree).light;
    u = std::min(static_cast<float>(u_tree), one_minus_ulp_f);
    return light;
  }
  rest -= tree_weight_;
  std::size_t i = 0, last = 0;
  for (; i < weights_.size(); ++i) {
    if (weights_[i] <= 0) continue;
    last = i;
    if (rest < weights_[i]) break;
    rest -= weights_[i];
  }
  u = std::min(static_cast<float>(std::max(rest, 0.0) / weights_[last]), one_minus_ulp_f);
  return tree_ ? tree_->others()[last] : static_cast<std::uint32_t>(last);
}

double LightChoice::probability(std::uint32_t light) const {
  if (!tree_) return weights_[light] / total_;
  if (tree_->holds(light)) return tree_weight_ / total_ * tree_->probability(stretch_, light);
  const auto at = std::lower_bound(tree_->others().begin(), tree_->others().end(), light);
  return weights_[static_cast<std::size_t>(at - tree_->others().begin())] / total_;
}

}  // namespace tyndall::render
