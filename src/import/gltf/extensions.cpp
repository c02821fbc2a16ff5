#include "import/gltf/extensions.h"

#include <algorithm>
#include <array>

namespace tyndall::gltf {

bool is_supported(std::string_view extension) {
  static constexpr std::array<std::string_view, 16> supported = {
      "EXT_mesh_gpu_instancing",
      "EXT_meshopt_compression",
      "EXT_texture_webp",
      "KHR_draco_mesh_compression",
      "KHR_lights_punctual",
      "KHR_materials_clearcoat",
      "KHR_materials_emissive_strength",
      "KHR_materials_ior",
      "KHR_materials_sheen",
      "KHR_materials_specular",
      "KHR_materials_transmission",
      "KHR_materials_unlit",
      "KHR_materials_volume",
      "KHR_mesh_quantization",
      "KHR_texture_transform",
      "KHR_xmp_json_ld",  // tells of the file, not of the scene
  };
  return std::find(supported.begin(), supported.end(), extension) != supported.end();
}

}  // namespace tyndall::gltf
