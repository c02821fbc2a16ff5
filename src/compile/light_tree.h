// Chooses among many lights: a binary tree over those that have a place, walked from its root by what each
// side may bring to a stretch of a ray. Every light's probability is known exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "optics/light_bounds.h"

namespace tyndall::compile {

class LightTree {
 public:
  // `left_out`: lights that are chosen in another way.
  explicit LightTree(std::span<const optics::Light> lights, const std::vector<bool>& left_out = {});

  // Lights at infinity and those left out, which are in no tree; in order.
  std::span<const std::uint32_t> others() const { return others_; }
  bool holds(std::uint32_t light) const { return leaf_of_light_[light] != no_leaf; }
  // What the tree's lights together may bring to the stretch; 0: nothing.
  double importance(const optics::Stretch& stretch) const;

  struct Chosen {
    std::uint32_t light = 0;
    double probability = 0;
  };
  // The light for u in [0, 1), which is rescaled to be used again. The tree must hold lights.
  Chosen sample(const optics::Stretch& stretch, double& u) const;
  // Probability with which `sample` chooses the light; 0 for lights that are in no tree.
  double probability(const optics::Stretch& stretch, std::uint32_t light) const;

 private:
  static constexpr std::uint32_t no_leaf = 0xffffffffu;
  // Children are next to each other; a leaf has none.
  struct Node {
    optics::LightBounds bounds;
    std::uint32_t first_child = 0, parent = 0;
    std::uint32_t light = 0;  // of a leaf
  };
  struct Item {
    optics::LightBounds bounds;
    std::uint32_t light;
  };
  void build(std::uint32_t node, std::span<Item> items);
  // Probability of going to the first child.
  double share_of_first(const Node& node, const optics::Stretch& stretch) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_light_;  // or no_leaf
  std::vector<std::uint32_t> others_;
};

}  // namespace tyndall::compile
