// The statements that occur once: render, animation, camera.
#include <fmt/format.h>

#include <cmath>

#include "resolve/animation.h"
#include "resolve/placement.h"
#include "resolve/run.h"

namespace tyndall::resolve {

namespace {

// False, after an error, when the statement was met before or stands in an object.
bool first_of_its_kind(Run& run, const Site& site, Span& met, Span here, std::string_view name) {
  if (site.in_object) {
    run.diagnostics.error(here, fmt::format("'{}' cannot stand in an object", name), "put it outside");
    return false;
  }
  if (met.valid()) {
    run.diagnostics.error(here, fmt::format("'{}' is given twice", name), "a scene has one",
                          {{met, "first given here"}});
    return false;
  }
  met = here;
  return true;
}

void move(scene::PerspectiveCamera& camera, const Transform& world_from_local, double scale) {
  camera.from = world_from_local.point(camera.from);
  camera.to = world_from_local.point(camera.to);
  camera.up = world_from_local.vector(camera.up);
  camera.aperture *= scale;
  camera.focus *= scale;
}

void move(scene::OrthographicCamera& camera, const Transform& world_from_local, double scale) {
  camera.from = world_from_local.point(camera.from);
  camera.to = world_from_local.point(camera.to);
  camera.up = world_from_local.vector(camera.up);
  camera.height *= scale;
}

void move(scene::SphericalCamera& camera, const Transform& world_from_local, double) {
  camera.from = world_from_local.point(camera.from);
  camera.to = world_from_local.point(camera.to);
  camera.up = world_from_local.vector(camera.up);
}

}  // namespace

void run_render(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  if (!first_of_its_kind(run, site, run.render, header(thing), row.name)) return;
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<RenderParameters>();
  reader.finish();
  const scene::RenderSettings settings{given.resolution.x, given.resolution.y,       given.samples,
                                       given.step,         given.light_samples,      given.bounces,
                                       given.seed,         given.multiple_scattering};
  if (reader.ok()) reader.report(scene::validate(settings));
  if (reader.ok()) run.scene.settings = settings;
}

void run_animation(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  if (site.scope != run.file_scope || site.tree != run.main)
    return run.diagnostics.error(header(thing), "'animation' stands at the top level of the main file only");
  if (!first_of_its_kind(run, site, run.animation, header(thing), row.name)) return;
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const scene::Animation animation = read_animation(reader);
  if (!reader.ok()) return;
  if (!run.foreseen || !same(animation, *run.foreseen))
    return run.diagnostics.error(header(thing), "'animation' depends on `time`, `frame` or an included file",
                                 "it decides what they are: use numbers, and the lets above it in this file");
  run.scene.animation = animation;
  if (const std::optional<int>& frame = run.options.frame;
      frame && (*frame < animation.first_frame || *frame > animation.last_frame))
    run.diagnostics.warning(reader.place("frames"),
                            fmt::format("--frame {} is outside of these frames, {} to {}", *frame,
                                        animation.first_frame, animation.last_frame),
                            "what moves is taken beyond them as it is written");
}

template <class Camera>
void run_camera(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  if (!first_of_its_kind(run, site, run.camera, header(thing), "camera")) return;
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  Camera camera = reader.read_valid<Camera>();
  const auto placement = reader.read<Placement>();
  reader.finish();
  if (!reader.ok()) return;
  const Transform world_from_local = site.world_from_local * placement.transform;
  const std::optional<double> scale = similarity_scale(world_from_local);
  if (!scale)
    return reader.error(header(thing), "a camera cannot be stretched or sheared",
                        "use one scale for all axes in the transforms around it");
  move(camera, world_from_local, *scale);
  run.scene.camera = camera;
}

template void run_camera<scene::PerspectiveCamera>(Run&, const Site&, const syntax::ThingItem&,
                                                   const Statement&);
template void run_camera<scene::OrthographicCamera>(Run&, const Site&, const syntax::ThingItem&,
                                                    const Statement&);
template void run_camera<scene::SphericalCamera>(Run&, const Site&, const syntax::ThingItem&,
                                                 const Statement&);

}  // namespace tyndall::resolve
