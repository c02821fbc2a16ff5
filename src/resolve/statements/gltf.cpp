// glTF files: all of one as an object that is placed, a node as a shape, a camera.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "import/deformation.h"
#include "import/malformed.h"
#include "resolve/statements/imported.h"
#include "shapes/mesh_at.h"

namespace tyndall::resolve {

namespace {

// The animation at the run's time.
gltf::Play play_of(const Run& run, const GltfChoice& choice) {
  const double span = run.context.shutter_open ? scene::shutter_seconds(*run.foreseen) : 0;
  return {choice.animation, (run.context.time - choice.start) * choice.speed, choice.loop,
          span * choice.speed};
}

// What is chosen of a file; nothing after an error.
std::optional<gltf::Parts> parts_of(Run& run, Reader& reader, OpenGltf& open, const GltfChoice& choice,
                                    Span span) {
  const auto unknown = [&](std::string_view noun, const std::string& name,
                           const std::vector<std::string>& names) {
    reader.error(reader.place(noun), fmt::format("'{}' has no {} called '{}'", open.name, noun, name),
                 help_of_names(name, names));
  };
  const std::vector<std::string> animations = open.file->animation_names();
  if (const auto& name = choice.animation; name && !name->empty()) {
    const auto count = std::count(animations.begin(), animations.end(), *name);
    if (count == 0) {
      unknown("animation", *name, animations);
      return std::nullopt;
    }
    if (count > 1)
      open.file->document().warn(fmt::format("has {} animations called '{}': the first plays", count, *name));
  }
  auto parts = open.file->parts(choice.node, play_of(run, choice));
  if (!parts) unknown("node", *choice.node, open.file->node_names());
  if (parts && parts->moves) ++run.context.time_reads;
  tell_warnings(run, open, span);
  return parts;
}

struct Surroundings {
  scene::MaterialId material;  // of all surfaces; invalid: those of the file
  const Overrides& overrides;
  const gltf::Play& play;
  std::optional<double> line_width;
  bool visible = true;
  Span span;
};

// What a surface is made of, and whether the file says so.
struct Coat {
  scene::MaterialId material;
  bool of_file = false;
};
Coat coat_of(Run& run, OpenGltf& open, const gltf::Surface& surface, bool colors,
             const Surroundings& around) {
  Coat coat{around.material, false};
  if (!coat.material.valid() && surface.material) {
    const auto other = around.overrides.find(*surface.material);
    coat.of_file = other == around.overrides.end();
    coat.material =
        coat.of_file ? material_of(run, open, *surface.material, colors, around.span) : other->second;
  }
  if (!coat.material.valid()) run.building->inherits_material = true;
  return coat;
}

void add_surface(Run& run, OpenGltf& open, const gltf::Surface& surface, scene::MeshId mesh,
                 const Surroundings& around) {
  const Coat coat = coat_of(run, open, surface, surface.colors, around);
  const auto index = static_cast<std::uint32_t>(run.shapes().size());
  run.shapes().push_back(
      {scene::Mesh{mesh}, surface.file_from_mesh, coat.material, around.visible, around.span, 0});
  const auto medium = coat.of_file ? inside_of(run, open, *surface.material) : std::nullopt;
  if (!medium || !run.may_add_volumes(1, around.span)) return;
  scene::Volume volume{
      scene::Mesh{mesh}, surface.file_from_mesh, surface.file_from_mesh, *medium, {}, around.visible,
      around.span};
  volume.priority = 0;
  volume.boundary = index;
  run.volumes().push_back(std::move(volume));
}

using Lines = std::vector<std::array<Vec3d, 2>>;

// A 500th of the diagonal of the box around all lines.
double usual_width(const std::vector<const gltf::Surface*>& surfaces, const std::vector<Lines>& lines) {
  Vec3d lo(infinity), hi(-infinity);
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const auto& line : lines[i])
      for (const Vec3d& end : line) {
        const Vec3d p = surfaces[i]->file_from_mesh.point(end);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          lo[axis] = std::min(lo[axis], p[axis]);
          hi[axis] = std::max(hi[axis], p[axis]);
        }
      }
  return length(hi - lo) / 500;
}

// Lines as rods, each with ends of its own; those without a length are left out.
scene::StrandSet rods(const Lines& lines, double radius) {
  scene::StrandSet out;
  out.begin.push_back(0);
  for (const auto& line : lines) {
    if (line[0] == line[1]) continue;
    out.points.insert(out.points.end(), line.begin(), line.end());
    out.radii.insert(out.radii.end(), 2, radius);
    out.begin.push_back(static_cast<std::uint32_t>(out.points.size()));
  }
  return out;
}

// The poses that rods made of these lines take while the shutter is open, when the lines are those of a skin
// or of morph targets.
void add_poses(scene::StrandSet& rods, OpenGltf& open, const gltf::Surface& surface, const Lines& lines,
               const gltf::Play& play) {
  if (!surface.source.posed || play.span == 0) return;
  const PoseError error = add_later_poses(rods, [&](double fraction) {
    const Lines then = open.file->lines(surface, play.later(fraction));
    scene::StrandPose pose{{}, rods.radii};
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i][0] != lines[i][1]) pose.points.insert(pose.points.end(), then[i].begin(), then[i].end());
    return pose;
  });
  if (error.off_share > 1.5 / static_cast<double>(most_later_poses))
    open.file->document().warn(fmt::format(
        "has lines that move too unevenly while the shutter is open: of {} poses the blur is off by up to "
        "{:.2g} times what would be seen",
        rods.later.size() + 1, error.largest));
}

void add_lines(Run& run, OpenGltf& open, const gltf::Parts& parts, const Surroundings& around) {
  std::vector<const gltf::Surface*> surfaces;
  std::vector<Lines> lines;
  for (const gltf::Surface& surface : parts.surfaces) {
    if (surface.drawn != gltf::Drawn::lines) continue;
    surfaces.push_back(&surface);
    lines.push_back(run.structure.later() ? Lines{} : open.file->lines(surface, around.play));
  }
  if (surfaces.empty()) return;
  const double width = around.line_width.value_or(run.structure.later() ? 1 : usual_width(surfaces, lines));
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const gltf::Surface& surface = *surfaces[i];
    if (surface.colors)
      open.file->document().warn("has lines with colours of their points, which are left out");
    const double scale = std::cbrt(std::abs(surface.file_from_mesh.determinant()));
    const scene::StrandSetId strands(run.scene.strand_sets.size());
    run.scene.strand_sets.push_back(rods(lines[i], width / (2 * scale)));
    if (!run.structure.later()) add_poses(run.scene.strand_sets.back(), open, surface, lines[i], around.play);
    run.shapes().push_back({scene::Curves{strands}, surface.file_from_mesh,
                            coat_of(run, open, surface, false, around).material, around.visible, around.span,
                            0});
  }
}

// Lights and cameras are not scaled by their nodes.
Transform without_scale(const Transform& t) {
  return Transform::look_at(t.t, t.t - normalize(t.z), t.y).value_or(Transform::translate(t.t));
}

void add_parts(Run& run, OpenGltf& open, const gltf::Parts& parts, const Surroundings& around) {
  // A mesh that is posed for a node is the same in all its instances.
  std::map<std::array<std::uint32_t, 3>, std::optional<scene::MeshId>> posed;
  for (const gltf::Surface& surface : parts.surfaces) {
    if (surface.drawn != gltf::Drawn::triangles) continue;
    const auto& [mesh, primitive, node, is_posed] = surface.source;
    const auto [known, is_new] = posed.try_emplace({mesh, primitive, is_posed ? node : 0});
    if (is_new) known->second = mesh_of(run, open, surface, around.play);
    if (known->second) add_surface(run, open, surface, *known->second, around);
  }
  add_lines(run, open, parts, around);
  for (const gltf::PlacedLight& light : parts.lights)
    if (run.may_add_lights(1, around.span))
      add_light(run, {light.light, {}, around.span, "light of a glTF file"},
                without_scale(light.file_from_light));
}

// All that decides what an object holds, but for the file's own numbers.
std::string key_of(const NamedFile& file, const GltfParameters& given, const Overrides& overrides,
                   scene::MaterialId material) {
  std::string key =
      fmt::format("{}\n{}\n{}\n{} {} {} {} {} {}", file.path.string(), given.node.value_or("\n"),
                  given.animation.value_or("\n"), given.start, given.speed, given.loop, given.visible,
                  given.line_width.value_or(0), material.index);
  for (const auto& [index, other] : overrides) key += fmt::format(" {} {}", index, other.index);
  return key;
}

// The triangles of a node as one mesh in the file's space, with the poses that it takes while the shutter is
// open.
scene::TriangleMesh merged(gltf::File& file, const std::optional<std::string>& node, const gltf::Parts& parts,
                           const gltf::Play& play) {
  std::vector<std::pair<std::size_t, scene::TriangleMesh>> meshes;  // by the number of their surface
  scene::TriangleMesh all;
  for (std::size_t i = 0; i < parts.surfaces.size(); ++i) {
    const gltf::Surface& surface = parts.surfaces[i];
    auto mesh = surface.drawn == gltf::Drawn::triangles ? file.mesh(surface, play) : std::nullopt;
    if (!mesh) continue;
    const Transform& to = surface.file_from_mesh;
    const bool mirrored = to.determinant() < 0;
    const auto first = static_cast<std::uint32_t>(all.points.size());
    for (const Vec3d& p : mesh->points) all.points.push_back(to.point(p));
    for (const auto& t : mesh->triangles)
      all.triangles.push_back({first + t[0], first + t[mirrored ? 2 : 1], first + t[mirrored ? 1 : 2]});
    meshes.emplace_back(i, std::move(*mesh));
  }
  if (play.span == 0 || !parts.moves) return all;
  const PoseError error = add_later_poses(all, [&](double fraction) {
    scene::MeshPose pose;
    const auto now = file.parts(node, play.later(fraction));
    // A node that has no size for a moment keeps the place that it had.
    const bool alike = now && now->surfaces.size() == parts.surfaces.size();
    for (const auto& [i, mesh] : meshes) {
      const shapes::MeshAt at(mesh, fraction);
      const Transform& to = (alike ? *now : parts).surfaces[i].file_from_mesh;
      for (std::uint32_t k = 0; k < mesh.points.size(); ++k) pose.points.push_back(to.point(at.point(k)));
    }
    return pose;
  });
  // Of a mesh that takes as many poses by itself it is told already.
  if (std::any_of(meshes.begin(), meshes.end(),
                  [](const auto& mesh) { return mesh.second.later.size() == most_later_poses; }))
    return all;
  const std::string what = node ? fmt::format("has a node, '{}',", *node) : "has a scene";
  if (const auto told = uneven_motion(what, all, error)) file.document().warn(*told);
  return all;
}

}  // namespace

void run_gltf(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<GltfParameters>();
  reader.finish();
  if (given.line_width && !(*given.line_width > 0))
    reader.error(reader.place("line_width"),
                 fmt::format("'line_width' must be above 0, found {}", *given.line_width));
  const auto named = named_file(run, *site.tree, thing.file, site.scope);
  OpenGltf* const open = named ? run.imported.gltf(run, *named) : nullptr;
  if (!open || !reader.ok() || !run.may_repeat(1, header(thing))) return;
  const auto world_from_file = placed(reader, site, given.transform);
  if (!world_from_file) return;
  scene::MaterialId material;
  if (given.material.given()) {
    material = material_of(run, given.material);
    if (!material.valid()) return;
  }
  try {
    const auto overrides =
        overrides_of(run, reader, open->name, open->file->material_names(), given.materials);
    if (!overrides) return;
    auto& known = run.imported.objects[key_of(*named, given, *overrides, material)];
    if (!known) {
      const auto parts = parts_of(run, reader, *open, given, named->span);
      if (!parts || !run.may_repeat(static_cast<double>(parts->surfaces.size()), named->span)) return;
      const gltf::Play play = play_of(run, given);
      const Surroundings around{material, *overrides, play, given.line_width, given.visible, named->span};
      known = std::make_shared<const KnownObject>(
          make_object(run, open->name, [&] { add_parts(run, *open, *parts, around); }));
    }
    tell_warnings(run, *open, named->span);
    const bool needs_default = known->inherits_material && !site.material.valid() && !run.building;
    place_known(run, site, *known, *world_from_file,
                needs_default ? run.imported.gltf_default(run.scene) : site.material, named->span);
  } catch (const Malformed& m) {
    run.diagnostics.error(named->span, describe(m, open->name));
  }
}

std::optional<PlacedShape> read_gltf_shape(Run& run, Reader& reader, const NamedFile& file) {
  const auto given = reader.read<GltfShapeParameters>();
  OpenGltf* const open = run.imported.gltf(run, file);
  if (!open || !reader.ok()) return std::nullopt;
  try {
    const auto parts = parts_of(run, reader, *open, given, file.span);
    if (!parts) return std::nullopt;
    const gltf::Play play = play_of(run, given);
    scene::TriangleMesh all = merged(*open->file, given.node, *parts, play);
    tell_warnings(run, *open, file.span);
    if (all.triangles.empty()) {
      reader.error(file.span, fmt::format("'{}' has no triangles there", open->name));
      return std::nullopt;
    }
    const scene::MeshId id(run.scene.meshes.size());
    run.scene.meshes.push_back(std::move(all));
    return PlacedShape{scene::Mesh{id}, {}};
  } catch (const Malformed& m) {
    reader.error(file.span, describe(m, open->name));
    return std::nullopt;
  }
}

void run_gltf_camera(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  if (!first_of_its_kind(run, site, run.camera, header(thing), "camera")) return;
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<GltfCameraParameters>();
  const auto placement = reader.read<Placement>();
  reader.finish();
  const auto named = named_file(run, *site.tree, thing.file, site.scope);
  OpenGltf* const open = named ? run.imported.gltf(run, *named) : nullptr;
  if (!open || !reader.ok()) return;
  try {
    const auto parts = parts_of(run, reader, *open, given, named->span);
    if (!parts) return;
    const auto is_meant = [&](const gltf::PlacedCamera& camera) {
      return !given.name || camera.name == *given.name;
    };
    const auto found = std::find_if(parts->cameras.begin(), parts->cameras.end(), is_meant);
    if (given.name && found != parts->cameras.end() && std::any_of(found + 1, parts->cameras.end(), is_meant))
      run.diagnostics.warning(
          reader.place("name"),
          fmt::format("'{}' has several cameras called '{}': the first is taken", open->name, *given.name));
    if (found == parts->cameras.end()) {
      std::vector<std::string_view> names;
      for (const auto& camera : parts->cameras) names.push_back(camera.name);
      return reader.error(given.name ? reader.place("name") : named->span,
                          given.name ? fmt::format("'{}' has no camera called '{}'", open->name, *given.name)
                                     : fmt::format("'{}' has no camera", open->name),
                          names.empty() ? "" : fmt::format("it has: {}", fmt::join(names, ", ")));
    }
    std::visit(
        [&](auto camera) {
          static_cast<scene::CameraView&>(camera) = given;
          set_camera(run, site, reader, header(thing), camera,
                     placement.transform * without_scale(found->file_from_camera));
        },
        found->camera);
  } catch (const Malformed& m) {
    reader.error(named->span, describe(m, open->name));
  }
}

}  // namespace tyndall::resolve
