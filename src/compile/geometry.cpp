#include "compile/geometry.h"

#include <algorithm>

#include "base/numerics.h"
#include "base/overloaded.h"
#include "compile/hit_error.h"
#include "compile/strand_groups.h"

namespace tyndall::compile {

namespace {

// The surface of an area light, in the space of its numbers; nothing for lights without one.
std::optional<scene::ShapeInstance> light_surface(const scene::LightInstance& instance,
                                                  const optics::Light& light) {
  scene::ShapeInstance surface;
  const bool has_surface = std::visit(Overloaded{[&](const optics::SphereLight& l) {
                                                   surface.shape = scene::Sphere{l.center, l.radius};
                                                   surface.visible = l.visible;
                                                   return true;
                                                 },
                                                 [&](const optics::QuadLight& l) {
                                                   surface.shape = scene::Quad{l.center, l.u, l.v};
                                                   surface.visible = l.visible;
                                                   return true;
                                                 },
                                                 [&](const optics::DiskLight& l) {
                                                   surface.shape = scene::Disk{l.center, l.normal, l.radius};
                                                   surface.visible = l.visible;
                                                   return true;
                                                 },
                                                 [&](const optics::MeshLight& l) {
                                                   surface.shape = *instance.shape;
                                                   surface.world_from_object = l.world_from_shape;
                                                   surface.visible = l.visible;
                                                   return true;
                                                 },
                                                 [](const auto&) { return false; }},
                                      light);
  return has_surface ? std::optional(surface) : std::nullopt;
}

}  // namespace

Geometry::Geometry(const scene::Scene& scene, const Features& features, const Vec3d& origin,
                   std::span<const optics::Light> lights, std::span<const std::uint32_t> glows,
                   std::span<const CompiledVolume> volumes)
    : meshes_(scene.meshes.begin(), scene.meshes.end()),
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
  light_surfaces_.reserve(lights.size());
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const auto surface = light_surface(scene.lights[i], lights[i]);
    if (!surface) continue;
    light_surfaces_.push_back(*surface);
    world_.add_light(light_surfaces_.back(), i, moving_light_surface(scene, i, origin));
  }
  world_.finish();

  if (volumes.size() > few_things) {
    std::vector<Bounds> boxes(volumes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = volume_bounds(volumes[i]);
    volume_tree_.emplace(boxes);
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
    motion.keys.push_back(*light_surface(key, key.light));
    motion.keys.back().world_from_object.t -= origin;
  }
  return &motion;
}

Bounds Geometry::volume_bounds(const CompiledVolume& v) const {
  if (!v.motion) return placed_bounds(*bounds(v.shape, parts()), v.render_from_shape);
  return swept_bounds(
      *v.motion, 0, [&](const scene::Volume& at) { return *turned_bounds(at.shape, parts()); },
      [&](const scene::Volume& at) { return Transform::translate(-v.origin) * at.world_from_shape; });
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
      for_each_stay(shape, parts(), shape_from_render.point(ray.origin),
                    shape_from_render.vector(ray.direction), ray.t_max, [&](const Intervald& stay) {
                      out.push_back({stay.lo, stay.hi, index});
                    });
    };
    if (v.motion) {
      const CompiledVolume::Place now = v.moved(ray.time);
      add(now.shape, now.shape_from_render);
    } else {
      add(v.shape, v.shape_from_render);
    }
    return ray.t_max;
  };
  if (volume_tree_) {
    volume_tree_->visit(ray.origin, ray.direction, 0, ray.t_max, test);
  } else {
    for (std::uint32_t i = 0; i < volumes_.size(); ++i) test(i);
  }
  if (out.size() < 2) return;
  std::sort(out.begin(), out.end(), [](const VolumeInterval& a, const VolumeInterval& b) {
    return a.t0 != b.t0 ? a.t0 < b.t0 : a.volume < b.volume;
  });
}

}  // namespace tyndall::compile
