// Light statements.
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

void add_light(Run& run, ObjectLight light, const Transform& world_from_light) {
  if (run.building) {
    // As read: only where the object is placed is it known whether the maps together stretch it.
    light.object_from_light = world_from_light;
    run.building->lights->list.emplace_back(std::move(light));
    return;
  }
  if (!std::visit([&](auto& l) { return l.to_world(world_from_light); }, light.light))
    return run.diagnostics.error(light.definition,
                                 fmt::format("a '{}' cannot be stretched or sheared", light.statement),
                                 "use one scale for all axes in the transforms around it");
  run.scene.lights.push_back({light.light, light.definition});
}

namespace {

template <class Light>
void run_light(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const Light light = reader.read_valid<Light>();
  const auto placement = reader.read<Placement>();
  reader.finish();
  if (!reader.ok() || !run.may_add_lights(1, header(thing))) return;
  add_light(run, {light, {}, header(thing), row.name}, site.world_from_local * placement.transform);
}

// A light that is named after its shape.
template <class S>
void run_shape_light(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const S shape = reader.read<LightShapeParameters<S>>();
  auto light = reader.read<scene::AreaLight>();
  light.shape = shape;
  const auto placement = reader.read<Placement>();
  reader.finish();
  if (reader.ok()) reader.report(light.validate());
  if (!reader.ok() || !run.may_add_lights(1, header(thing))) return;
  add_light(run, {light, {}, header(thing), row.name}, site.world_from_local * placement.transform);
}

void run_mesh_light(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<MeshLightParameters>();
  auto light = reader.read<scene::AreaLight>();
  const auto placement = reader.read<Placement>();
  std::optional<PlacedShape> in;
  if (given.in.given()) in = read_shape_value(run, given.in, Inside::any, reader);
  reader.finish();
  if (in) light.shape = in->shape;
  if (reader.ok()) reader.report(light.validate());
  if (!reader.ok() || !in || !run.may_add_lights(1, header(thing))) return;
  if (std::holds_alternative<scene::Plane>(in->shape))
    return reader.error(given.in.span, "a plane has no end: its light would be endless", "write a quad");
  if (shapes::parts_of(in->shape))
    return reader.error(given.in.span, "combined shapes cannot be a light",
                        "give them a material with `emission`: then they are seen to glow");
  if (std::holds_alternative<scene::Curves>(in->shape))
    return reader.error(given.in.span, "curves cannot be a light",
                        "give `curves` a material with `emission`: then they are seen to glow");
  add_light(run, {light, {}, header(thing), row.name},
            site.world_from_local * placement.transform * in->outer_from_shape);
}

// The sky as an environment, and the sun's disc as a distant light while any of it is above the horizon.
void run_sky_light(Run& run, const Site& site, const syntax::ThingItem& thing, const Statement& row) {
  Reader reader(run.evaluator, run.schemas, {site.tree, &site.scope, &run.statements}, thing.block, row.name,
                header(thing));
  const auto given = reader.read<SkyLightParameters>();
  const auto placement = reader.read<Placement>();
  reader.finish();
  if (reader.ok()) reader.report(given.validate());
  if (!reader.ok() || !run.may_add_lights(2, header(thing))) return;
  const Vec3d sun = normalize(given.sun);
  const auto daylight = optics::daylight(std::clamp(sun.y, -1.0, 1.0), given.turbidity);
  const Transform world_from_light = site.world_from_local * placement.transform;
  scene::EnvironmentLight sky;
  sky.radiance = {Rgb(Vec3d{1, 1, 1}), daylight->picture};
  sky.rotation = {optics::azimuth_of_sun(sun)};
  add_light(run, {sky, {}, header(thing), row.name}, world_from_light);
  if (std::max({daylight->sun.x, daylight->sun.y, daylight->sun.z}) == 0) return;
  scene::DistantLight disc;
  disc.direction = -sun;
  disc.irradiance = daylight->sun;
  disc.angle = {2 * optics::sun_angular_radius};
  add_light(run, {disc, {}, header(thing), row.name}, world_from_light);
}

template <class... S>
void add_shape_lights(std::vector<Statement>& rows, const std::variant<S...>*) {
  (rows.push_back({scene::light_keyword<S>,
                   {},
                   {},
                   run_shape_light<S>,
                   nullptr,
                   false,
                   list_names<LightShapeParameters<S>, scene::AreaLight, Placement>}),
   ...);
}

template <class Light>
void add_rows(std::vector<Statement>& rows) {
  if constexpr (std::is_same_v<Light, scene::AreaLight>) {
    add_shape_lights(rows, static_cast<const scene::LightShapes*>(nullptr));
    rows.push_back({scene::AreaLight::mesh_keyword, {}, {}, run_mesh_light});
    rows.push_back({SkyLightParameters::keyword,
                    {},
                    {},
                    run_sky_light,
                    nullptr,
                    false,
                    list_names<SkyLightParameters, Placement>});
  } else {
    rows.push_back({Light::keyword, {}, {}, run_light<Light>, nullptr, false, list_names<Light, Placement>});
  }
}

template <class... Light>
std::vector<Statement> rows_of(const std::variant<Light...>*) {
  std::vector<Statement> rows;
  (add_rows<Light>(rows), ...);
  return rows;
}

}  // namespace

std::vector<Statement> light_statements() { return rows_of(static_cast<const scene::Light*>(nullptr)); }

}  // namespace tyndall::resolve
