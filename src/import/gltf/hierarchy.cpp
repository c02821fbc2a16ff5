#include "import/gltf/hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "import/malformed.h"

namespace tyndall::gltf {

namespace {

constexpr std::uint32_t none = 0xffffffffu;

NodePose rest_of(const Element& node) {
  NodePose pose;
  if (const auto matrix = node.find("matrix")) {
    const auto m = matrix->numbers<16>();  // by columns
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
      matrix->fail("is not affine: its last row is not 0 0 0 1");
    pose.matrix =
        Transform{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  }
  pose.translation = node.vec("translation", {});
  pose.scale = node.vec("scale", {1, 1, 1});
  if (const auto rotation = node.find("rotation")) {
    pose.rotation = quaternion_of(rotation->numbers<4>().data());
    const Quaternion& q = pose.rotation;
    if (!(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z > 0))
      rotation->fail("is no rotation: all of it is 0");
    pose.rotation = normalized(q);
  }
  if (const auto weights = node.find("weights"))
    for (std::size_t i = 0; i < weights->size(); ++i) pose.weights.push_back(weights->at(i).number());
  return pose;
}

}  // namespace

Quaternion quaternion_of(const double* xyzw) { return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]}; }

Quaternion normalized(const Quaternion& q) {
  const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(size > 0)) return {};
  return {q.w / size, q.x / size, q.y / size, q.z / size};
}

Transform rotation_of(const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
          {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
          {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
          {}};
}

Transform NodePose::parent_from_node() const {
  if (matrix) return *matrix;
  return Transform::translate(translation) * rotation_of(rotation) * Transform::scale(scale);
}

Hierarchy::Hierarchy(Document& document) : document_(document) {
  const std::size_t count = document.count("nodes");
  children_.resize(count);
  parent_.assign(count, none);
  rest_.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Element node = document.item("nodes", i);
    rest_.push_back(rest_of(node));
    const auto children = node.find("children");
    for (std::size_t k = 0; children && k < children->size(); ++k) {
      const Element child = children->at(k);
      const std::uint32_t index = child.index(count, "nodes");
      if (parent_[index] != none)
        child.fail(fmt::format("is {}, which is a child of nodes[{}] already", index, parent_[index]));
      parent_[index] = i;
      children_[i].push_back(index);
    }
  }
  std::vector<std::uint32_t> roots;
  for (std::uint32_t i = 0; i < count; ++i)
    if (parent_[i] == none) roots.push_back(i);
  order_ = with_descendants(roots);
  if (order_.size() == count) return;
  // Who has a parent but is below no root is in a cycle or below one.
  std::vector<bool> met(count, false);
  for (const std::uint32_t i : order_) met[i] = true;
  const auto lost = static_cast<std::size_t>(std::find(met.begin(), met.end(), false) - met.begin());
  document.item("nodes", lost).fail("is below itself: its children lead back to it");
}

std::vector<std::uint32_t> Hierarchy::with_descendants(std::vector<std::uint32_t> roots) const {
  // Each has one parent, so the list grows to all nodes at most.
  for (std::size_t i = 0; i < roots.size(); ++i)
    for (const std::uint32_t child : children_[roots[i]]) roots.push_back(child);
  return roots;
}

std::vector<Transform> Hierarchy::placed(const std::vector<NodePose>& poses) const {
  std::vector<Transform> out(poses.size());
  for (const std::uint32_t i : order_) {
    const Transform local = poses[i].parent_from_node();
    out[i] = parent_[i] == none ? local : out[parent_[i]] * local;
  }
  return out;
}

std::vector<std::uint32_t> Hierarchy::shown() const {
  if (document_.count("scenes") == 0) return order_;
  const std::uint32_t scene = document_.index(document_.root(), "scene", "scenes").value_or(0);
  const auto list = document_.item("scenes", scene).find("nodes");
  std::vector<std::uint32_t> roots;
  std::vector<bool> listed(children_.size(), false);
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const std::uint32_t root = list->at(i).index(children_.size(), "nodes");
    if (parent_[root] != none) list->at(i).fail(fmt::format("is {}, which is no root", root));
    if (!listed[root]) roots.push_back(root);
    listed[root] = true;
  }
  return with_descendants(std::move(roots));
}

std::optional<std::vector<std::uint32_t>> Hierarchy::below(const std::string& name) const {
  std::optional<std::uint32_t> found;
  for (std::uint32_t i = 0; i < children_.size(); ++i) {
    if (document_.item("nodes", i).text("name") != name) continue;
    if (found)
      document_.warn(
          fmt::format("has several nodes called '{}': the first is taken, nodes[{}]", name, *found));
    else
      found = i;
  }
  if (!found) return std::nullopt;
  return with_descendants({*found});
}

std::vector<std::string> Hierarchy::names() const {
  std::vector<std::string> out;
  for (std::uint32_t i = 0; i < children_.size(); ++i)
    if (std::string name = document_.item("nodes", i).text("name"); !name.empty())
      out.push_back(std::move(name));
  return out;
}

}  // namespace tyndall::gltf
