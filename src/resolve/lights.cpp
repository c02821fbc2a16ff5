// Light statements, and how lights move to world space.
#include <fmt/format.h>

#include <cmath>

#include "resolve/placement.h"
#include "resolve/run.h"

namespace tyndall::resolve {

std::optional<double> similarity_scale(const Transform& t) {
  constexpr double tolerance = 1e-6;
  const double x2 = length_squared(t.x), y2 = length_squared(t.y), z2 = length_squared(t.z);
  const double scale2 = (x2 + y2 + z2) / 3;
  const auto close = [&](double a, double b) { return std::abs(a - b) <= tolerance * scale2; };
  if (!close(x2, scale2) || !close(y2, scale2) || !close(z2, scale2)) return std::nullopt;
  if (!close(dot(t.x, t.y), 0) || !close(dot(t.y, t.z), 0) || !close(dot(t.z, t.x), 0)) return std::nullopt;
  return std::sqrt(scale2);
}

bool to_world(optics::PointLight& light, const Transform& world_from_local) {
  light.position = world_from_local.point(light.position);
  return true;
}

bool to_world(optics::SpotLight& light, const Transform& world_from_local) {
  if (!similarity_scale(world_from_local)) return false;
  light.position = world_from_local.point(light.position);
  light.to = world_from_local.point(light.to);
  return true;
}

bool to_world(optics::SphereLight& light, const Transform& world_from_local) {
  const std::optional<double> scale = similarity_scale(world_from_local);
  if (!scale) return false;
  light.center = world_from_local.point(light.center);
  light.radius *= *scale;
  return true;
}

bool to_world(optics::QuadLight& light, const Transform& world_from_local) {
  light.center = world_from_local.point(light.center);
  light.u = world_from_local.vector(light.u);
  light.v = world_from_local.vector(light.v);
  // A mirroring map turns u × v around; swapped, the light still shines where its statement says.
  if (world_from_local.determinant() < 0) std::swap(light.u, light.v);
  return true;
}

bool to_world(optics::DiskLight& light, const Transform& world_from_local) {
  const std::optional<double> scale = similarity_scale(world_from_local);
  if (!scale) return false;
  light.center = world_from_local.point(light.center);
  light.normal = normalize(world_from_local.vector(light.normal));
  light.radius *= *scale;
  return true;
}

bool to_world(optics::MeshLight& light, const Transform& world_from_local) {
  light.world_from_shape = world_from_local * light.world_from_shape;
  return light.world_from_shape.inverse().has_value();
}

bool to_world(optics::DistantLight& light, const Transform& world_from_local) {
  light.direction = normalize(world_from_local.vector(light.direction));
  return true;
}

bool to_world(optics::EnvironmentLight& light, const Transform& world_from_local) {
  if (!light.radiance.picture[0]) return true;
  const std::optional<double> scale = similarity_scale(world_from_local);
  if (!scale) return false;
  const Transform& t = world_from_local;
  light.world_from_sky = Transform{t.x / *scale, t.y / *scale, t.z / *scale, {}} * light.world_from_sky;
  return true;
}

void add_light(Run& run, ObjectLight light, const Transform& world_from_light) {
  if (run.building) {
    // As read: only where the object is placed is it known whether the maps together stretch it.
    light.object_from_light = world_from_light;
    run.building->lights.push_back(std::move(light));
    return;
  }
  // The area of a stretched tube, and so its power, has no plain form.
  const bool tube = light.shape && std::holds_alternative<scene::Cylinder>(*light.shape);
  if (!std::visit([&](auto& l) { return to_world(l, world_from_light); }, light.light) ||
      (tube && !similarity_scale(std::get<optics::MeshLight>(light.light).world_from_shape)))
    return run.diagnostics.error(light.definition,
                                 fmt::format("a '{}' cannot be stretched or sheared", light.statement),
                                 "use one scale for all axes in the transforms around it");
  run.scene.lights.push_back({light.light, light.definition, light.shape});
}

template <class Light>
void run_light(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  Light light = reader.read_valid<Light>();
  const auto placement = reader.read<Placement>();
  reader.finish();
  if (!reader.ok()) return;
  add_light(run, {light, {}, header(thing), row.name}, site.world_from_local * placement.transform);
}

// Spheres, quads and disks are lights of their own.
void run_mesh_light(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<MeshLightParameters>();
  const auto light = reader.read_valid<optics::MeshLight>();
  const auto placement = reader.read<Placement>();
  std::optional<PlacedShape> in;
  if (given.in.given()) in = read_shape_value(run, given.in, Inside::any, reader);
  reader.finish();
  if (!reader.ok() || !in) return;
  if (std::holds_alternative<scene::Plane>(in->shape))
    return reader.error(given.in.span, "a plane has no end: its light would be endless", "write a quad");
  if (std::holds_alternative<scene::Curves>(in->shape))
    return reader.error(given.in.span, "curves cannot be a light",
                        "give `curves` a material with `emission`: then they are seen to glow");
  ObjectLight out{light, {}, header(thing), row.name};
  if (const auto* s = std::get_if<scene::Sphere>(&in->shape))
    out.light = optics::SphereLight{s->center, s->radius, light.power, light.radiance, light.visible};
  else if (const auto* q = std::get_if<scene::Quad>(&in->shape))
    out.light = optics::QuadLight{q->center, q->u, q->v, light.power, light.radiance, light.visible};
  else if (const auto* d = std::get_if<scene::Disk>(&in->shape))
    out.light =
        optics::DiskLight{d->center, d->normal, d->radius, light.power, light.radiance, light.visible};
  else
    out.shape = in->shape;
  add_light(run, out, site.world_from_local * placement.transform * in->outer_from_shape);
}

template void run_light<optics::PointLight>(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template void run_light<optics::SpotLight>(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template void run_light<optics::SphereLight>(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template void run_light<optics::QuadLight>(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template void run_light<optics::DiskLight>(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template void run_light<optics::DistantLight>(Run&, const Site&, const syntax::ThingItem&, const Statement&);
template void run_light<optics::EnvironmentLight>(Run&, const Site&, const syntax::ThingItem&,
                                                  const Statement&);

}  // namespace tyndall::resolve
