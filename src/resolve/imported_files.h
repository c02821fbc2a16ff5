// The glTF and mesh files of a scene: each is opened once, its meshes and materials are in the scene once.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "import/gltf/file.h"
#include "import/mesh/mesh_file.h"
#include "scene/scene.h"

namespace tyndall::resolve {

struct Run;
struct KeptParts;
struct NamedFile;
struct KnownObject;

// An open glTF file, and what of it is in the scene.
struct OpenGltf {
  std::shared_ptr<gltf::File> file;
  std::string name;                                     // without its folder, for messages
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // a mesh and its primitive
  std::map<Key, std::optional<scene::MeshId>> meshes;   // not posed ones
  std::map<std::pair<std::uint32_t, bool>, scene::MaterialId> materials;
  std::map<std::uint32_t, std::optional<scene::MediumId>> insides;
  std::size_t warnings_told = 0;
  // For the next frame: the meshes that are not posed, and what the file names.
  std::map<Key, scene::SharedMesh> kept_meshes{};
  std::shared_ptr<std::set<std::string>> files_read{};
};

// An open PLY or OBJ file, and what of it is in the scene.
struct OpenMeshes {
  std::shared_ptr<mesh_file::MeshFile> file;  // its parts without their meshes
  std::vector<scene::SharedMesh> meshes;      // of its parts
  std::shared_ptr<std::set<std::string>> files_read;
  std::vector<scene::MeshId> parts{};  // empty until they are in the scene
  std::map<std::uint32_t, scene::MaterialId> materials{};
};

class ImportedFiles {
 public:
  // What another run of the same scene has open.
  void share(const ImportedFiles& other);
  // Gives the next frame the files that this one named, and tells of what they name in turn.
  void keep_in(KeptParts& parts, std::set<std::string>* files_read);

  // Null after an error, which is told once.
  OpenGltf* gltf(Run& run, const NamedFile& named);
  OpenMeshes* meshes(Run& run, const NamedFile& named);

  // Objects made of files, by all that decides what they hold.
  std::map<std::string, std::shared_ptr<const KnownObject>> objects;
  // glTF's for what names none: white metal, rough.
  scene::MaterialId gltf_default(scene::Scene& scene);

 private:
  // Whether the frame before has the file open, which is then open here as well.
  bool take_kept_gltf(Run& run, const std::string& path);
  bool take_kept_meshes(Run& run, const std::string& path);

  scene::MaterialId gltf_default_;
  std::map<std::string, std::unique_ptr<OpenGltf>> gltfs_;     // by path; null: not to be read
  std::map<std::string, std::unique_ptr<OpenMeshes>> meshes_;  // likewise
};

// Tells what is new among the file's warnings.
void tell_warnings(Run& run, OpenGltf& open, Span span);
// The mesh of a surface of triangles, put into the scene when it is first asked for; nothing where there is
// none. Throws Malformed.
std::optional<scene::MeshId> mesh_of(Run& run, OpenGltf& open, const gltf::Surface& surface,
                                     const gltf::Play& play);
scene::MaterialId material_of(Run& run, OpenGltf& open, std::uint32_t index, bool colors, Span span);
std::optional<scene::MediumId> inside_of(Run& run, OpenGltf& open, std::uint32_t material);

}  // namespace tyndall::resolve
