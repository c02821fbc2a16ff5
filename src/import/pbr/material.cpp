#include "import/pbr/material.h"

namespace tyndall::pbr {

std::array<const std::optional<Texture>*, 10> Material::textures() const {
  return {&base_texture,  &metallic_roughness_texture, &normal_texture,         &emissive_texture,
          &sheen_texture, &specular_texture,           &specular_color_texture, &transmission_texture,
          &coat_texture,  &coat_roughness_texture};
}

std::uint32_t Material::second_uv_set() const {
  for (const auto* texture : textures())
    if (*texture && (*texture)->uv_set != 0) return (*texture)->uv_set;
  return 0;
}

}  // namespace tyndall::pbr
