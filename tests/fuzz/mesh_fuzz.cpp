// Any bytes at all as a PLY or OBJ file: what is read without an error are sound meshes.
#include "base/check.h"
#include "import/malformed.h"
#include "import/mesh/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  if (size == 0) return 0;
  const std::span bytes(reinterpret_cast<const std::byte*>(data) + 1, size - 1);
  const auto find_none = [](const std::string&, std::string& why) {
    why = "names a file, which no fuzzer reads";
    return std::optional<std::filesystem::path>{};
  };
  try {
    const mesh_file::MeshFile file =
        data[0] % 2 == 0 ? mesh_file::read_ply(bytes) : mesh_file::read_obj(bytes, find_none);
    for (const mesh_file::Part& part : file.parts)
      for (const auto& triangle : part.mesh.triangles)
        for (const std::uint32_t corner : triangle) CHECK_LT(corner, part.mesh.points.size());
  } catch (const Malformed&) {
  }
  return 0;
}
