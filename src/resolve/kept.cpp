#include "resolve/kept.h"

#include <algorithm>

#include "resolve/kept_parts.h"

namespace tyndall::resolve {

namespace {

bool reads_time(const vm::Program& program) { return program.reads(vm::Input::time); }

// Whether a shader is another one at another time.
bool shaders_read_time(const scene::Scene& scene) {
  const auto medium_does = [](const scene::Medium& m) {
    return reads_time(m.full) || reads_time(m.extinction) || reads_time(m.lattice_places.program);
  };
  const auto material_does = [](const scene::Material& m) {
    return reads_time(m.program) || reads_time(m.lattice_places.program);
  };
  return std::any_of(scene.media.begin(), scene.media.end(), medium_does) ||
         std::any_of(scene.materials.begin(), scene.materials.end(), material_does);
}

}  // namespace

Kept::Kept() : parts_(std::make_unique<KeptParts>()) {}
Kept::~Kept() = default;

void Kept::forget_files() {
  still = false;
  parts_->images.clear();
  parts_->grids = {};
  parts_->imported = {};
}

KeptParts* kept_parts(const Run& run) { return run.options.kept ? &run.options.kept->parts() : nullptr; }

void keep_parts(Run& run) {
  if (!run.options.kept) return;
  Kept& kept = *run.options.kept;
  const bool good = !run.diagnostics.has_errors();
  const eval::Context& context = run.context;
  kept.animation = run.foreseen;
  kept.timeless = context.time_reads == 0 && context.frame_reads == 0;
  kept.still = good && kept.timeless && !shaders_read_time(run.scene);
  KeptParts& parts = kept.parts();
  // A mistake is told anew by each frame that has it.
  parts.trees = good ? run.includes.trees : decltype(parts.trees){};
  parts.overrides = good ? run.overrides : std::vector<Override>{};
  run.images.keep_in(parts);
  run.grids.keep_in(parts);
  run.imported.keep_in(parts, run.options.files_read);
}

}  // namespace tyndall::resolve
