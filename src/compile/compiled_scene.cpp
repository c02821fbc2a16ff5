#include "compile/compiled_scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

#include "base/check.h"
#include "compile/coarse_fields.h"
#include "compile/geometry/geometry.h"
#include "compile/geometry/nested_dielectrics.h"
#include "compile/kept.h"
#include "compile/lights/glowing_shapes.h"
#include "compile/lights/light_tree.h"
#include "compile/majorant/build_majorant_grids.h"
#include "compile/majorant/majorant_grid.h"
#include "compile/steps/choose_steps.h"
#include "vm/run/machine.h"

namespace tyndall::compile {

namespace {

// Up to this many lights are weighed one by one.
constexpr std::size_t few_lights = 8;

Vec3d camera_position(const scene::Camera& camera) {
  return std::visit([](const auto& c) { return c.from; }, camera);
}

bool grey(const scene::RgbOutputs& outputs) { return outputs[0] == outputs[1] && outputs[1] == outputs[2]; }

// Of a medium with one lobe that is the same everywhere.
std::optional<optics::Phase> constant_phase(const std::vector<scene::PhaseLobe>& lobes) {
  if (lobes.size() != 1 || lobes[0].weight.output || !(lobes[0].weight.value > 0)) return std::nullopt;
  std::array<float, optics::most_phase_parameters> parameters{};
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (lobes[0].parameters[k].output) return std::nullopt;
    parameters[k] = lobes[0].parameters[k].value;
  }
  return optics::Phase(lobes[0].kind, parameters);
}

CompiledMedium compiled(const scene::Medium& medium) {
  CompiledMedium out{medium};
  out.uniform = medium.homogeneous();
  out.constant = medium.full.constants.size() == medium.full.operand_count();
  const vm::Program& program = medium.extinction;
  const auto& outputs = medium.extinction_sigma_t;
  if (std::all_of(outputs.begin(), outputs.end(),
                  [&](auto k) { return program.constant(program.outputs[k]); })) {
    Rgb sigma_t;
    for (std::size_t c = 0; c < 3; ++c) sigma_t[c] = program.constants[program.outputs[outputs[c]]];
    if (all_finite(sigma_t) && min_component(sigma_t) >= 0) out.constant_sigma_t = sigma_t;
  }
  out.constant_phase = constant_phase(medium.phase);
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
  out.reads_mesh =
      std::any_of(material.program.inputs.begin(), material.program.inputs.end(), vm::is_of_mesh);
  out.opaque = !material.opacity;
  out.transmits = material.transmission.has_value();
  if (material.ior) {
    out.ior = uniform_value(material.program, *material.ior, time);
    const scene::GivenNumber& given = material.given[*material.ior];
    if (const double ior = out.ior; !given.name.empty() && !(ior >= given.lowest && ior <= given.highest)) {
      out.bad_ior = static_cast<float>(ior);  // a function of time has left the range
      if (!given.branches.empty())
        out.bad_ior_branch =
            static_cast<std::size_t>(uniform_value(material.program, given.branch_output, time));
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
  if (!scene.animation.shutter.open()) return false;
  if (!m.camera.empty() || !m.shapes.empty() || !m.instances.empty() || !m.volumes.empty() ||
      !m.lights.empty())
    return true;
  const auto mesh_deforms = [](const scene::SharedMesh& mesh) { return !mesh->later.empty(); };
  const auto strands_deform = [](const scene::StrandSet& set) { return !set.later.empty(); };
  if (std::any_of(scene.meshes.begin(), scene.meshes.end(), mesh_deforms) ||
      std::any_of(scene.strand_sets.begin(), scene.strand_sets.end(), strands_deform))
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
    const CompiledMedium& m = world.media[v.medium];
    f.heterogeneous |= !m.uniform;
    f.proven_steps |= !m.uniform && v.step.proven;
    f.chromatic |= !grey(m.sigma_t) || !grey(m.sigma_s) || (m.emission && !grey(*m.emission));
    f.chromatic_extinction |= !grey(m.sigma_t);
    f.medium_emission |= m.emission.has_value();
  }
  for (const CompiledLight& light : world.lights) {
    switch (light.kind()) {
      case LightKind::delta:
        f.delta_lights = true;
        break;
      case LightKind::area:
        f.area_lights = true;
        break;
      case LightKind::distant_disc:
        f.distant_discs = true;
        break;
      case LightKind::environment:
        f.environment = true;
        break;
    }
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

void add_volumes(CompiledScene& world, const Transform& render_from_world) {
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
    world.volumes.push_back(std::move(out));
  }
  for (const auto& v : world.scene.motion.volumes)
    world.volumes[v.index].motion = std::make_shared<VolumeMotion>(v, world.origin);
}

// Whether a light's surface is a mesh that deforms.
bool deforms(const scene::Scene& scene, const scene::Light& light) {
  const auto* area = std::get_if<scene::AreaLight>(&light);
  const auto* mesh = area ? std::get_if<scene::Mesh>(&area->shape) : nullptr;
  return mesh && !scene.meshes[mesh->mesh.index]->later.empty();
}

// The scene's lights and glowing shapes; the result tells each shape's light, as add_glowing_shapes has it.
std::vector<std::uint32_t> compile_lights(CompiledScene& world, Kept& kept) {
  for (const scene::LightInstance& l : world.scene.lights)
    world.lights.emplace_back(l.light, LightSetting{world.scene, world.origin, &kept.skies});
  std::erase_if(kept.skies, [](const auto& sky) { return sky.use_count() == 1; });  // nobody's any more
  std::vector<std::uint32_t> glows = add_glowing_shapes(world.scene, world.origin, world.lights);
  std::vector<bool> moves(world.lights.size());
  for (const auto& motion : world.scene.motion.lights) {
    world.lights[motion.index].moves(&motion);
    moves[motion.index] = true;
  }
  for (std::uint32_t i = 0; i < world.scene.lights.size(); ++i)
    if (deforms(world.scene, world.scene.lights[i].light)) {
      world.lights[i].moves(world.lights[i].motion());
      moves[i] = true;
    }
  for (std::uint32_t i = 0; i < world.lights.size(); ++i)
    if (world.lights[i].toward()) world.distant_lights.push_back(i);
  if (world.lights.size() > few_lights)
    world.light_tree = std::make_unique<const LightTree>(world.lights, moves);
  return glows;
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

VolumeMotion::VolumeMotion(const scene::Moving<scene::Volume>& keys, const Vec3d& origin)
    : number_([] {
        static std::atomic<std::uint64_t> made{0};
        return ++made;
      }()),
      keys_(&keys),
      world_from_shape_(keys, 0),
      world_from_medium_(keys, 1),
      shape_changes_(scene::moves_within(keys)),
      origin_(origin) {}

std::optional<scene::Shape> VolumeMotion::shape(double time) const {
  return shape_changes_ ? std::optional(scene::at(*keys_, time).shape) : std::nullopt;
}

const VolumeMotion::Place& VolumeMotion::at(double time) const {
  thread_local std::array<Place, 512> places;  // more than the paths of a thread that are under way
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
  Place& place = places[((std::bit_cast<std::uint64_t>(time) ^ (number_ * odd)) * odd) >> 55];
  if (place.motion != number_ || place.time != time)
    place = {number_, time, from_render(world_from_shape_, time), from_render(world_from_medium_, time)};
  return place;
}

Transform VolumeMotion::from_render(const scene::MovingTransform& world_from_this, double time) const {
  for (double beside = 0; beside < 1; beside = beside * 2 + 0x1p-20) {
    Transform render_from_this = world_from_this.at(time < 0.5 ? time + beside : time - beside);
    render_from_this.t -= origin_;
    if (const auto inverse = render_from_this.inverse()) return *inverse;
  }
  CHECK(false);  // resolve refuses transforms that flatten space
}

LightAt::LightAt(const CompiledScene& world, std::uint32_t index, double time)
    : light_(&world.lights[index]) {
  if (light_->motion()) moved_ = light_->at(time, {world.scene, world.origin});
}

CompiledScene compile(scene::Scene scene) {
  Kept nothing;
  return compile(std::move(scene), nothing);
}

CompiledScene compile(scene::Scene scene, Kept& kept) {
  kept.reused_meshes = kept.reused_grids = {};
  CompiledScene world;
  world.scene = std::move(scene);
  world.origin = camera_position(world.scene.camera);
  const Transform render_from_world = Transform::translate(-world.origin);

  const std::vector<std::uint32_t> glows = compile_lights(world, kept);
  for (const scene::Medium& m : world.scene.media) world.media.push_back(compiled(m));
  add_volumes(world, render_from_world);

  for (const scene::Material& m : world.scene.materials)
    world.materials.push_back(compiled(m, world.scene.time));

  world.shutter_seconds = scene::shutter_seconds(world.scene.animation);
  world.features = features_of(world);
  world.geometry = std::make_unique<Geometry>(world.scene, world.features, world.origin, glows, world.volumes,
                                              compiled_meshes(world.scene.meshes, kept));
  add_solids(world);
  if (world.features.layered_surfaces) world.albedo_tables = albedo_tables(rough_etas(world), kept);
  add_grids(world, kept);
  choose_steps(world);
  kept.forget_the_rest();
  world.coarse_fields = find_coarse_fields(world);
  return world;
}

}  // namespace tyndall::compile
