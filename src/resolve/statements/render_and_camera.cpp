// The statements that occur once: render, animation, camera.
#include <fmt/format.h>

#include <cmath>

#include "resolve/resolve_context.h"
#include "resolve/statements/animation.h"

namespace tyndall::resolve {

namespace {

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

void run_render(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  if (!first_of_its_kind(run, site, run.render, header(thing), row.name)) return;
  Reader reader = reader_of(run, site, thing, row);
  const auto settings = reader.read_valid<scene::RenderSettings>();
  reader.finish();
  if (reader.ok()) run.scene.settings = settings;
}

void run_animation(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  if (site.scope != run.file_scope || site.tree != run.main)
    return run.diagnostics.error(header(thing), "'animation' belongs at the top level of the main file only");
  if (!first_of_its_kind(run, site, run.animation, header(thing), row.name)) return;
  Reader reader = reader_of(run, site, thing, row);
  const scene::Animation animation = read_animation(reader);
  if (!reader.ok()) return;
  if (!run.foreseen || !same(animation, *run.foreseen))
    return run.diagnostics.error(header(thing), "'animation' depends on `time`, `frame` or an included file",
                                 "it decides what they are: use numbers, and the lets above it in this file");
  run.scene.animation = animation;
  if (const std::optional<int>& frame = run.options.frame;
      run.options.warns_of_frame && frame &&
      (*frame < animation.first_frame || *frame > animation.last_frame))
    run.diagnostics.warning(reader.place("frames"),
                            fmt::format("--frame {} is outside of these frames, {} to {}", *frame,
                                        animation.first_frame, animation.last_frame),
                            "what moves is taken beyond them as it is written");
}

void set_camera(Run& run, const Site& site, Reader& reader, Span here, scene::Camera camera,
                const Transform& transform) {
  const Transform world_from_local = site.world_from_local * transform;
  const std::optional<double> scale = similarity_scale(world_from_local);
  if (!scale)
    return reader.error(here, "a camera cannot be stretched or sheared",
                        "use one scale for all axes in the transforms around it");
  std::visit([&](auto& c) { move(c, world_from_local, *scale); }, camera);
  run.scene.camera = camera;
}

template <class Camera>
void run_camera(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  if (!first_of_its_kind(run, site, run.camera, header(thing), "camera")) return;
  Reader reader = reader_of(run, site, thing, row);
  Camera camera = reader.read_valid<Camera>();
  const auto placement = reader.read<Placement>();
  reader.finish();
  if (reader.ok()) set_camera(run, site, reader, header(thing), camera, placement.transform);
}

template void run_camera<scene::PerspectiveCamera>(Run&, const Site&, const syntax::ThingItem&,
                                                   const Statement&);
template void run_camera<scene::OrthographicCamera>(Run&, const Site&, const syntax::ThingItem&,
                                                    const Statement&);
template void run_camera<scene::SphericalCamera>(Run&, const Site&, const syntax::ThingItem&,
                                                 const Statement&);

}  // namespace tyndall::resolve
