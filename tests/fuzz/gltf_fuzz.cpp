// Any bytes at all as a glTF file: what is read without an error are sound meshes and programs.
#include "base/check.h"
#include "import/gltf/file.h"
#include "import/malformed.h"
#include "scene/validate.h"
#include "vm/program/program.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  const auto* const bytes = reinterpret_cast<const std::byte*>(data);
  try {
    gltf::File file({bytes, bytes + size}, [](const std::string&, std::string& why) {
      why = "names a file, which no fuzzer reads";
      return std::optional<std::filesystem::path>{};
    });
    const gltf::Play play{{}, 0.5, true, 0.1};
    const auto parts = file.parts({}, play);
    for (const gltf::Surface& surface : parts->surfaces) {
      if (const auto mesh = file.mesh(surface, play)) CHECK(scene::validate(*mesh).empty());
      if (!surface.material) continue;
      CHECK_EQ(vm::verify(file.compiled_material(*surface.material, surface.colors, {}).program),
               std::string());
    }
  } catch (const Malformed&) {
  }
  return 0;
}
