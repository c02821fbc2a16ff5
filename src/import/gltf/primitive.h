// Primitives of meshes: the triangles that they draw, with morph targets and skins applied, and their lines.
// All throw Malformed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "import/gltf/document.h"
#include "scene/scene.h"

namespace tyndall::gltf {

// What a primitive's points are moved by before its node moves them all.
struct Deformation {
  std::vector<double> weights;    // of morph targets; those beyond them count 0
  std::vector<Transform> joints;  // where each joint of the skin takes points to; empty: no skin
};

// What the material of a primitive reads of its points.
struct PointNeeds {
  bool tangents = false;
  std::uint32_t second_uvs = 0;  // the set of texture coordinates beside the first; 0: none
};

// What a primitive's corners make.
enum class Drawn : std::uint8_t { points, lines, triangles };
Drawn drawn_by(const Element& primitive);

// A primitive as it is stored, to be posed as often as is wanted.
class Primitive {
 public:
  // Nothing where no triangle or line is drawn.
  static std::optional<Primitive> read(Document& document, const Element& primitive, const PointNeeds& needs);

  // As it is stored.
  scene::TriangleMesh undeformed() &&;
  // As a deformation leaves it. The first one decides which way triangles turn.
  scene::TriangleMesh mesh(const Deformation& deformation);
  scene::MeshPose pose(const Deformation& deformation);
  // The points of each line.
  std::vector<std::array<Vec3d, 2>> lines(const Deformation& deformation);

 private:
  struct Influences {
    std::vector<std::uint32_t> joints;  // four a point
    std::vector<float> weights;
  };
  Primitive(Document& document, const Element& primitive) : document_(&document), primitive_(primitive) {}
  const std::vector<Vec3d>& offsets(std::size_t target, const char* name, std::size_t count);
  void morph(const std::vector<double>& weights, scene::TriangleMesh& mesh);
  std::vector<Transform> blends(const std::vector<Transform>& joints) const;
  void skin(const std::vector<Transform>& joints, scene::TriangleMesh& mesh);
  scene::TriangleMesh deformed(const Deformation& deformation);

  Document* document_;
  Element primitive_;
  PointNeeds needs_;
  scene::TriangleMesh rest_;
  std::vector<std::uint32_t> corners_;  // of lines
  std::vector<Influences> influences_;
  std::map<std::pair<std::size_t, std::string>, std::vector<Vec3d>> offsets_;  // of morph targets
  std::optional<bool> turned_;  // whether the deformation turns triangles inside out
};

}  // namespace tyndall::gltf
