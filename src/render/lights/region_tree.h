// Space divided into boxes that have about as many of some points each: a k-d tree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/interval.h"
#include "base/vec.h"

namespace tyndall::render {

// Boxes reach without end where nothing is beside them.
class RegionTree {
 public:
  // Halves boxes with more than `most` points, along their longest side.
  RegionTree(std::span<const Vec3d> points, std::size_t most);

  std::uint32_t region_count() const { return static_cast<std::uint32_t>(first_.size() - 1); }
  // The points of a region, as indices.
  std::span<const std::uint32_t> points_of(std::uint32_t region) const {
    return std::span(order_).subspan(first_[region], first_[region + 1] - first_[region]);
  }
  std::uint32_t region_at(const Vec3d& x) const;
  // Calls visit(region, part) for the parts of a ray's interval in each region, in order.
  template <class Visit>
  void walk(const Vec3d& origin, const Vec3d& direction, const Intervald& t, Visit&& visit) const {
    walk_node(0, origin, direction, t, visit);
  }

 private:
  struct Node {
    double split = 0;
    std::uint32_t next = 0;  // the first of two children that stand next to each other, or a leaf's region
    std::uint8_t axis = leaf;
  };
  static constexpr std::uint8_t leaf = 3;
  void divide(std::uint32_t node, std::span<const Vec3d> points, std::span<std::uint32_t> members,
              std::size_t most);

  template <class Visit>
  void walk_node(std::uint32_t index, const Vec3d& origin, const Vec3d& direction, const Intervald& t,
                 Visit& visit) const {
    const Node& node = nodes_[index];
    if (node.axis == leaf) {
      visit(node.next, t);
      return;
    }
    const double from = origin[node.axis], along = direction[node.axis];
    const double crossing = (node.split - from) / along;  // infinite or NaN beside the plane
    const bool starts_above = along != 0 && crossing > t.lo ? along < 0 : from + t.lo * along >= node.split;
    const std::uint32_t near = node.next + (starts_above ? 1 : 0), far = node.next + (starts_above ? 0 : 1);
    if (!(along != 0 && t.lo < crossing && crossing < t.hi)) {
      walk_node(near, origin, direction, t, visit);
      return;
    }
    walk_node(near, origin, direction, {t.lo, crossing}, visit);
    walk_node(far, origin, direction, {crossing, t.hi}, visit);
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  // of the points, region after region
  std::vector<std::size_t> first_;    // of each region in it, and the end
};

}  // namespace tyndall::render
