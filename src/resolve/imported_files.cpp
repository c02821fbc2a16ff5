#include "resolve/imported_files.h"

#include <fmt/format.h>

#include "import/file_bytes.h"
#include "import/malformed.h"
#include "import/pbr/material_program.h"
#include "resolve/kept_parts.h"

namespace tyndall::resolve {

namespace {

// A file as another run of the same or another frame has it: open, and nothing of it in a scene.
OpenGltf again(const OpenGltf& open) {
  return {open.file, open.name, {}, {}, {}, open.warnings_told, open.kept_meshes, open.files_read};
}
OpenMeshes again(const OpenMeshes& open) { return {open.file, open.meshes, open.files_read}; }

// Finds what a file names beside it, and notes it for frames that find the file open.
FindFile beside(const Run& run, const NamedFile& named, std::shared_ptr<std::set<std::string>> files_read) {
  return [options = run.options, path = named.path, files_read = std::move(files_read)](
             const std::string& other, std::string& why) {
    auto found = find_beside(options, path, other, why);
    if (found) files_read->insert(found->string());
    return found;
  };
}

}  // namespace

void ImportedFiles::share(const ImportedFiles& other) {
  for (const auto& [path, open] : other.gltfs_)
    gltfs_.emplace(path, open ? std::make_unique<OpenGltf>(again(*open)) : nullptr);
  for (const auto& [path, open] : other.meshes_)
    meshes_.emplace(path, open ? std::make_unique<OpenMeshes>(again(*open)) : nullptr);
}

void ImportedFiles::keep_in(KeptParts& parts, std::set<std::string>* files_read) {
  const auto tell = [files_read](const auto& files) {
    for (const auto& [path, open] : files)
      if (open && files_read) files_read->insert(open->files_read->begin(), open->files_read->end());
  };
  tell(gltfs_);
  tell(meshes_);
  parts.imported = {};
  parts.imported.share(*this);
}

bool ImportedFiles::take_kept_gltf(Run& run, const std::string& path) {
  KeptParts* kept = kept_parts(run);
  if (!kept) return false;
  const auto before = kept->imported.gltfs_.find(path);
  const bool is_kept = before != kept->imported.gltfs_.end() && before->second;
  run.options.kept->files.count(is_kept);
  if (!is_kept) return false;
  gltfs_[path] = std::make_unique<OpenGltf>(again(*before->second));
  gltfs_[path]->file->document().begin_frame();
  return true;
}

bool ImportedFiles::take_kept_meshes(Run& run, const std::string& path) {
  KeptParts* kept = kept_parts(run);
  if (!kept) return false;
  const auto before = kept->imported.meshes_.find(path);
  const bool is_kept = before != kept->imported.meshes_.end() && before->second;
  run.options.kept->files.count(is_kept);
  if (is_kept) meshes_[path] = std::make_unique<OpenMeshes>(again(*before->second));
  return is_kept;
}

scene::MaterialId ImportedFiles::gltf_default(scene::Scene& scene) {
  if (!gltf_default_.valid())
    gltf_default_ = scene::add_surface(
        scene, {.parameters = {.base_color = Rgb(1.0f), .metallic = 1, .roughness = 1}, .ior = 1.5f});
  return gltf_default_;
}

OpenGltf* ImportedFiles::gltf(Run& run, const NamedFile& named) {
  const auto [known, is_new] = gltfs_.try_emplace(named.path.string());
  if (!is_new || take_kept_gltf(run, named.path.string())) return known->second.get();
  const std::string name = named.path.filename().string();
  try {
    auto files = std::make_shared<std::set<std::string>>();
    known->second = std::make_unique<OpenGltf>(
        OpenGltf{std::make_shared<gltf::File>(read_file_bytes(named.path), beside(run, named, files)),
                 name,
                 {},
                 {},
                 {},
                 0,
                 {},
                 files});
  } catch (const Malformed& m) {
    run.diagnostics.error(named.span, describe(m, name));
  }
  return known->second.get();
}

OpenMeshes* ImportedFiles::meshes(Run& run, const NamedFile& named) {
  const auto [known, is_new] = meshes_.try_emplace(named.path.string());
  if (!is_new || take_kept_meshes(run, named.path.string())) return known->second.get();
  const std::string name = named.path.filename().string();
  try {
    auto files = std::make_shared<std::set<std::string>>();
    auto file = std::make_shared<mesh_file::MeshFile>(mesh_file::read(named.path, beside(run, named, files)));
    for (const std::string& warning : file->warnings)
      run.diagnostics.warning(named.span, fmt::format("'{}' {}", name, warning));
    std::vector<scene::SharedMesh> meshes;
    for (mesh_file::Part& part : file->parts) meshes.emplace_back(std::move(part.mesh));
    known->second =
        std::make_unique<OpenMeshes>(OpenMeshes{std::move(file), std::move(meshes), std::move(files)});
  } catch (const Malformed& m) {
    run.diagnostics.error(named.span, describe(m, name));
  }
  return known->second.get();
}

void tell_warnings(Run& run, OpenGltf& open, Span span) {
  const auto& warnings = open.file->warnings();
  for (; open.warnings_told < warnings.size(); ++open.warnings_told)
    run.diagnostics.warning(span, fmt::format("'{}' {}", open.name, warnings[open.warnings_told]));
}

std::optional<scene::MeshId> mesh_of(Run& run, OpenGltf& open, const gltf::Surface& surface,
                                     const gltf::Play& play) {
  const gltf::MeshSource& source = surface.source;
  const std::pair key{source.mesh, source.primitive};
  if (const auto known = open.meshes.find(key); !source.posed && known != open.meshes.end())
    return known->second;
  const auto kept = open.kept_meshes.find(key);
  std::optional<scene::SharedMesh> mesh;
  if (!source.posed && kept != open.kept_meshes.end())
    mesh = kept->second;
  else if (!run.structure.later())
    mesh = open.file->mesh(surface, play);
  else if (!open.file->known_to_be_empty(source))
    mesh = scene::TriangleMesh{};
  std::optional<scene::MeshId> id;
  if (mesh) {
    note_asset(run,
               {open.name, "mesh", fmt::format("meshes[{}].primitives[{}]", source.mesh, source.primitive)},
               (*mesh)->bytes());
    if (!source.posed && !run.structure.later()) open.kept_meshes.insert_or_assign(key, *mesh);
    id = scene::MeshId(run.scene.meshes.size());
    run.scene.meshes.push_back(std::move(*mesh));
  }
  if (!source.posed) open.meshes.emplace(key, id);
  return id;
}

scene::MaterialId material_of(Run& run, OpenGltf& open, std::uint32_t index, bool colors, Span span) {
  const auto [known, is_new] = open.materials.try_emplace({index, colors});
  if (!is_new) return known->second;
  const scene::Material& material = open.file->compiled_material(index, colors, span);
  for (const PlanePointer& plane : material.program.tables.planes)
    note_asset(run, {open.name, "texture", plane->name}, plane->bytes());
  known->second = scene::MaterialId(run.scene.materials.size());
  run.scene.materials.push_back(material);
  if (material.transmission || material.opacity) run.bodies.may_let_through.insert(known->second.index);
  return known->second;
}

std::optional<scene::MediumId> inside_of(Run& run, OpenGltf& open, std::uint32_t material) {
  const auto [known, is_new] = open.insides.try_emplace(material);
  if (is_new)
    if (const auto medium = pbr::inside_of(open.file->material(material)))
      known->second = scene::add_constant_medium(run.scene, *medium);
  return known->second;
}

}  // namespace tyndall::resolve
