// A glTF file as parts of a scene: where its meshes, lights and cameras stand at a time. What throws, throws
// Malformed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "import/gltf/animation.h"
#include "import/gltf/document.h"
#include "import/gltf/hierarchy.h"
#include "import/gltf/primitive.h"
#include "import/pbr/material.h"
#include "import/pbr/textures.h"
#include "scene/lights.h"
#include "scene/scene.h"

namespace tyndall::gltf {

// Which animation plays, and where it is at the scene's time.
struct Play {
  std::optional<std::string> animation;  // not given: the first of the file; empty: none
  double seconds = 0;                    // since it began, at its speed
  bool loop = true;
  double span = 0;  // what of it goes by while the shutter is open [s]

  Play later(double fraction) const { return {animation, seconds + fraction * span, loop, 0}; }
};

// A primitive of a mesh; those that are not posed are the same wherever they stand.
struct MeshSource {
  std::uint32_t mesh = 0, primitive = 0, node = 0;
  bool posed = false;  // by a skin or morph targets
};
struct Surface {
  MeshSource source;
  Drawn drawn{};  // triangles or lines
  Transform file_from_mesh;
  std::optional<std::uint32_t> material;
  bool colors = false;  // its points have some
};
struct PlacedLight {
  scene::Light light;
  Transform file_from_light;
};
struct PlacedCamera {
  std::string name;                                                          // of its node, or its own
  std::variant<scene::PerspectiveCamera, scene::OrthographicCamera> camera;  // looks along -z
  Transform file_from_camera;
};
struct Parts {
  std::vector<Surface> surfaces;
  std::vector<PlacedLight> lights;
  std::vector<PlacedCamera> cameras;
  bool moves = false;  // an animation moves nodes
};

class File {
 public:
  File(std::vector<std::byte> file, FindFile find_file);

  // What is seen of the file: of all its scene, or of the node of that name and below. Nothing when there is
  // no such node.
  std::optional<Parts> parts(const std::optional<std::string>& node, const Play& now);
  // The mesh of a surface of triangles as it is in an animation, with the poses that it takes while the
  // shutter is open; nothing when the primitive has no triangles.
  std::optional<scene::TriangleMesh> mesh(const Surface& surface, const Play& play = {});
  // Whether that was nothing the last time.
  bool known_to_be_empty(const MeshSource& source) const {
    return empty_.contains({source.mesh, source.primitive});
  }
  // Its poses at a fraction of the time that the shutter is open, in place of meshes that have them.
  scene::MeshPose pose(const Surface& surface, const Play& play);
  // The ends of a surface of lines.
  std::vector<std::array<Vec3d, 2>> lines(const Surface& surface, const Play& play);
  const pbr::Material& material(std::uint32_t index);
  // As the scene has it; `span` stands in reports.
  const scene::Material& compiled_material(std::uint32_t index, bool colors, Span span);

  std::vector<std::string> node_names() const { return hierarchy_.names(); }
  std::vector<std::string> animation_names() const;
  // By index; unnamed ones are called "materials[3]".
  std::vector<std::string> material_names() const;
  const std::vector<std::string>& warnings() const { return document_.warnings(); }
  Document& document() { return document_; }

 private:
  // All nodes at a moment.
  struct Moment {
    std::vector<NodePose> poses;
    std::vector<Transform> placed;
  };
  const Moment& moment(const Play& play);
  const Animation* chosen_animation(const Play& play);
  void add_node(std::uint32_t node, const Moment& now, const Animation* animation, Parts& parts);
  void add_mesh(std::uint32_t node, std::uint32_t mesh, const Transform& file_from_node, bool posed,
                Parts& parts);
  Deformation deformation(const Surface& surface, const Play& play);
  std::vector<Transform> joints_of(std::uint32_t skin, const std::vector<Transform>& placed);
  const std::vector<Transform>& instances_of(std::uint32_t node);
  std::optional<Primitive> primitive(const Surface& surface);

  Document document_;
  Hierarchy hierarchy_;
  pbr::Textures textures_;
  std::map<std::uint32_t, Animation> animations_;
  std::map<std::pair<const Animation*, double>, Moment> moments_;
  std::map<std::uint32_t, std::vector<Transform>> mesh_to_joint_, instances_;  // of skins; of nodes
  std::set<std::pair<std::uint32_t, std::uint32_t>> empty_;                    // primitives without triangles
  std::map<std::uint32_t, pbr::Material> materials_;
  std::map<std::pair<std::uint32_t, bool>, scene::Material> compiled_;
};

// instances.cpp: where EXT_mesh_gpu_instancing puts a node's mesh; one place where it does not.
std::vector<Transform> instances_of(Document& document, const Element& node);
// lights_and_cameras.cpp
std::optional<scene::Light> light_of(Document& document, const Element& node);
std::optional<PlacedCamera> camera_of(Document& document, const Element& node);

}  // namespace tyndall::gltf
