#include "compile/lights/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/numerics.h"

namespace tyndall::compile {

namespace {

// The measure of the directions into which the bounds shine (Conty Estevez and Kulla 2018, equation 1).
double orientation_measure(const optics::LightBounds& b) {
  const double o = b.theta_o, w = std::min(o + b.theta_e, pi);
  return 2 * pi * (1 - std::cos(o)) +
         pi / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
}

// By the square of the box's diagonal, not its surface: a row of lamps has next to no surface, but what is
// known of it at a place beside it is as little as of a square of that length.
double cost(const optics::LightBounds& b) {
  return b.intensity * orientation_measure(b) * length_squared(b.hi - b.lo);
}

}  // namespace

LightTree::LightTree(std::span<const CompiledLight> lights, const std::vector<bool>& left_out)
    : leaf_of_light_(lights.size(), no_leaf) {
  std::vector<Item> items;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const bool out = i < left_out.size() && left_out[i];
    if (const auto bounds = out ? std::nullopt : lights[i].bounds())
      items.push_back({*bounds, i});
    else
      others_.push_back(i);
  }
  if (items.empty()) return;
  nodes_.reserve(2 * items.size());
  nodes_.emplace_back();
  build(0, items, 0);
}

// Parts the items where the costs of both sides together are least, over planes between twelve buckets along
// each axis; where all stand at one place, in the middle of the list.
void LightTree::build(std::uint32_t node, std::span<Item> items, std::uint32_t first_leaf) {
  optics::LightBounds all = items[0].bounds;
  Vec3d lo = all.center(), hi = lo;
  for (const Item& item : items) {
    if (&item != &items[0]) all = optics::united(all, item.bounds);
    const Vec3d c = item.bounds.center();
    for (std::size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], c[k]), hi[k] = std::max(hi[k], c[k]);
  }
  nodes_[node].bounds = all;
  nodes_[node].first_leaf = first_leaf;
  if (items.size() == 1) {
    nodes_[node].light = items[0].light;
    leaf_of_light_[items[0].light] = node;
    return;
  }
  constexpr std::size_t buckets = 12;
  std::size_t best_axis = 0, best_bucket = 0;
  double best_cost = infinity;
  const auto bucket_of = [&](const Item& item, std::size_t axis) {
    const double part = (item.bounds.center()[axis] - lo[axis]) / (hi[axis] - lo[axis]);
    return std::min(static_cast<std::size_t>(part * buckets), buckets - 1);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(hi[axis] > lo[axis])) continue;
    std::array<std::optional<optics::LightBounds>, buckets> sums;
    for (const Item& item : items) {
      auto& sum = sums[bucket_of(item, axis)];
      sum = sum ? optics::united(*sum, item.bounds) : item.bounds;
    }
    const auto united = [&](std::size_t from, std::size_t to) {
      std::optional<optics::LightBounds> side;
      for (std::size_t b = from; b < to; ++b)
        if (sums[b]) side = side ? optics::united(*side, *sums[b]) : sums[b];
      return side;
    };
    for (std::size_t b = 1; b < buckets; ++b) {
      const auto left = united(0, b), right = united(b, buckets);
      if (!left || !right) continue;
      const double here = cost(*left) + cost(*right);
      if (here < best_cost) best_cost = here, best_axis = axis, best_bucket = b;
    }
  }
  std::size_t middle = items.size() / 2;
  if (best_cost < infinity) {
    const auto right = std::stable_partition(items.begin(), items.end(), [&](const Item& item) {
      return bucket_of(item, best_axis) < best_bucket;
    });
    middle = static_cast<std::size_t>(right - items.begin());
  }
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first_child = first;
  nodes_.resize(nodes_.size() + 2);
  nodes_[first].parent = nodes_[first + 1].parent = node;
  build(first, items.first(middle), first_leaf);
  build(first + 1, items.subspan(middle), first_leaf + static_cast<std::uint32_t>(middle));
}

double LightTree::importance(const optics::RaySegment& interval) const {
  return nodes_.empty() ? 0.0 : optics::importance(nodes_[0].bounds, interval);
}

double LightTree::share_of_first(const Node& node, const optics::RaySegment& interval) const {
  const double first = optics::importance(nodes_[node.first_child].bounds, interval),
               second = optics::importance(nodes_[node.first_child + 1].bounds, interval);
  return first + second > 0 ? first / (first + second) : 0.5;
}

LightTree::Chosen LightTree::sample(const optics::RaySegment& interval, double& u) const {
  return sample(interval, u, 0);
}

LightTree::Chosen LightTree::sample(const optics::RaySegment& interval, double& u, std::uint32_t node) const {
  double probability = 1;
  while (nodes_[node].first_child != 0) {
    const double share = share_of_first(nodes_[node], interval);
    const bool first = u < share;
    u = first ? u / share : (u - share) / (1 - share);
    u = std::min(u, one_minus_ulp);
    probability *= first ? share : 1 - share;
    node = nodes_[node].first_child + (first ? 0 : 1);
  }
  return {nodes_[node].light, probability};
}

double LightTree::probability(const optics::RaySegment& interval, std::uint32_t light) const {
  return holds(light) ? probability(interval, light, 0) : 0;
}

double LightTree::probability(const optics::RaySegment& interval, std::uint32_t light,
                              std::uint32_t top) const {
  double probability = 1;
  for (std::uint32_t node = leaf_of_light_[light]; node != top;) {
    const Node& parent = nodes_[nodes_[node].parent];
    const double share = share_of_first(parent, interval);
    probability *= node == parent.first_child ? share : 1 - share;
    node = nodes_[node].parent;
  }
  return probability;
}

}  // namespace tyndall::compile
