// Meshes given inline.
#include <fmt/format.h>

#include <cmath>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

std::optional<scene::Shape> read_mesh(Run& run, Reader& reader, const ShapeSite&) {
  auto given = reader.read<MeshParameters>();
  scene::Mesh shape;
  if (!reader.ok()) return shape;
  scene::TriangleMesh mesh;
  mesh.points = std::move(given.points);
  mesh.normals = std::move(given.normals);
  mesh.uvs = std::move(given.uvs);
  mesh.triangles.reserve(given.triangles.size());
  for (const Vec3d& triangle : given.triangles) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double index = triangle[i];
      if (!(index >= 0 && index < 4294967295.0 && index == std::floor(index))) {
        reader.error(reader.place("triangles"),
                     fmt::format("'triangles' names points by whole numbers from 0, found {}", index));
        return shape;
      }
      corners[i] = static_cast<std::uint32_t>(index);
    }
    mesh.triangles.push_back(corners);
  }
  reader.report(scene::validate(mesh));
  if (!reader.ok()) return shape;
  shape.mesh = scene::MeshId(run.scene.meshes.size());
  run.scene.meshes.push_back(std::move(mesh));
  run.written.meshes.push_back(
      {shape.mesh, reader.place("points"), reader.place("triangles"), reader.place("uvs")});
  return shape;
}

}  // namespace tyndall::resolve
