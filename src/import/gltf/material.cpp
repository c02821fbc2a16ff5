#include "import/gltf/material.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::gltf {

using pbr::Material;
using pbr::Texture;
using pbr::Wrap;

namespace {

Rgb color_of(const Element& element, std::string_view key, const Vec3d& standard) {
  const Vec3d v = element.vec(key, standard);
  for (std::size_t k = 0; k < 3; ++k)
    if (v[k] < 0) element[key].fail(fmt::format("holds {}: no colour is negative", v[k]));
  return Rgb(v);
}

// Tells what is not read of materials, once, by the first that has it.
void tell(Document& document, const Material& m, std::string_view what, std::string_view instead) {
  document.warn_once(what, fmt::format("has {} in '{}', which is ignored: {}", what, m.name, instead));
}

// A number in [0, 1].
float share(const Element& element, std::string_view key, double standard) {
  const double number = element.number(key, standard);
  if (!(number >= 0 && number <= 1)) element[key].fail(fmt::format("must be in [0, 1], found {}", number));
  return static_cast<float>(number);
}

Wrap wrap_of(const Element& sampler, std::string_view key) {
  constexpr std::uint64_t repeat = 10497, clamp = 33071, mirror = 33648;
  switch (sampler.count(key, repeat)) {
    case repeat:
      return Wrap::repeat;
    case clamp:
      return Wrap::clamp;
    case mirror:
      return Wrap::mirror;
  }
  sampler[key].fail(fmt::format("is {}, which is none of glTF's", sampler.count(key, 0)));
}

std::optional<Texture> texture_of(Document& document, const Element& holder, std::string_view key) {
  const auto info = holder.find(key);
  if (!info) return std::nullopt;
  Texture out;
  const std::uint32_t index = (*info)["index"].index(document.count("textures"), "textures");
  const Element texture = document.item("textures", index);
  std::optional<std::uint32_t> image;
  if (const auto webp = texture.extension("EXT_texture_webp"))
    image = document.index(*webp, "source", "images");
  if (!image) image = document.index(texture, "source", "images");
  if (!image) texture.fail("has no source that is a PNG, JPEG or WebP picture");
  out.image = *image;
  constexpr std::uint64_t most_sets = 1000;
  out.uv_set = static_cast<std::uint32_t>(std::min(info->count("texCoord", 0), most_sets));
  if (const auto sampler_index = document.index(texture, "sampler", "samplers")) {
    constexpr std::uint64_t nearest = 9728;
    const Element sampler = document.item("samplers", *sampler_index);
    out.wrap_u = wrap_of(sampler, "wrapS");
    out.wrap_v = wrap_of(sampler, "wrapT");
    out.nearest = sampler.count("magFilter", 0) == nearest;
  }
  if (const auto transform = info->extension("KHR_texture_transform")) {
    const auto pair = [&](std::string_view name, Pair<double> standard) {
      const auto found = transform->find(name);
      if (!found) return standard;
      const auto [x, y] = found->numbers<2>();
      return Pair<double>{x, y};
    };
    out.offset = pair("offset", out.offset);
    out.scale = pair("scale", out.scale);
    out.rotation = transform->number("rotation", 0);
    out.uv_set = static_cast<std::uint32_t>(std::min(transform->count("texCoord", out.uv_set), most_sets));
  }
  return out;
}

void read_base(Document& document, const Element& material, Material& m) {
  const auto base = material.find("pbrMetallicRoughness");
  if (!base) return;
  if (const auto factor = base->find("baseColorFactor")) {
    const auto c = factor->numbers<4>();
    for (const double part : c)
      if (!(part >= 0 && part <= 1)) factor->fail(fmt::format("must be in [0, 1], found {}", part));
    m.base_color = Rgb(Vec3d(c[0], c[1], c[2]));
    m.alpha = static_cast<float>(c[3]);
  }
  m.metallic = share(*base, "metallicFactor", 1);
  m.roughness = share(*base, "roughnessFactor", 1);
  m.base_texture = texture_of(document, *base, "baseColorTexture");
  m.metallic_roughness_texture = texture_of(document, *base, "metallicRoughnessTexture");
}

void read_light_and_opacity(Document& document, const Element& material, Material& m) {
  m.emissive = color_of(material, "emissiveFactor", {});
  if (const auto extension = material.extension("KHR_materials_emissive_strength"))
    m.emissive = m.emissive * static_cast<float>(extension->number("emissiveStrength", 1));
  m.emissive_texture = texture_of(document, material, "emissiveTexture");
  m.normal_texture = texture_of(document, material, "normalTexture");
  if (material.find("occlusionTexture"))
    tell(document, m, "an occlusionTexture", "what occludes is computed here");
  if (m.normal_texture) m.normal_scale = static_cast<float>(material["normalTexture"].number("scale", 1));
  const std::string mode = material.text("alphaMode", "OPAQUE");
  if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND")
    material["alphaMode"].fail(fmt::format("is '{}', which is none of glTF's", mode));
  m.alpha_mode = mode == "MASK"    ? Material::Alpha::mask
                 : mode == "BLEND" ? Material::Alpha::blend
                                   : Material::Alpha::opaque;
  m.cutoff = static_cast<float>(material.number("alphaCutoff", 0.5));
}

void read_gloss(Document& document, const Element& material, Material& m) {
  if (const auto e = material.extension("KHR_materials_ior")) {
    const double ior = e->number("ior", 1.5);
    if (ior != 0 && !(ior >= 1 && ior <= 1000))
      (*e)["ior"].fail(fmt::format("must be from 1, found {}", ior));
    if (ior == 0) document.warn("has a material with ior 0, which is not supported: it counts as 1.5");
    m.ior = ior == 0 ? 1.5f : static_cast<float>(ior);
  }
  if (const auto e = material.extension("KHR_materials_specular")) {
    m.specular = share(*e, "specularFactor", 1);
    m.specular_texture = texture_of(document, *e, "specularTexture");
    m.specular_color = color_of(*e, "specularColorFactor", {1, 1, 1});
    m.specular_color_texture = texture_of(document, *e, "specularColorTexture");
  }
  if (const auto e = material.extension("KHR_materials_clearcoat")) {
    m.coat = share(*e, "clearcoatFactor", 0);
    m.coat_texture = texture_of(document, *e, "clearcoatTexture");
    m.coat_roughness = share(*e, "clearcoatRoughnessFactor", 0);
    m.coat_roughness_texture = texture_of(document, *e, "clearcoatRoughnessTexture");
    if (m.coat > 0 && e->find("clearcoatNormalTexture"))
      tell(document, m, "a clearcoatNormalTexture", "its coat has the normal of what is below");
  }
  if (const auto e = material.extension("KHR_materials_sheen")) {
    m.sheen = color_of(*e, "sheenColorFactor", {});
    for (std::size_t k = 0; k < 3; ++k) m.sheen[k] = std::min(m.sheen[k], 1.0f);
    m.sheen_texture = texture_of(document, *e, "sheenColorTexture");
    if (!is_black(m.sheen) && (share(*e, "sheenRoughnessFactor", 0) > 0 || e->find("sheenRoughnessTexture")))
      tell(document, m, "a sheen roughness", "all sheen is of one roughness here");
  }
}

void read_glass(Document& document, const Element& material, Material& m) {
  if (const auto e = material.extension("KHR_materials_transmission")) {
    m.transmission = share(*e, "transmissionFactor", 0);
    m.transmission_texture = texture_of(document, *e, "transmissionTexture");
  }
  if (const auto e = material.extension("KHR_materials_volume")) {
    m.volume = e->number("thicknessFactor", 0) > 0;
    if (m.volume && e->find("thicknessTexture"))
      tell(document, m, "a thicknessTexture", "the way through the mesh itself counts");
    m.attenuation_color = color_of(*e, "attenuationColor", {1, 1, 1});
    if (const auto distance = e->find("attenuationDistance")) {
      m.attenuation_distance = distance->number();
      if (!(m.attenuation_distance > 0)) distance->fail("must be above 0");
    }
  }
}

}  // namespace

Material read_material(Document& document, std::uint32_t index) {
  const Element material = document.item("materials", index);
  Material m;
  m.name = name_of(material);
  read_base(document, material, m);
  read_light_and_opacity(document, material, m);
  read_gloss(document, material, m);
  read_glass(document, material, m);
  m.unlit = material.extension("KHR_materials_unlit").has_value();
  for (const auto* texture : m.textures())
    if (*texture && (*texture)->uv_set != 0 && (*texture)->uv_set != m.second_uv_set())
      document.warn(fmt::format(
          "'{}' uses more than two sets of texture coordinates: the third counts as the second", m.name));
  return m;
}

}  // namespace tyndall::gltf
