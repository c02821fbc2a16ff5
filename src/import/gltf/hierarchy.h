// The nodes of a glTF file: who stands below whom, and where each is. All throw Malformed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/transform.h"
#include "base/transform_mix.h"
#include "import/gltf/document.h"

namespace tyndall::gltf {

// How a node stands in its parent, and its mesh in its morph targets.
struct NodePose {
  Vec3d translation, scale{1, 1, 1};
  Quaternion rotation;
  std::optional<Transform> matrix;  // instead of the three
  std::vector<double> weights;      // empty: those of the mesh

  Transform parent_from_node() const;
};
Transform rotation_of(const Quaternion& unit);
// Of length 1; none where it is zero.
Quaternion normalized(const Quaternion& q);

// Four numbers of glTF, x y z w.
Quaternion quaternion_of(const double* xyzw);

class Hierarchy {
 public:
  // Refuses cycles, and nodes below several parents.
  explicit Hierarchy(Document& document);

  const std::vector<NodePose>& rest() const { return rest_; }
  // Where each node is in the file's space.
  std::vector<Transform> placed(const std::vector<NodePose>& poses) const;

  // The nodes of the scene that the file shows, parents first; or those of the node of this name and below.
  // Nothing, with the names that there are in `names`, when there is no such node.
  std::vector<std::uint32_t> shown() const;
  std::optional<std::vector<std::uint32_t>> below(const std::string& name) const;
  // The nodes' own names.
  std::vector<std::string> names() const;

 private:
  std::vector<std::uint32_t> with_descendants(std::vector<std::uint32_t> roots) const;

  Document& document_;
  std::vector<NodePose> rest_;
  std::vector<std::vector<std::uint32_t>> children_;
  std::vector<std::uint32_t> parent_, order_;  // parents first; a root's parent is none
};

}  // namespace tyndall::gltf
