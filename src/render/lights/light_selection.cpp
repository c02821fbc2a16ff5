#include "render/lights/light_selection.h"

#include <algorithm>

#include "base/numerics.h"
#include "optics/light_sampling.h"

namespace tyndall::render {

LightSelection::LightSelection(const compile::CompiledScene& world, const compile::Ray& ray, double t0,
                               double t1, const LightRegion* region)
    : tree_(world.light_tree.get()), region_(region), segment_{ray.origin, ray.direction, t0, t1} {
  if (region_) {
    inside_ = region_->holds(segment_);
    total_ = tree_weight_ = inside_ ? region_->fixed : 0;
    const std::size_t count = inside_ ? region_->near.size() : region_->parts.size();
    for (std::size_t i = 0; i < count; ++i) {
      near_.push_back(LightRegion::weight(*tree_, part(i), segment_));
      total_ += near_[i];
    }
  } else {
    total_ = tree_weight_ = tree_ ? tree_->importance(segment_) : 0;
  }
  const std::size_t count = tree_ ? tree_->others().size() : world.lights.size();
  for (std::size_t i = 0; i < count; ++i) {
    const compile::LightAt light(world, tree_ ? tree_->others()[i] : static_cast<std::uint32_t>(i), ray.time);
    weights_.push_back(light->importance(segment_) * (region_ ? region_->others[i] : 1));
    total_ += weights_[i];
  }
}

std::uint32_t LightSelection::sample_below(std::uint32_t node, double rest, double weight, float& u) const {
  double u_tree = std::min(rest / weight, one_minus_ulp);
  const std::uint32_t light = tree_->sample(segment_, u_tree, node).light;
  u = std::min(static_cast<float>(u_tree), one_minus_ulp_f);
  return light;
}

std::uint32_t LightSelection::sample(float& u) const {
  double rest = u * total_;
  if (rest < tree_weight_) {
    if (!region_) return sample_below(0, rest, tree_weight_, u);
    const LightRegion::Part& of = region_->fixed_part(rest);
    return sample_below(of.node, rest - of.before, of.fixed, u);
  }
  rest -= tree_weight_;
  // The part or the light that holds it, or the last one that weighs anything.
  const std::size_t parts = near_.size(), count = parts + weights_.size();
  const auto weight = [&](std::size_t i) { return i < parts ? near_[i] : weights_[i - parts]; };
  std::size_t last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (weight(i) <= 0) continue;
    last = i;
    if (rest < weight(i)) break;
    rest -= weight(i);
  }
  if (last < parts) return sample_below(part(last).node, std::max(rest, 0.0), weight(last), u);
  u = std::min(static_cast<float>(std::max(rest, 0.0) / weight(last)), one_minus_ulp_f);
  last -= parts;
  return tree_ ? tree_->others()[last] : static_cast<std::uint32_t>(last);
}

double LightSelection::probability(std::uint32_t light) const {
  if (!tree_) return weights_[light] / total_;
  if (!tree_->holds(light)) {
    const auto at = std::lower_bound(tree_->others().begin(), tree_->others().end(), light);
    return weights_[static_cast<std::size_t>(at - tree_->others().begin())] / total_;
  }
  if (!region_) return tree_weight_ / total_ * tree_->probability(segment_, light);
  const LightRegion::Part& of = region_->part_of(tree_->first_leaf(tree_->leaf_of(light)));
  const double weight = inside_ && of.fixed > 0 ? of.fixed : LightRegion::weight(*tree_, of, segment_);
  return weight / total_ * tree_->probability(segment_, light, of.node);
}

}  // namespace tyndall::render
