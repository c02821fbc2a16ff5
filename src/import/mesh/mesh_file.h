// Files of meshes: PLY and OBJ, as triangles with materials.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "import/find_file.h"
#include "import/pbr/material.h"
#include "scene/scene.h"

namespace tyndall::mesh_file {

// The triangles of one material.
struct Part {
  scene::TriangleMesh mesh;
  std::optional<std::uint32_t> material;  // of the file's
  bool colors = false;                    // its points have some
};
struct MeshFile {
  std::vector<Part> parts;
  std::vector<pbr::Material> materials;  // their textures name `pictures`
  std::vector<std::filesystem::path> pictures;
  std::vector<std::string> warnings;  // for the user, as the rest of a sentence
};

// By its extension, .ply or .obj. Throws Malformed.
MeshFile read(const std::filesystem::path& path, const FindFile& find_file);

// ply.cpp: throws Malformed.
MeshFile read_ply(std::span<const std::byte> bytes);
// obj.cpp: with the .mtl files that it names. Throws Malformed.
MeshFile read_obj(std::span<const std::byte> bytes, const FindFile& find_file);

// A material of the file as the scene has it; `span` stands in reports. Throws Malformed.
scene::Material compiled(const MeshFile& file, std::uint32_t material, Span span);

}  // namespace tyndall::mesh_file
