// mesh "scan.ply" { … }: files of triangles.
#include <fmt/format.h>

#include "import/malformed.h"
#include "resolve/statements/imported.h"

namespace tyndall::resolve {

namespace {

scene::MeshId add_mesh(Run& run, scene::SharedMesh mesh) {
  run.scene.meshes.push_back(std::move(mesh));
  return scene::MeshId(run.scene.meshes.size() - 1);
}

void note_parts(Run& run, const NamedFile& named, const OpenMeshes& open) {
  std::uint64_t bytes = 0;
  for (const scene::SharedMesh& mesh : open.meshes) bytes += mesh->bytes();
  note_asset(run, {named.path.string(), "mesh", ""}, bytes);
}

// The meshes of the file's parts, put into the scene when they are first asked for.
const std::vector<scene::MeshId>& parts_of(Run& run, OpenMeshes& open) {
  if (open.parts.empty())
    for (const scene::SharedMesh& mesh : open.meshes) open.parts.push_back(add_mesh(run, mesh));
  return open.parts;
}

scene::MaterialId material_of(Run& run, OpenMeshes& open, std::uint32_t material, Span span) {
  const auto known = open.materials.find(material);
  if (known != open.materials.end()) return known->second;
  const scene::MaterialId id(run.scene.materials.size());
  run.scene.materials.push_back(mesh_file::compiled(*open.file, material, span));
  const scene::Material& added = run.scene.materials.back();
  if (added.transmission || added.opacity) run.bodies.may_let_through.insert(id.index);
  open.materials.emplace(material, id);
  return id;
}

void add_parts(Run& run, OpenMeshes& open, const Overrides& overrides, scene::MaterialId of_all, bool visible,
               Span span) {
  const std::vector<scene::MeshId> meshes = parts_of(run, open);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto of_file = open.file->parts[i].material;
    scene::MaterialId material = of_all;
    if (const auto other = of_file ? overrides.find(*of_file) : overrides.end();
        !material.valid() && other != overrides.end())
      material = other->second;
    if (!material.valid() && of_file) material = material_of(run, open, *of_file, span);
    if (!material.valid()) run.building->inherits_material = true;
    run.shapes().push_back({scene::Mesh{meshes[i]}, {}, material, visible, span, 0});
  }
}

}  // namespace

void run_mesh_file(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<MeshFileParameters>();
  reader.finish();
  const auto named = named_file(run, *site.tree, thing.file, site.scope);
  if (!named || !reader.ok() || !run.may_repeat(1, header(thing))) return;
  const auto world_from_file = placed(reader, site, given.transform);
  if (!world_from_file) return;
  scene::MaterialId material;
  if (given.material.given()) {
    material = material_of(run, given.material);
    if (!material.valid()) return;
  }
  std::string key = fmt::format("mesh\n{}\n{} {}", named->path.string(), given.visible, material.index);
  for (const MaterialOverrides::Entry& entry : given.materials.entries)
    key += fmt::format(" {}={}", entry.name, material_of(run, entry.material).index);
  auto& known = run.imported.objects[key];
  if (!known) {
    OpenMeshes* const open = run.imported.meshes(run, *named);
    if (!open) return;
    if (open->parts.empty()) note_parts(run, *named, *open);
    std::vector<std::string> names;
    for (const pbr::Material& m : open->file->materials) names.push_back(m.name);
    const std::string name = named->path.filename().string();
    const auto overrides = overrides_of(run, reader, name, names, given.materials);
    if (!overrides) return;
    try {
      known = std::make_shared<const KnownObject>(make_object(
          run, name, [&] { add_parts(run, *open, *overrides, material, given.visible, named->span); }));
    } catch (const Malformed& m) {
      return run.diagnostics.error(named->span, describe(m, name));
    }
  }
  place_known(run, site, *known, *world_from_file, site.material, named->span);
}

std::optional<PlacedShape> read_mesh_file_shape(Run& run, Reader& reader, const NamedFile& named) {
  reader.read<MeshFileShapeParameters>();
  OpenMeshes* const open = run.imported.meshes(run, named);
  if (!open) return std::nullopt;
  const std::vector<scene::MeshId>& parts = parts_of(run, *open);
  if (parts.size() == 1) return PlacedShape{scene::Mesh{parts[0]}, {}};
  scene::TriangleMesh all;
  for (const scene::MeshId part : parts) {
    const scene::TriangleMesh& mesh = *run.scene.meshes[part.index];
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), mesh.points.begin(), mesh.points.end());
    for (const auto& t : mesh.triangles) all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return PlacedShape{scene::Mesh{add_mesh(run, std::move(all))}, {}};
}

}  // namespace tyndall::resolve
