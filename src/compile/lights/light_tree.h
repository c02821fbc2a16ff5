// Chooses among many lights: a binary tree over those that have a place, walked from its root by what each
// side may bring to a segment of a ray. Every light's probability is known exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compile/lights/compiled_light.h"
#include "optics/light_bounds.h"

namespace tyndall::compile {

class LightTree {
 public:
  // `left_out`: lights that are chosen in another way.
  explicit LightTree(std::span<const CompiledLight> lights, const std::vector<bool>& left_out = {});

  // Lights at infinity and those left out, which are in no tree; in order.
  std::span<const std::uint32_t> others() const { return others_; }
  bool holds(std::uint32_t light) const { return leaf_of_light_[light] != no_leaf; }
  // What the tree's lights together may bring to the segment; 0: nothing.
  double importance(const optics::RaySegment& interval) const;

  struct Chosen {
    std::uint32_t light = 0;
    double probability = 0;
  };
  // The light for u in [0, 1), which is rescaled to be used again. The tree must hold lights.
  Chosen sample(const optics::RaySegment& interval, double& u) const;
  // Probability with which `sample` chooses the light; 0 for lights that are in no tree.
  double probability(const optics::RaySegment& interval, std::uint32_t light) const;

  // Nodes, for choices that begin further down: the root is 0, the children of an inner one stand next to
  // each other, and its lights are those of the leaves [first_leaf, end_leaf), counted from the left.
  bool is_leaf(std::uint32_t node) const { return nodes_[node].first_child == 0; }
  std::uint32_t first_child(std::uint32_t node) const { return nodes_[node].first_child; }
  std::uint32_t parent(std::uint32_t node) const { return nodes_[node].parent; }
  std::uint32_t first_leaf(std::uint32_t node) const { return nodes_[node].first_leaf; }
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(nodes_.size()); }
  const optics::LightBounds& bounds(std::uint32_t node) const { return nodes_[node].bounds; }
  std::uint32_t leaf_of(std::uint32_t light) const { return leaf_of_light_[light]; }
  // The same of the lights below a node alone.
  double importance(const optics::RaySegment& interval, std::uint32_t node) const {
    return optics::importance(nodes_[node].bounds, interval);
  }
  Chosen sample(const optics::RaySegment& interval, double& u, std::uint32_t node) const;
  double probability(const optics::RaySegment& interval, std::uint32_t light, std::uint32_t node) const;

 private:
  static constexpr std::uint32_t no_leaf = 0xffffffffu;
  // Children are next to each other; a leaf has none.
  struct Node {
    optics::LightBounds bounds;
    std::uint32_t first_child = 0, parent = 0;
    std::uint32_t light = 0;       // of a leaf
    std::uint32_t first_leaf = 0;  // below it, or itself
  };
  struct Item {
    optics::LightBounds bounds;
    std::uint32_t light;
  };
  void build(std::uint32_t node, std::span<Item> items, std::uint32_t first_leaf);
  // Probability of going to the first child.
  double share_of_first(const Node& node, const optics::RaySegment& interval) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_light_;  // or no_leaf
  std::vector<std::uint32_t> others_;
};

}  // namespace tyndall::compile
