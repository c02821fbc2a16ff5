// A glTF file read as the scene reads it.
#pragma once

#include "gltf_writer.h"
#include "import/file_bytes.h"
#include "import/gltf/file.h"
#include "import/malformed.h"
#include "support/test_folder.h"

namespace tyndall {

inline gltf::File open_gltf(const std::filesystem::path& path) {
  return gltf::File(read_file_bytes(path),
                    [folder = path.parent_path()](const std::string& name, std::string&) {
                      return std::optional(folder / name);
                    });
}

struct PlacedMesh {
  scene::TriangleMesh mesh;
  Transform file_from_mesh;
  Vec3d point(std::size_t i) const { return file_from_mesh.point(mesh.points.at(i)); }
};

// All that has a surface, when an animation has run for some time.
inline std::vector<PlacedMesh> meshes_at(gltf::File& file, double seconds = 0, bool loop = true,
                                         std::optional<std::string> animation = {}) {
  const gltf::Play play{std::move(animation), seconds, loop};
  const auto parts = file.parts({}, play);
  std::vector<PlacedMesh> out;
  for (const gltf::Surface& surface : parts->surfaces)
    if (auto mesh = surface.drawn == gltf::Drawn::triangles ? file.mesh(surface, play) : std::nullopt)
      out.push_back({std::move(*mesh), surface.file_from_mesh});
  return out;
}
inline std::vector<PlacedMesh> meshes_of(const GltfWriter& writer, double seconds = 0, bool loop = true) {
  gltf::File file = open_gltf(writer.save(test_folder()));
  return meshes_at(file, seconds, loop);
}

// Reads everything; why it cannot be, or an empty string.
inline std::string problem_of(const std::filesystem::path& path) {
  try {
    gltf::File file = open_gltf(path);
    const auto parts = file.parts({}, {});
    for (const gltf::Surface& surface : parts->surfaces) {
      if (surface.drawn == gltf::Drawn::triangles)
        file.mesh(surface);
      else
        file.lines(surface, {});
      if (surface.material) file.compiled_material(*surface.material, surface.colors, {});
    }
    return {};
  } catch (const Malformed& m) {
    return describe(m, path.filename().string());
  }
}
inline std::string problem_of(const GltfWriter& writer) { return problem_of(writer.save(test_folder())); }

inline void expect_near(const Vec3d& found, const Vec3d& wanted, double tolerance = 1e-6) {
  EXPECT_NEAR(found.x, wanted.x, tolerance);
  EXPECT_NEAR(found.y, wanted.y, tolerance);
  EXPECT_NEAR(found.z, wanted.z, tolerance);
}

}  // namespace tyndall
