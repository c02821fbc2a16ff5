#include "render/lights/light_region.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "optics/light_sampling.h"

namespace tyndall::render {

namespace {

constexpr std::size_t most_parts = 16;
// For how many trials the prior counts.
constexpr double prior_trials = 1;
// No part weighs less, as a share of all, than this times its share of what the bounds promise.
constexpr double least_weight = 0.05;
// Parts farther than so many radii of the region weigh the same everywhere in it.
constexpr double far_in_radii = 4;
constexpr double margin_of_box = 0.5;      // of the box where that holds, in radii
constexpr std::size_t most_looked_at = 8;  // places for means of importances

}  // namespace

bool LightRegion::holds(const optics::RaySegment& segment) const {
  for (const double t : {segment.t0, segment.t1}) {
    if (!(t < infinity)) return false;
    const Vec3d x = segment.origin + segment.direction * t;
    for (std::size_t k = 0; k < 3; ++k)
      if (!(lo[k] <= x[k] && x[k] <= hi[k])) return false;
  }
  return true;
}

double LightRegion::weight(const compile::LightTree& tree, const Part& part,
                           const optics::RaySegment& segment) {
  if (!(part.intensity > 0 && segment.t1 < infinity)) return part.ratio * tree.importance(segment, part.node);
  return part.ratio * optics::nearest_irradiance(part.intensity, part.radius, part.center, segment);
}

const LightRegion::Part& LightRegion::part_of(std::uint32_t leaf) const {
  const auto after = std::upper_bound(parts.begin(), parts.end(), leaf,
                                      [](std::uint32_t l, const Part& p) { return l < p.first_leaf; });
  return *(after - 1);
}

const LightRegion::Part& LightRegion::fixed_part(double at) const {
  const auto after =
      std::upper_bound(parts.begin(), parts.end(), at, [](double x, const Part& p) { return x < p.before; });
  auto part = after - 1;
  while (part != parts.begin() && !(part->fixed > 0)) --part;
  return *part;
}

RegionLearner::Moments RegionLearner::Sums::after(const Moments& prior) const {
  const double all = prior_trials + count;
  return {(prior_trials * prior.mean + mean) / all, (prior_trials * prior.square + square) / all};
}

double RegionLearner::Candidate::worth() const {
  return importance * (std::sqrt(moments.square) - moments.mean);
}

// The ratio of a node to a trial of one of its lights is what the light brought, over the probability of the
// light within the node, over the node's importance.
void RegionLearner::add(const optics::RaySegment& place, const LightTrial& trial) {
  std::uint32_t node = tree_->leaf_of(trial.light);
  double importance = tree_->importance(place, node);
  double ratio = importance > 0 ? trial.brought / importance : 0;
  for (;;) {
    if (sums_[node].count == 0) touched_.push_back(node);
    sums_[node].add(ratio);
    if (node == 0) return;
    const std::uint32_t parent = tree_->parent(node), first = tree_->first_child(parent);
    const double both = importance + tree_->importance(place, node == first ? first + 1 : first);
    importance = tree_->importance(place, parent);
    ratio = importance > 0 ? ratio * both / importance : 0;
    node = parent;
  }
}

RegionLearner::Candidate RegionLearner::candidate(std::uint32_t node,
                                                  std::span<const optics::RaySegment> places) const {
  Candidate out{node, {}, 0};
  const std::size_t stride = (places.size() + most_looked_at - 1) / most_looked_at;
  std::size_t looked_at = 0;
  for (std::size_t i = 0; i < places.size(); i += stride, ++looked_at)
    out.importance += tree_->importance(places[i], node);
  out.importance /= static_cast<double>(looked_at);
  return out;
}

std::vector<RegionLearner::Candidate> RegionLearner::cut(std::span<const optics::RaySegment> places) const {
  // As much of a part is taken to be hidden, before trials are counted, as of the larger part that it is of:
  // a light is either seen or not.
  const auto hidden_or_not = [](double mean) { return Moments{std::min(mean, 1.0), std::min(mean, 1.0)}; };
  std::vector<Candidate> parts{candidate(0, places)};
  parts[0].moments = sums_[0].after({});
  while (parts.size() < most_parts) {
    std::size_t best = parts.size();
    double most = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (tree_->is_leaf(parts[i].node) || sums_[parts[i].node].count == 0) continue;
      if (const double worth = parts[i].worth(); worth > most) most = worth, best = i;
    }
    if (best == parts.size()) break;
    const Candidate divided = parts[best];
    const std::uint32_t first = tree_->first_child(divided.node);
    parts[best] = candidate(first, places);
    parts.push_back(candidate(first + 1, places));
    const double both = parts[best].importance + parts.back().importance;
    const bool reached = both > 0 && divided.importance > 0;
    const Moments prior =
        hidden_or_not(reached ? divided.moments.mean * divided.importance / both : divided.moments.mean);
    for (Candidate* child : {&parts[best], &parts.back()}) child->moments = sums_[child->node].after(prior);
  }
  return parts;
}

// Lights that shine to one side may reach a part of the region that no place was in, so their weights are not
// fixed.
LightRegion::Part RegionLearner::part(const Candidate& candidate, double least_ratio, const Vec3d& center,
                                      double radius) const {
  const optics::LightBounds& bounds = tree_->bounds(candidate.node);
  LightRegion::Part out{candidate.node, tree_->first_leaf(candidate.node),
                        std::sqrt(candidate.moments.square) + least_ratio};
  const double distance = length(bounds.center() - center) - length(bounds.hi - bounds.lo) / 2;
  if (bounds.theta_o + bounds.theta_e < pi) return out;
  out.center = bounds.center();
  out.radius = length(bounds.hi - bounds.lo) / 2;
  out.intensity = bounds.intensity;
  if (distance > far_in_radii * radius) out.fixed = out.ratio * candidate.importance;
  return out;
}

LightRegion RegionLearner::learn(std::span<const optics::RaySegment> places,
                                 std::span<const LightTrial> trials) {
  for (const std::uint32_t node : touched_) sums_[node] = {};
  touched_.clear();
  std::vector<Sums> others(tree_->others().size());
  for (const LightTrial& trial : trials) {
    if (trial.in_tree)
      add(places[trial.place], trial);
    else
      others[trial.light].add(trial.importance > 0 ? trial.brought / trial.importance : 0);
  }
  LightRegion out;
  out.lo = out.hi = places[0].origin;
  for (const optics::RaySegment& place : places)
    for (std::size_t k = 0; k < 3; ++k) {
      out.lo[k] = std::min(out.lo[k], place.origin[k]);
      out.hi[k] = std::max(out.hi[k], place.origin[k]);
    }
  const Vec3d center = (out.lo + out.hi) * 0.5;
  const double radius = length(out.hi - out.lo) / 2;
  const std::vector<Candidate> candidates = cut(places);
  double weight = 0, importance = 0;
  for (const Candidate& c : candidates)
    weight += c.importance * std::sqrt(c.moments.square), importance += c.importance;
  const double least = importance > 0 ? least_weight * weight / importance : least_weight;
  for (const Candidate& c : candidates) out.parts.push_back(part(c, least, center, radius));
  out.lo -= Vec3d(margin_of_box * radius);
  out.hi += Vec3d(margin_of_box * radius);
  std::sort(out.parts.begin(), out.parts.end(), [](const LightRegion::Part& a, const LightRegion::Part& b) {
    return a.first_leaf < b.first_leaf;
  });
  for (std::uint32_t i = 0; i < out.parts.size(); ++i) {
    out.parts[i].before = out.fixed;
    out.fixed += out.parts[i].fixed;
    if (!(out.parts[i].fixed > 0)) out.near.push_back(i);
  }
  for (const Sums& sums : others) out.others.push_back(std::sqrt(sums.after({}).square));
  return out;
}

}  // namespace tyndall::render
