// Intersections, containment and program evaluation for the reference renderer.
#include "reference/reference_world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "reference/reference_shapes.h"
#include "vm/run/machine.h"

namespace tyndall::reference {

namespace {

Transform inverted(const Transform& transform) {
  const std::optional<Transform> inverse = transform.inverse();
  CHECK(inverse.has_value());
  return *inverse;
}

// The program's outputs at one point; vectors in the order p, P, n, N.
std::vector<float> evaluate(const vm::Program& program, const std::array<Vec3d, 4>& vectors, double time) {
  std::array<float, vm::input_count> values{};
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) values[3 * v + axis] = static_cast<float>(vectors[v][axis]);
  values[static_cast<std::size_t>(vm::Input::time)] = static_cast<float>(time);
  vm::BatchInputs inputs;
  for (const vm::Input input : program.inputs) {
    CHECK(input != vm::Input::u && input != vm::Input::v);
    inputs[input] = &values[static_cast<std::size_t>(input)];
  }
  std::vector<float> outputs(program.outputs.size());
  std::vector<float*> places;
  for (float& value : outputs) places.push_back(&value);
  vm::run_reference(program, inputs, 1, places);
  for (float& value : outputs)
    if (!std::isfinite(value)) value = 0;
  return outputs;
}

template <class Outputs>
Vec3d non_negative(const std::vector<float>& values, const Outputs& which) {
  return {std::max(0.0f, values[which[0]]), std::max(0.0f, values[which[1]]),
          std::max(0.0f, values[which[2]])};
}

float number(const scene::PhaseLobe::Number& given, const std::vector<float>& values) {
  return given.output ? values[*given.output] : given.value;
}

}  // namespace

World::World(const scene::Scene& scene) : scene_(scene::expanded(scene)) {
  for (const scene::ShapeInstance& shape : scene_.shapes)
    shapes_.push_back({shape.world_from_object, inverted(shape.world_from_object)});
  for (const scene::Volume& volume : scene_.volumes) {
    volumes_.push_back({volume.world_from_shape, inverted(volume.world_from_shape)});
    media_.push_back(inverted(volume.world_from_medium));
  }
}

std::optional<Surface> World::nearest_surface(const Ray& ray, double t_min, double t_max) const {
  std::optional<LocalHit> nearest;
  std::size_t which = 0;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (ray.camera && !scene_.shapes[i].visible) continue;
    const Transform& local = shapes_[i].object_from_world;
    const LocalRay local_ray{local.point(ray.origin), local.vector(ray.direction)};
    const auto found = hit(scene_, scene_.shapes[i].shape, local_ray, t_min, nearest ? nearest->t : t_max);
    if (found) {
      nearest = found;
      which = i;
    }
  }
  if (!nearest) return {};
  const Placed& placed = shapes_[which];
  Surface surface;
  surface.t = nearest->t;
  surface.position = ray.origin + ray.direction * nearest->t;
  surface.normal = normalize(placed.world_from_object.normal(nearest->normal));
  const scene::Material& material = scene_.materials[scene_.shapes[which].material.index];
  const std::vector<float> values = evaluate(material.program,
                                             {placed.object_from_world.point(surface.position),
                                              surface.position, normalize(nearest->normal), surface.normal},
                                             scene_.time);
  const Vec3d color = non_negative(values, material.base_color);
  surface.reflectance = Rgb(Vec3d(std::min(1.0, color.x), std::min(1.0, color.y), std::min(1.0, color.z)));
  if (material.emission) surface.emission = Rgb(non_negative(values, *material.emission));
  return surface;
}

bool World::occluded(const Ray& ray, double t_min, double t_max) const {
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    const Transform& local = shapes_[i].object_from_world;
    const LocalRay local_ray{local.point(ray.origin), local.vector(ray.direction)};
    if (hit(scene_, scene_.shapes[i].shape, local_ray, t_min, t_max)) return true;
  }
  return false;
}

Intervald World::volume_hull(const Ray& ray, double t_max) const {
  Intervald hull{infinity, -infinity};
  for (std::size_t i = 0; i < volumes_.size(); ++i) {
    const Transform& local = volumes_[i].object_from_world;
    const Intervald one = interval_inside(scene_, scene_.volumes[i].shape,
                                          {local.point(ray.origin), local.vector(ray.direction)})
                              .clipped_to({0, t_max});
    if (one.empty()) continue;
    hull = {std::min(hull.lo, one.lo), std::max(hull.hi, one.hi)};
  }
  return hull.empty() ? Intervald{} : hull;
}

void World::media_at(const Vec3d& position, bool camera, std::vector<MediumPoint>& out) const {
  out.clear();
  for (std::size_t i = 0; i < volumes_.size(); ++i) {
    const scene::Volume& volume = scene_.volumes[i];
    if (camera && !volume.visible) continue;
    if (!contains(scene_, volume.shape, volumes_[i].object_from_world.point(position))) continue;
    const scene::Medium& medium = scene_.media[volume.medium.index];
    const std::vector<float> values =
        evaluate(medium.full, {media_[i].point(position), position, {}, {}}, scene_.time);
    MediumPoint point;
    point.sigma_s = non_negative(values, medium.sigma_s);
    point.sigma_t = non_negative(values, medium.sigma_t);
    if (medium.emission) point.emission = non_negative(values, *medium.emission);
    for (const scene::PhaseLobe& lobe : medium.phase) {
      std::array<float, optics::most_phase_parameters> parameters;
      for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k] = number(lobe.parameters[k], values);
      point.lobes.push_back({{lobe.kind, parameters}, number(lobe.weight, values)});
    }
    out.push_back(std::move(point));
  }
}

Vec3d radiance_of(const scene::AreaLight& light) {
  double area = 0;
  if (const auto* sphere = std::get_if<scene::Sphere>(&light.shape))
    area = 4 * pi * sqr(sphere->radius);
  else if (const auto* quad = std::get_if<scene::Quad>(&light.shape))
    area = 4 * length(cross(quad->u, quad->v));
  else
    area = pi * sqr(std::get<scene::Disk>(light.shape).radius);
  return Vec3d(light.radiance_over(area));
}

std::optional<World::LightHit> World::nearest_light(const Ray& ray, double t_min, double t_max) const {
  std::optional<LightHit> nearest;
  const LocalRay line{ray.origin, ray.direction};
  for (const scene::LightInstance& instance : scene_.lights) {
    const double limit = nearest ? nearest->t : t_max;
    const auto* light = std::get_if<scene::AreaLight>(&instance.light);
    if (!light || (ray.camera && !light->visible)) continue;
    if (const auto found = hit(scene_, light->shape, line, t_min, limit))
      nearest = {found->t, dot(found->normal, ray.direction) < 0 ? radiance_of(*light) : Vec3d()};
  }
  return nearest;
}

}  // namespace tyndall::reference
