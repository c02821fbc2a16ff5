#include "import/gltf/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "import/deformation.h"
#include "import/gltf/accessor.h"
#include "import/gltf/material.h"
#include "import/malformed.h"
#include "import/pbr/material_program.h"

namespace tyndall::gltf {

File::File(std::vector<std::byte> file, FindFile find_file)
    : document_(std::move(file), std::move(find_file)),
      hierarchy_(document_),
      textures_([this](std::uint32_t image) {
        return pbr::Textures::Stored{document_.image(image), document_.item("images", image).path()};
      }) {}

std::vector<std::string> File::animation_names() const {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < document_.count("animations"); ++i)
    out.push_back(name_of(document_.item("animations", i)));
  return out;
}

std::vector<std::string> File::material_names() const {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < document_.count("materials"); ++i)
    out.push_back(name_of(document_.item("materials", i)));
  return out;
}

const Animation* File::chosen_animation(const Play& play) {
  const std::vector<std::string> names = animation_names();
  const auto found = play.animation ? std::find(names.begin(), names.end(), *play.animation) : names.begin();
  if (found == names.end()) return nullptr;
  const auto index = static_cast<std::uint32_t>(found - names.begin());
  const auto known = animations_.find(index);
  return &(known != animations_.end() ? known : animations_.emplace(index, Animation(document_, index)).first)
              ->second;
}

const File::Moment& File::moment(const Play& play) {
  const Animation* const animation = chosen_animation(play);
  const double duration = animation ? animation->duration() : 0;
  const double seconds = play.loop && duration > 0
                             ? play.seconds - duration * std::floor(play.seconds / duration)
                             : play.seconds;
  const auto known = moments_.find({animation, animation ? seconds : 0});
  if (known != moments_.end()) return known->second;
  constexpr std::size_t most_kept = 1 << 18;  // nodes of all moments
  if (moments_.size() * hierarchy_.rest().size() > most_kept) moments_.clear();
  Moment out{hierarchy_.rest(), {}};
  if (animation) animation->apply(seconds, out.poses);
  out.placed = hierarchy_.placed(out.poses);
  return moments_[{animation, animation ? seconds : 0}] = std::move(out);
}

std::optional<Parts> File::parts(const std::optional<std::string>& node, const Play& play) {
  const auto nodes = node ? hierarchy_.below(*node) : hierarchy_.shown();
  if (!nodes) return std::nullopt;
  Parts out;
  const Animation* const animation = chosen_animation(play);
  out.moves = animation != nullptr;
  const Moment& now = moment(play);
  for (const std::uint32_t i : *nodes) add_node(i, now, animation, out);
  return out;
}

void File::add_node(std::uint32_t index, const Moment& now, const Animation* animation, Parts& parts) {
  const Element node = document_.item("nodes", index);
  const Transform& placed = now.placed[index];
  for (const Vec3d& part : {placed.x, placed.y, placed.z, placed.t})
    if (!all_finite(part)) node.fail("stands nowhere: its transform is not finite");
  if (const auto mesh_index = document_.index(node, "mesh", "meshes")) {
    const bool skinned = document_.index(node, "skin", "skins").has_value();
    const bool morphed = !now.poses[index].weights.empty() || (animation && animation->weighs(index)) ||
                         document_.item("meshes", *mesh_index).find("weights");
    // A skin takes its points to the file's space whatever the node says.
    add_mesh(index, *mesh_index, skinned ? Transform{} : placed, skinned || morphed, parts);
  }
  if (!placed.inverse()) return;  // a scale of 0 hides what is there
  if (const auto light = light_of(document_, node)) parts.lights.push_back({*light, placed});
  if (auto camera = camera_of(document_, node)) {
    camera->file_from_camera = placed;
    parts.cameras.push_back(std::move(*camera));
  }
}

void File::add_mesh(std::uint32_t node, std::uint32_t mesh, const Transform& file_from_node, bool posed,
                    Parts& parts) {
  const Element primitives = document_.item("meshes", mesh)["primitives"];
  for (const Transform& node_from_mesh : instances_of(node)) {
    const Transform file_from_mesh = file_from_node * node_from_mesh;
    // A node whose scale is 0 hides what is in it.
    if (!file_from_mesh.inverse()) continue;
    for (std::uint32_t i = 0; i < primitives.size(); ++i) {
      const Element primitive = primitives.at(i);
      const Drawn drawn = drawn_by(primitive);
      if (drawn == Drawn::points) {
        document_.warn("holds points, which are left out");
        continue;
      }
      document_.take(primitive, sizeof(Surface));
      parts.surfaces.push_back({{mesh, i, node, posed},
                                drawn,
                                file_from_mesh,
                                document_.index(primitive, "material", "materials"),
                                primitive["attributes"].find("COLOR_0").has_value()});
    }
  }
}

const std::vector<Transform>& File::instances_of(std::uint32_t node) {
  const auto known = instances_.find(node);
  if (known != instances_.end()) return known->second;
  return instances_[node] = gltf::instances_of(document_, document_.item("nodes", node));
}

Deformation File::deformation(const Surface& surface, const Play& play) {
  Deformation out;
  if (!surface.source.posed) return out;
  const Moment& now = moment(play);
  const Element node = document_.item("nodes", surface.source.node);
  out.weights = now.poses[surface.source.node].weights;
  if (const auto weights = document_.item("meshes", surface.source.mesh).find("weights");
      weights && out.weights.empty())
    for (std::size_t i = 0; i < weights->size(); ++i) out.weights.push_back(weights->at(i).number());
  if (const auto skin = document_.index(node, "skin", "skins")) out.joints = joints_of(*skin, now.placed);
  return out;
}

std::vector<Transform> File::joints_of(std::uint32_t index, const std::vector<Transform>& placed) {
  const Element skin = document_.item("skins", index), joints = skin["joints"];
  const std::size_t count = joints.size();
  auto known = mesh_to_joint_.find(index);
  if (known == mesh_to_joint_.end()) {
    if (count == 0) joints.fail("has no joints");
    std::vector<Transform> mesh_to_joint;
    if (const auto accessor = document_.index(skin, "inverseBindMatrices", "accessors"))
      mesh_to_joint = read_matrices(document_, *accessor);
    if (!mesh_to_joint.empty() && mesh_to_joint.size() < count)
      skin["inverseBindMatrices"].fail(
          fmt::format("has {} matrices for {} joints", mesh_to_joint.size(), count));
    mesh_to_joint.resize(count);
    known = mesh_to_joint_.emplace(index, std::move(mesh_to_joint)).first;
  }
  std::vector<Transform> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back(placed[joints.at(i).index(placed.size(), "nodes")] * known->second[i]);
  return out;
}

std::optional<Primitive> File::primitive(const Surface& surface) {
  const Element element =
      document_.item("meshes", surface.source.mesh)["primitives"].at(surface.source.primitive);
  PointNeeds needs;
  if (surface.material) {
    const pbr::Material& m = material(*surface.material);
    needs = {m.normal_texture.has_value(), m.second_uv_set()};
  }
  return Primitive::read(document_, element, needs);
}

std::optional<scene::TriangleMesh> File::mesh(const Surface& surface, const Play& play) {
  auto stored = primitive(surface);
  if (!stored) {
    empty_.insert({surface.source.mesh, surface.source.primitive});
    return std::nullopt;
  }
  scene::TriangleMesh mesh =
      surface.source.posed ? stored->mesh(deformation(surface, play)) : std::move(*stored).undeformed();
  mesh.thin = surface.material && material(*surface.material).thin();
  if (!surface.source.posed || play.span == 0 || !chosen_animation(play)) return mesh;
  const PoseError error = add_later_poses(
      mesh, [&](double fraction) { return stored->pose(deformation(surface, play.later(fraction))); });
  const Element element = document_.item("meshes", surface.source.mesh);
  document_.take(element, static_cast<double>(mesh.later.size() * mesh.points.size() * sizeof(Vec3d)));
  if (const auto told = uneven_motion(fmt::format("has a mesh, '{}',", name_of(element)), mesh, error))
    document_.warn(*told);
  return mesh;
}

scene::MeshPose File::pose(const Surface& surface, const Play& play) {
  auto stored = primitive(surface);
  return stored ? stored->pose(deformation(surface, play)) : scene::MeshPose{};
}

std::vector<std::array<Vec3d, 2>> File::lines(const Surface& surface, const Play& play) {
  auto stored = primitive(surface);
  return stored ? stored->lines(deformation(surface, play)) : std::vector<std::array<Vec3d, 2>>{};
}

const pbr::Material& File::material(std::uint32_t index) {
  const auto known = materials_.find(index);
  return known != materials_.end() ? known->second
                                   : materials_.emplace(index, read_material(document_, index)).first->second;
}

const scene::Material& File::compiled_material(std::uint32_t index, bool colors, Span span) {
  const auto known = compiled_.find({index, colors});
  if (known != compiled_.end()) return known->second;
  return compiled_.emplace(std::pair(index, colors), pbr::compiled(material(index), textures_, colors, span))
      .first->second;
}

}  // namespace tyndall::gltf
