// Metallic-roughness materials of files as plain numbers and textures.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/numerics.h"
#include "base/vec.h"

namespace tyndall::pbr {

enum class Wrap : std::uint8_t { repeat, mirror, clamp };

// A picture and how it is looked up.
struct Texture {
  std::uint32_t image = 0;
  std::uint32_t uv_set = 0;
  Wrap wrap_u{}, wrap_v{};
  bool nearest = false;
  // KHR_texture_transform: texture coordinates are scaled, turned, then moved.
  Pair<double> offset{0, 0}, scale{1, 1};
  double rotation = 0;  // counter-clockwise where v runs down [rad]
};

struct Material {
  enum class Alpha : std::uint8_t { opaque, mask, blend };

  std::string name;
  Rgb base_color{1.0f}, emissive{0.0f}, sheen{0.0f}, specular_color{1.0f};
  float alpha = 1, metallic = 1, roughness = 1, normal_scale = 1, cutoff = 0.5f;
  float ior = 1.5f, specular = 1, transmission = 0, coat = 0, coat_roughness = 0;
  Alpha alpha_mode{};
  bool unlit = false;
  bool volume = false;  // it has an inside: light is bent, and dimmed on its way there
  Rgb attenuation_color{1.0f};
  double attenuation_distance = infinity;  // after which that much is left [m]
  std::optional<Texture> base_texture, metallic_roughness_texture, normal_texture, emissive_texture,
      sheen_texture, specular_texture, specular_color_texture, transmission_texture, coat_texture,
      coat_roughness_texture;

  // Thin walls of glass: light goes straight through.
  bool thin() const { return transmission > 0 && !volume; }
  std::array<const std::optional<Texture>*, 10> textures() const;
  // The set of texture coordinates beside the first that its textures use; 0: none.
  std::uint32_t second_uv_set() const;
};

}  // namespace tyndall::pbr
