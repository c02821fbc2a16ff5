#include "import/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "import/file_bytes.h"
#include "import/malformed.h"
#include "import/pbr/material_program.h"
#include "import/pbr/tangents.h"

namespace tyndall::mesh_file {

MeshFile read(const std::filesystem::path& path, const FindFile& find_file) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  MeshFile out;
  if (extension == ".ply")
    out = read_ply(read_file_bytes(path));
  else if (extension == ".obj")
    out = read_obj(read_file_bytes(path), find_file);
  else
    throw Malformed{"", "is no .ply or .obj; a .gltf or .glb is a `gltf`"};
  for (Part& part : out.parts) {
    pbr::mend_normals(part.mesh);
    part.colors = !part.mesh.colors.empty();
    if (!part.material) continue;
    const pbr::Material& material = out.materials[*part.material];
    part.mesh.thin = material.thin();
    if (material.normal_texture) pbr::add_tangents(part.mesh);
  }
  return out;
}

scene::Material compiled(const MeshFile& file, std::uint32_t material, Span span) {
  std::vector<std::vector<std::byte>> bytes(file.pictures.size());
  pbr::Textures textures([&](std::uint32_t picture) {
    std::vector<std::byte>& to = bytes[picture];
    if (to.empty()) to = read_file_bytes(file.pictures[picture]);
    return pbr::Textures::Stored{to, file.pictures[picture].filename().string()};
  });
  const bool colors = std::any_of(file.parts.begin(), file.parts.end(),
                                  [&](const Part& part) { return part.material == material && part.colors; });
  return pbr::compiled(file.materials[material], textures, colors, span);
}

}  // namespace tyndall::mesh_file
