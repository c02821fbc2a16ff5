#include "compile/compiled_scene.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/overloaded.h"
#include "compile/coarse_fields.h"
#include "compile/emitters.h"
#include "compile/geometry.h"
#include "compile/hit_error.h"
#include "compile/light_tree.h"
#include "compile/majorant_grid.h"
#include "compile/solids.h"
#include "compile/volume_grids.h"
#include "optics/sky.h"
#include "vm/machine.h"

namespace tyndall::compile {

namespace {

// Up to this many lights are weighed one by one.
constexpr std::size_t few_lights = 8;

Transform inverse_of(const Transform& t) {
  const auto inverse = t.inverse();
  CHECK(inverse.has_value());  // resolve refuses transforms that flatten space
  return *inverse;
}

Vec3d camera_position(const scene::Camera& camera) {
  return std::visit([](const auto& c) { return c.from; }, camera);
}

// Moves a light's place. Its emitter and densities are made when `scene` is given.
optics::Light moved(const scene::Scene* scene, const scene::LightInstance& instance, const Vec3d& offset) {
  optics::Light out = instance.light;
  std::visit(Overloaded{[&](optics::PointLight& l) { l.position += offset; },
                        [&](optics::SphereLight& l) { l.center += offset; },
                        [&](optics::SpotLight& l) { l.position += offset, l.to += offset; },
                        [&](optics::QuadLight& l) { l.center += offset; },
                        [&](optics::DiskLight& l) { l.center += offset; },
                        [&](optics::MeshLight& l) {
                          l.world_from_shape.t += offset;
                          if (scene) l.emitter = emitter_of(*scene, *instance.shape, l.world_from_shape);
                        },
                        [](optics::DistantLight&) {},
                        [&](optics::EnvironmentLight& l) {
                          if (scene && l.radiance.picture[0]) l.sky = std::make_shared<const optics::Sky>(l);
                        }},
             out);
  return out;
}

bool grey(const scene::RgbOutputs& outputs) { return outputs[0] == outputs[1] && outputs[1] == outputs[2]; }

CompiledMedium compiled(const scene::Medium& medium) {
  CompiledMedium out;
  out.homogeneous = medium.homogeneous();
  out.constant = medium.full.constants.size() == medium.full.operand_count();
  const vm::Program& program = medium.extinction;
  const auto& outputs = medium.extinction_sigma_t;
  if (std::all_of(outputs.begin(), outputs.end(),
                  [&](auto k) { return program.constant(program.outputs[k]); })) {
    Rgb sigma_t;
    for (std::size_t c = 0; c < 3; ++c) sigma_t[c] = program.constants[program.outputs[outputs[c]]];
    if (all_finite(sigma_t) && min_component(sigma_t) >= 0) out.constant_sigma_t = sigma_t;
  }
  out.uses.assign(medium.full.outputs.size(), OutputUse::shown);
  const auto mark = [&](const scene::RgbOutputs& which) {
    for (const std::uint8_t k : which) out.uses[k] = OutputUse::coefficient;
  };
  for (const scene::PhaseLobe& lobe : medium.phase) {
    for (const auto& parameter : lobe.parameters)
      if (parameter.output) out.uses[*parameter.output] = OutputUse::parameter;
    if (lobe.weight.output) out.uses[*lobe.weight.output] = OutputUse::parameter;
  }
  mark(medium.sigma_t);
  mark(medium.sigma_s);
  if (medium.emission) mark(*medium.emission);
  return out;
}

// A number that is the same for the whole surface, as the program gives it at the scene's time.
float uniform_value(const vm::Program& program, std::uint8_t output, double at_time) {
  const vm::Operand operand = program.outputs[output];
  if (program.constant(operand)) return program.constants[operand];
  const float zero = 0, time = static_cast<float>(at_time);
  vm::BatchInputs inputs;
  inputs.lanes.fill(&zero);
  inputs[vm::Input::time] = &time;
  std::vector<float> values(program.outputs.size());
  std::vector<float*> rows;
  for (float& value : values) rows.push_back(&value);
  vm::run_reference(program, inputs, 1, rows);
  return values[output];
}

CompiledMaterial compiled(const scene::Material& material, double time) {
  CompiledMaterial out;
  out.matte = material.matte();
  out.opaque = !material.opacity;
  out.transmits = material.transmission.has_value();
  if (material.ior) {
    out.ior = uniform_value(material.program, *material.ior, time);
    const scene::GivenNumber& given = material.given[*material.ior];
    if (const double ior = out.ior; !given.name.empty() && !(ior >= given.lowest && ior <= given.highest)) {
      out.bad_ior = static_cast<float>(ior);  // a function of time has left the range
      out.ior = std::isnan(ior) ? given.lowest : std::clamp(ior, given.lowest, given.highest);
    }
  }
  return out;
}

// The relative indices of the boundaries of rough glass.
std::vector<double> rough_etas(const CompiledScene& world) {
  std::vector<double> etas;
  for (std::size_t i = 0; i < world.materials.size(); ++i)
    if (world.materials[i].transmits && world.scene.materials[i].roughness)
      etas.push_back(world.materials[i].ior);
  if (etas.empty() || !world.solids || world.solids->count() < 2) return etas;
  // Any two bodies may touch.
  std::vector<double> all;
  for (const CompiledMaterial& m : world.materials)
    if (m.transmits) all.push_back(m.ior);
  for (const double a : all)
    for (const double b : all) etas.push_back(a / b);
  return etas;
}

// Whether anything differs between rays of different times.
bool moves(const scene::Scene& scene) {
  const scene::Motion& m = scene.motion;
  if (scene.animation.shutter.radians == 0) return false;
  if (!m.camera.empty() || !m.shapes.empty() || !m.instances.empty() || !m.volumes.empty() ||
      !m.lights.empty())
    return true;
  const auto in_objects = [](const scene::Prototype& p) {
    return !p.moving_shapes.empty() || !p.moving_instances.empty();
  };
  return std::any_of(scene.prototypes.begin(), scene.prototypes.end(), in_objects) ||
         std::any_of(scene.media.begin(), scene.media.end(),
                     [](const scene::Medium& medium) { return medium.full.reads(vm::Input::time); }) ||
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const scene::Material& material) { return material.program.reads(vm::Input::time); });
}

// Bodies of glass are kept where they may overlap each other or volumes, and where volumes have priorities
// among themselves.
void add_solids(CompiledScene& world) {
  const auto ranks = volume_ranks(world.scene);
  for (std::size_t i = 0; i < ranks.size(); ++i) world.volumes[i].rank = ranks[i];
  const auto ranked = std::count_if(ranks.begin(), ranks.end(), [](const auto& r) { return r.has_value(); });
  if (!world.features.glass && ranked < 2) return;
  auto solids =
      std::make_unique<const Solids>(world.scene, world.origin, world.materials, world.geometry->parts());
  const bool cuts = std::any_of(ranks.begin(), ranks.end(), [](const auto& r) { return r && r->order < 0; });
  const double bodies = solids->count();
  // One body alone hides no boundary, but may stand on what is opaque.
  const bool overlap = bodies > 1 || (cuts && bodies > 0);
  world.features.see_through |= overlap;
  world.features.nested_glass =
      overlap || (bodies > 0 && !(solids->single() && !world.geometry->touches_another(*solids->single())));
  if (world.features.nested_glass || ranked > 1) world.solids = std::move(solids);
}

Features features_of(const CompiledScene& world) {
  Features f;
  f.volumes = !world.volumes.empty();
  f.surfaces = !world.scene.shapes.empty() || !world.scene.instances.empty();
  f.overlap = world.volumes.size() > 1;
  for (const CompiledVolume& v : world.volumes) {
    const scene::Medium& m = world.scene.media[v.medium];
    f.heterogeneous |= !m.homogeneous();
    f.chromatic |= !grey(m.sigma_t) || !grey(m.sigma_s) || (m.emission && !grey(*m.emission));
    f.chromatic_extinction |= !grey(m.sigma_t);
    f.medium_emission |= m.emission.has_value();
  }
  for (const optics::Light& light : world.lights) {
    std::visit(Overloaded{[&](const optics::PointLight&) { f.delta_lights = true; },
                          [&](const optics::SpotLight&) { f.delta_lights = true; },
                          [&](const optics::DistantLight& l) {
                            (l.angle.radians == 0 ? f.delta_lights : f.distant_discs) = true;
                          },
                          [&](const optics::EnvironmentLight&) { f.environment = true; },
                          [&](const auto&) { f.area_lights = true; }},
               light);
  }
  for (const scene::Material& m : world.scene.materials) {
    f.surface_emission |= m.emission.has_value();
    f.layered_surfaces |= !m.matte();
    f.glass |= m.transmission.has_value();
    f.see_through |= m.opacity.has_value();
    f.normals |= m.normal.has_value();
  }
  f.motion = moves(world.scene);
  return f;
}

}  // namespace

CompiledScene::CompiledScene() = default;
CompiledScene::~CompiledScene() = default;
CompiledScene::CompiledScene(CompiledScene&&) noexcept = default;

std::optional<SurfaceHit> CompiledScene::closest_hit(const Ray& ray, RayKind kind,
                                                     const HitOrder& after) const {
  return geometry->closest_hit(ray, kind, after);
}
bool CompiledScene::occluded(const Ray& ray, std::uint32_t target_light) const {
  return geometry->occluded(ray, target_light);
}
void CompiledScene::volume_intervals(const Ray& ray, RayKind kind, std::vector<VolumeInterval>& out) const {
  geometry->volume_intervals(ray, kind, out);
  if (solids) solids->cut(ray, kind, volumes, out);
}

CompiledVolume::Place CompiledVolume::moved(double time) const {
  const Transform render_from_world = Transform::translate(-origin);
  // What is flat for one moment is taken for what it is beside it.
  for (double beside = 0; beside < 1; beside = beside * 2 + 0x1p-20) {
    const scene::Volume v = scene::at(*motion, time < 0.5 ? time + beside : time - beside);
    const auto from_render = (render_from_world * v.world_from_shape).inverse(),
               to_medium = (render_from_world * v.world_from_medium).inverse();
    if (from_render && to_medium) return {v.shape, *from_render, *to_medium};
  }
  CHECK(false);  // resolve refuses transforms that flatten space
}

LightAt::LightAt(const CompiledScene& world, std::uint32_t index, double time)
    : light_(&world.lights[index]) {
  if (world.light_motion.empty() || !world.light_motion[index]) return;
  moved_ = moved(nullptr, scene::at(*world.light_motion[index], time), -world.origin);
  // What it is drawn by stays: a mesh that moves is never drawn (optics::importance), only met.
  if (auto* mesh = std::get_if<optics::MeshLight>(&*moved_))
    mesh->emitter = std::get<optics::MeshLight>(*light_).emitter;
  if (auto* sky = std::get_if<optics::EnvironmentLight>(&*moved_))
    sky->sky = std::get<optics::EnvironmentLight>(*light_).sky;
}

CompiledScene compile(scene::Scene scene) {
  CompiledScene world;
  world.scene = std::move(scene);
  world.origin = camera_position(world.scene.camera);
  const Transform render_from_world = Transform::translate(-world.origin);

  for (const scene::LightInstance& l : world.scene.lights)
    world.lights.push_back(moved(&world.scene, l, -world.origin));
  const scene::Motion& motion = world.scene.motion;
  std::vector<bool> light_moves(world.lights.size());
  for (const auto& light : motion.lights) light_moves[light.index] = true;
  const std::vector<std::uint32_t> glows = add_glowing_shapes(world.scene, render_from_world, world.lights);
  light_moves.resize(world.lights.size());
  for (const optics::Light& light : world.lights) {
    const auto* mesh = std::get_if<optics::MeshLight>(&light);
    world.light_errors.push_back(mesh && mesh->emitter
                                     ? largest_error(mesh->world_from_shape, mesh->emitter->center(),
                                                     mesh->emitter->radius(), world.origin)
                                     : 0);
  }
  if (!motion.lights.empty()) {
    world.light_motion.resize(world.lights.size());
    for (const auto& light : motion.lights) {
      world.light_motion[light.index] = &light;
      if (auto* mesh = std::get_if<optics::MeshLight>(&world.lights[light.index])) mesh->drawn = false;
    }
  }
  for (std::uint32_t i = 0; i < world.lights.size(); ++i)
    if (std::holds_alternative<optics::DistantLight>(world.lights[i])) world.distant_lights.push_back(i);
  if (world.lights.size() > few_lights)
    world.light_tree = std::make_unique<const LightTree>(world.lights, light_moves);

  for (const scene::Medium& m : world.scene.media) world.media.push_back(compiled(m));
  const std::vector<scene::Volume> volumes = scene::all_volumes(world.scene);
  world.volumes.reserve(volumes.size());
  for (const scene::Volume& v : volumes) {
    CompiledVolume out;
    out.medium = v.medium.index;
    out.render_from_shape = render_from_world * v.world_from_shape;
    out.shape_from_render = inverse_of(out.render_from_shape);
    out.medium_from_render = inverse_of(render_from_world * v.world_from_medium);
    out.step = v.step.value_or(world.scene.settings.step);
    out.shape = v.shape;
    out.visible = v.visible;
    out.origin = world.origin;
    world.volumes.push_back(std::move(out));
  }
  for (const auto& v : motion.volumes) world.volumes[v.index].motion = &v;

  for (const scene::Material& m : world.scene.materials)
    world.materials.push_back(compiled(m, world.scene.time));

  world.shutter_seconds = scene::shutter_seconds(world.scene.animation);
  world.features = features_of(world);
  world.geometry = std::make_unique<Geometry>(world.scene, world.features, world.origin, world.lights, glows,
                                              world.volumes);
  add_solids(world);
  if (world.features.layered_surfaces)
    world.albedo_tables = std::make_unique<const optics::AlbedoTables>(rough_etas(world));
  add_grids(world);
  world.coarse_fields = find_coarse_fields(world);
  return world;
}

}  // namespace tyndall::compile
