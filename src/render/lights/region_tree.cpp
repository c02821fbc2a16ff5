#include "render/lights/region_tree.h"

#include <algorithm>
#include <numeric>

#include "base/numerics.h"

namespace tyndall::render {

RegionTree::RegionTree(std::span<const Vec3d> points, std::size_t most) : order_(points.size()), first_{0} {
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.emplace_back();
  divide(0, points, order_, most);
}

void RegionTree::divide(std::uint32_t node, std::span<const Vec3d> points, std::span<std::uint32_t> members,
                        std::size_t most) {
  Vec3d lo(infinity), hi(-infinity);
  for (const std::uint32_t i : members)
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], points[i][k]);
      hi[k] = std::max(hi[k], points[i][k]);
    }
  const Vec3d size = hi - lo;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto end_here = [&] {
    nodes_[node].next = region_count();
    first_.push_back(first_.back() + members.size());
  };
  if (members.size() <= most || !(size[axis] > 0)) return end_here();
  // Of equal places the earlier point: no order of the standard library's own.
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
  };
  std::sort(members.begin(), members.end(), less);
  const double split = points[members[members.size() / 2]][axis];
  const auto second = std::partition_point(members.begin(), members.end(),
                                           [&](std::uint32_t i) { return points[i][axis] < split; });
  const auto below = static_cast<std::size_t>(second - members.begin());
  if (below == 0) return end_here();
  const auto first_child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node] = {split, first_child, static_cast<std::uint8_t>(axis)};
  nodes_.resize(nodes_.size() + 2);
  divide(first_child, points, members.first(below), most);
  divide(first_child + 1, points, members.subspan(below), most);
}

std::uint32_t RegionTree::region_at(const Vec3d& x) const {
  const Node* node = nodes_.data();
  while (node->axis != leaf) node = &nodes_[node->next + (x[node->axis] < node->split ? 0 : 1)];
  return node->next;
}

}  // namespace tyndall::render
