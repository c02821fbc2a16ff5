#include "compile/geometry/geometry.h"

#include <algorithm>

#include "base/numerics.h"
#include "compile/geometry/hit_error.h"
#include "compile/geometry/merge_curves.h"

namespace tyndall::compile {

namespace {

// The surface of an area light, in the space of its numbers.
scene::ShapeInstance surface_of_light(const scene::AreaLight& light) {
  scene::ShapeInstance surface;
  surface.shape = light.shape;
  surface.world_from_object = light.world_from_shape.value_or(Transform{});
  surface.visible = light.visible;
  return surface;
}

}  // namespace

Geometry::Geometry(const scene::Scene& scene, const Features& features, const Vec3d& origin,
                   std::span<const std::uint32_t> glows, std::span<const CompiledVolume> volumes,
                   std::vector<CompiledMesh> meshes)
    : meshes_(std::move(meshes)),
      curves_(group_strands(scene, glows)),
      world_(parts(), features.normals),
      volumes_(volumes),
      origin_(origin) {
  if (features.glass)
    for (CompiledMesh& mesh : meshes_) mesh.find_whether_closed();
  prototypes_.reserve(scene.prototypes.size());  // groups point to earlier ones
  for (const scene::Prototype& p : scene.prototypes) {
    Group group(parts(), features.normals);
    group.add(p.shapes, p.moving_shapes);
    group.add(p.instances, p.moving_instances, prototypes_);
    group.finish();
    prototypes_.push_back(std::move(group));
  }
  world_.add(scene.shapes, scene.motion.shapes, origin, glows);
  world_.add(scene.instances, scene.motion.instances, prototypes_, origin);
  light_surfaces_.reserve(scene.lights.size());
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const auto* light = std::get_if<scene::AreaLight>(&scene.lights[i].light);
    if (!light) continue;
    scene::AreaLight in_render_space = *light;
    in_render_space.translate(-origin);
    light_surfaces_.push_back(surface_of_light(in_render_space));
    world_.add_light(light_surfaces_.back(), i, moving_light_surface(scene, i, origin));
  }
  world_.finish();

  if (volumes.size() > few_things) {
    BoxesOverTime boxes;
    for (const CompiledVolume& v : volumes)
      boxes.add(v.motion || deforms(v.shape, parts()),
                [&](const Intervald& time) { return volume_bounds(v, time); });
    volume_tree_.emplace(boxes.tree());
  }
}

// How a light's surface moves, in render space; null when it stands still.
const scene::Moving<scene::ShapeInstance>* Geometry::moving_light_surface(const scene::Scene& scene,
                                                                          std::uint32_t light,
                                                                          const Vec3d& origin) {
  const auto& moving = scene.motion.lights;
  const auto found =
      std::find_if(moving.begin(), moving.end(), [&](const auto& m) { return m.index == light; });
  if (found == moving.end()) return nullptr;
  scene::Moving<scene::ShapeInstance>& motion = light_surface_motions_.emplace_back();
  motion.times = found->times;
  motion.turnings = found->turnings;
  for (const scene::LightInstance& key : found->keys) {
    motion.keys.push_back(surface_of_light(std::get<scene::AreaLight>(key.light)));
    motion.keys.back().world_from_object.t -= origin;
  }
  return &motion;
}

Bounds Geometry::volume_bounds(const CompiledVolume& v, const Intervald& time) const {
  if (!v.motion) return placed_bounds(*bounds(v.shape, parts(), time), v.render_from_shape);
  return swept_bounds(
      v.motion->keys(), 0, [&](const scene::Volume& at) { return *turned_bounds(at.shape, parts(), time); },
      [&](const scene::Volume& at) {
        return Transform::translate(-v.motion->origin()) * at.world_from_shape;
      },
      time);
}

std::optional<SurfaceHit> Geometry::closest_hit(const Ray& ray, RayKind kind, const HitOrder& after) const {
  if (world_.empty()) return std::nullopt;
  const auto found = world_.closest_hit({ray.origin, ray.direction, ray.t_max, ray.time, after}, kind);
  if (!found) return std::nullopt;
  SurfaceHit hit;
  hit.t = found->t;
  hit.time = ray.time;
  hit.position = found->position;
  hit.normal = normalize(found->normal);
  hit.position_object = found->position_object;
  hit.normal_object = normalize(found->normal_object);
  const bool smooth = length_squared(found->shading_normal) > 0;
  hit.shading_normal = smooth ? normalize(found->shading_normal) : hit.normal;
  hit.shading_normal_object = smooth ? normalize(found->shading_normal_object) : hit.normal_object;
  hit.uv = found->uv;
  hit.normal_axes = found->normal_axes;
  hit.sheet = found->sheet;
  hit.offset_before = hit.offset_behind = offset_along(hit.normal, hit.position, origin_, found->error);
  hit.surface = found->number;
  hit.part = found->part;
  hit.mesh = found->mesh;
  hit.weights = found->weights;
  hit.priority = found->priority;
  if (found->light != no_index) {
    hit.light = found->light;
    return hit;
  }
  hit.material = found->material.index;
  hit.glow = found->glow;
  return hit;
}

bool Geometry::occluded(const Ray& ray, std::uint32_t target_light) const {
  return world_.occluded({ray.origin, ray.direction, ray.t_max, ray.time}, target_light);
}

void Geometry::volume_intervals(const Ray& ray, RayKind kind, std::vector<VolumeInterval>& out) const {
  out.clear();
  const auto test = [&](std::uint32_t index) {
    const CompiledVolume& v = volumes_[index];
    if (kind == RayKind::camera && !v.visible) return ray.t_max;
    const auto add = [&](const scene::Shape& shape, const Transform& shape_from_render) {
      for_each_interval(shape, parts(), shape_from_render.point(ray.origin),
                        shape_from_render.vector(ray.direction), ray.t_max, ray.time,
                        [&](const Intervald& stay) {
                          out.push_back({stay.lo, stay.hi, index});
                        });
    };
    if (v.motion) {
      const std::optional<scene::Shape> shape = v.motion->shape(ray.time);
      add(shape ? *shape : v.shape, v.motion->shape_from_render(ray.time));
    } else {
      add(v.shape, v.shape_from_render);
    }
    return ray.t_max;
  };
  if (volume_tree_) {
    volume_tree_->visit(ray.origin, ray.direction, 0, ray.t_max, test, ray.time);
  } else {
    for (std::uint32_t i = 0; i < volumes_.size(); ++i) test(i);
  }
  if (out.size() < 2) return;
  std::sort(out.begin(), out.end(), [](const VolumeInterval& a, const VolumeInterval& b) {
    return a.t0 != b.t0 ? a.t0 < b.t0 : a.volume < b.volume;
  });
}

}  // namespace tyndall::compile
