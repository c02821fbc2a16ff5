// Wavefront's format with the materials of .mtl files. The one file that knows tinyobjloader.
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <sstream>
#include <tuple>
#include <unordered_map>

#include "import/file_bytes.h"
#include "import/malformed.h"
#include "import/mesh/mesh_file.h"

namespace tyndall::mesh_file {

namespace {

std::istringstream stream_of(std::span<const std::byte> bytes) {
  return std::istringstream(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

// Finds the .mtl files by `find_file`; those that are not there are told.
class Materials : public tinyobj::MaterialReader {
 public:
  Materials(const FindFile& find_file, std::vector<std::string>& warnings)
      : find_file_(find_file), warnings_(warnings) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* numbers, std::string* warning, std::string* error) override {
    std::string why;
    const auto path = find_file_(name, why);
    if (!path) {
      warnings_.push_back(why);
      return true;
    }
    try {
      std::istringstream stream = stream_of(read_file_bytes(*path));
      tinyobj::LoadMtl(numbers, materials, &stream, warning, error);
    } catch (const Malformed& m) {
      warnings_.push_back(fmt::format("names '{}', which {}", name, m.reason));
    }
    return true;
  }

 private:
  const FindFile& find_file_;
  std::vector<std::string>& warnings_;
};

float share(double x) { return std::isfinite(x) ? static_cast<float>(std::clamp(x, 0.0, 1.0)) : 0.0f; }

// The materials of an .mtl as metallic-roughness ones.
class Converter {
 public:
  Converter(MeshFile& file, const FindFile& find_file) : file_(file), find_file_(find_file) {}

  void add(const tinyobj::material_t& from) {
    pbr::Material m;
    m.name = from.name;
    m.base_color = {share(from.diffuse[0]), share(from.diffuse[1]), share(from.diffuse[2])};
    for (std::size_t k = 0; k < 3; ++k)
      m.emissive[k] =
          std::isfinite(from.emission[k]) ? static_cast<float>(std::max<double>(from.emission[k], 0)) : 0;
    m.metallic = share(from.metallic);
    // Blinn's exponent has the width of a lobe with alpha² = 2 / (n + 2) (Walter et al. 2007), alpha =
    // roughness².
    const double exponent = std::isfinite(from.shininess) ? std::max<double>(from.shininess, 0) : 0;
    m.roughness = from.roughness > 0 ? share(from.roughness) : share(std::pow(2 / (exponent + 2), 0.25));
    const bool gloss =
        from.illum >= 2 && (from.specular[0] > 0 || from.specular[1] > 0 || from.specular[2] > 0);
    m.specular = gloss || m.metallic > 0 ? 1.0f : 0.0f;
    m.coat = share(from.clearcoat_thickness);
    m.sheen = Rgb(share(from.sheen));
    const bool glass = from.illum == 4 || from.illum == 6 || from.illum == 7 || from.illum == 9;
    const float dissolve = share(from.dissolve);
    if (glass && dissolve < 1) {
      m.transmission = 1 - dissolve;
      m.volume = true;
      m.specular = 1;
    } else if (dissolve < 1) {
      m.alpha = dissolve;
      m.alpha_mode = pbr::Material::Alpha::blend;
    }
    if (from.ior > 1 && from.ior < 1000) m.ior = static_cast<float>(from.ior);
    m.base_texture = texture(from.diffuse_texname, from.diffuse_texopt);
    if (m.base_texture) m.base_color = Rgb(1.0f);  // pictures stand for the colour
    m.emissive_texture = texture(from.emissive_texname, from.emissive_texopt);
    if (m.emissive_texture && is_black(m.emissive)) m.emissive = Rgb(1.0f);
    m.normal_texture = texture(from.normal_texname, from.normal_texopt);
    for (const std::string* left_out :
         {&from.specular_texname, &from.bump_texname, &from.alpha_texname, &from.roughness_texname,
          &from.metallic_texname, &from.displacement_texname})
      if (!left_out->empty())
        file_.warnings.push_back(
            fmt::format("has the picture '{}' for what is not read of .mtl files", *left_out));
    file_.materials.push_back(std::move(m));
  }

 private:
  std::optional<pbr::Texture> texture(const std::string& name, const tinyobj::texture_option_t& options) {
    if (name.empty()) return std::nullopt;
    std::string why, with_slashes = name;
    std::replace(with_slashes.begin(), with_slashes.end(), '\\', '/');
    const auto path = find_file_(with_slashes, why);
    if (!path) {
      file_.warnings.push_back(why);
      return std::nullopt;
    }
    pbr::Texture out;
    const auto known = std::find(file_.pictures.begin(), file_.pictures.end(), *path);
    out.image = static_cast<std::uint32_t>(known - file_.pictures.begin());
    if (known == file_.pictures.end()) file_.pictures.push_back(*path);
    if (options.clamp) out.wrap_u = out.wrap_v = pbr::Wrap::clamp;
    return out;
  }

  MeshFile& file_;
  const FindFile& find_file_;
};

// Corners that name the same point, normal and uv are one point of the mesh.
class Builder {
 public:
  explicit Builder(const tinyobj::attrib_t& attributes) : a_(attributes) {}

  void add(const tinyobj::mesh_t& mesh, std::size_t materials) {
    std::size_t corner = 0;
    for (std::size_t face = 0; face < mesh.num_face_vertices.size(); ++face) {
      const std::size_t corners = mesh.num_face_vertices[face];
      if (corner + corners > mesh.indices.size())
        throw Malformed{fmt::format("face {}", face), "has too few corners"};
      const int id = face < mesh.material_ids.size() ? mesh.material_ids[face] : -1;
      PartInMaking& part = parts_[id >= 0 && static_cast<std::size_t>(id) < materials ? id : -1];
      for (std::size_t k = 2; k < corners; ++k)
        part.mesh.triangles.push_back({point(part, mesh.indices[corner]),
                                       point(part, mesh.indices[corner + k - 1]),
                                       point(part, mesh.indices[corner + k])});
      corner += corners;
    }
  }

  std::vector<Part> parts() {
    std::vector<Part> out;
    for (auto& [material, part] : parts_) {
      if (part.mesh.triangles.empty()) continue;
      // A part where some corners have none does without.
      if (part.without_normal) part.mesh.normals.clear();
      if (part.without_uv) part.mesh.uvs.clear();
      out.push_back({std::move(part.mesh),
                     material >= 0 ? std::optional(static_cast<std::uint32_t>(material)) : std::nullopt});
    }
    return out;
  }

 private:
  struct Key {
    int point, normal, uv;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      const auto mix = [](std::uint64_t h, int v) {
        return (h ^ static_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15u;
      };
      const std::uint64_t hash = mix(mix(mix(0x2545f4914f6cdd1du, k.point), k.normal), k.uv);
      return hash ^ (hash >> 32);
    }
  };
  struct PartInMaking {
    scene::TriangleMesh mesh;
    std::unordered_map<Key, std::uint32_t, Hash> known;
    bool without_normal = false, without_uv = false;
  };

  // Numbers `index * width` on of a list, checked.
  const tinyobj::real_t* numbers(const std::vector<tinyobj::real_t>& list, int index, std::size_t width,
                                 std::string_view what) const {
    if (index < 0 || (static_cast<std::size_t>(index) + 1) * width > list.size())
      throw Malformed{fmt::format("a face"),
                      fmt::format("names {} {}, and there are {}", what, index + 1, list.size() / width)};
    const tinyobj::real_t* const at = list.data() + static_cast<std::size_t>(index) * width;
    for (std::size_t k = 0; k < width; ++k)
      if (!std::isfinite(at[k]))
        throw Malformed{fmt::format("{} {}", what, index + 1), fmt::format("holds {}", at[k])};
    return at;
  }

  std::uint32_t point(PartInMaking& part, const tinyobj::index_t& index) {
    const Key key{index.vertex_index, index.normal_index, index.texcoord_index};
    const auto [known, is_new] =
        part.known.try_emplace(key, static_cast<std::uint32_t>(part.mesh.points.size()));
    if (!is_new) return known->second;
    const tinyobj::real_t* const p = numbers(a_.vertices, key.point, 3, "point");
    part.mesh.points.emplace_back(double{p[0]}, double{p[1]}, double{p[2]});
    part.without_normal |= key.normal < 0;
    part.without_uv |= key.uv < 0;
    part.mesh.normals.emplace_back();
    part.mesh.uvs.emplace_back();
    if (key.normal >= 0) {
      const tinyobj::real_t* const n = numbers(a_.normals, key.normal, 3, "normal");
      part.mesh.normals.back() = {double{n[0]}, double{n[1]}, double{n[2]}};
    }
    if (key.uv >= 0) {
      const tinyobj::real_t* const uv = numbers(a_.texcoords, key.uv, 2, "texture coordinate");
      part.mesh.uvs.back() = {double{uv[0]}, double{uv[1]}};
    }
    return known->second;
  }

  const tinyobj::attrib_t& a_;
  std::map<int, PartInMaking> parts_;
};

}  // namespace

MeshFile read_obj(std::span<const std::byte> bytes, const FindFile& find_file) {
  MeshFile out;
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream stream = stream_of(bytes);
  Materials reader(find_file, out.warnings);
  constexpr bool triangulate = true, white_where_no_colors = false;
  bool read = false;
  try {
    read = tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, &reader, triangulate,
                            white_where_no_colors);
  } catch (const std::exception& e) {
    error = e.what();
  }
  if (!read) throw Malformed{"", fmt::format("cannot be read: {}", error.substr(0, error.find('\n')))};
  Converter converter(out, find_file);
  for (const tinyobj::material_t& material : materials) converter.add(material);
  Builder builder(attributes);
  for (const tinyobj::shape_t& shape : shapes) builder.add(shape.mesh, materials.size());
  out.parts = builder.parts();
  if (out.parts.empty()) throw Malformed{"", "has no faces"};
  return out;
}

}  // namespace tyndall::mesh_file
