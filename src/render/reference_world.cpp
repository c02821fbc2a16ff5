// Intersections, containment and program evaluation for the reference renderer.
#include "render/reference_world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "vm/machine.h"

namespace tyndall::render::reference {

namespace {

// A ray in a shape's own space; the direction is not unit, so that t is the world's.
struct LocalRay {
  Vec3d origin, direction;
};

struct LocalHit {
  double t = 0;
  Vec3d normal;
};

// Where the line is inside the unit-free slab or ball: empty when it misses.
Intervald inside(const scene::Sphere& sphere, const LocalRay& ray) {
  const Vec3d o = ray.origin - sphere.center;
  const double a = length_squared(ray.direction), b = dot(o, ray.direction);
  // The distance of the line from the centre, without the cancellation of b² - a c.
  const Vec3d nearest = o - ray.direction * (b / a);
  const double rest = sqr(sphere.radius) - length_squared(nearest);
  if (rest <= 0) return {};
  const double half = std::sqrt(rest / a);
  return {-b / a - half, -b / a + half};
}

Intervald inside(const scene::Box& box, const LocalRay& ray) {
  Intervald all{-infinity, infinity};
  for (std::size_t i = 0; i < 3; ++i) {
    if (ray.direction[i] == 0) {
      if (ray.origin[i] < box.min[i] || ray.origin[i] >= box.max[i]) return {};
      continue;
    }
    const double t0 = (box.min[i] - ray.origin[i]) / ray.direction[i];
    const double t1 = (box.max[i] - ray.origin[i]) / ray.direction[i];
    all = all.clipped_to({std::min(t0, t1), std::max(t0, t1)});
  }
  return all.empty() ? Intervald{} : all;
}

// Between the planes of the ends, and in the round: a quadratic in the plane across the axis.
Intervald inside(const scene::Cylinder& cylinder, const LocalRay& ray) {
  const Vec3d axis = cylinder.to - cylinder.from, o = ray.origin - cylinder.from;
  const double axis2 = length_squared(axis), o_along = dot(o, axis) / axis2,
               d_along = dot(ray.direction, axis) / axis2;
  Intervald slab{-infinity, infinity};
  if (d_along != 0) {
    const double t0 = -o_along / d_along, t1 = (1 - o_along) / d_along;
    slab = {std::min(t0, t1), std::max(t0, t1)};
  } else if (o_along < 0 || o_along >= 1) {
    return {};
  }
  const Vec3d o_across = o - axis * o_along, d_across = ray.direction - axis * d_along;
  const double a = length_squared(d_across);
  if (a <= 1e-30 * length_squared(ray.direction))
    return length_squared(o_across) < sqr(cylinder.radius) ? slab : Intervald{};
  const double nearest = -dot(o_across, d_across) / a;
  const double rest = sqr(cylinder.radius) - length_squared(o_across + d_across * nearest);
  if (rest <= 0) return {};
  const double half = std::sqrt(rest / a);
  const Intervald all = slab.clipped_to({nearest - half, nearest + half});
  return all.empty() ? Intervald{} : all;
}

Vec3d normal_at(const scene::Sphere& sphere, const Vec3d& p) { return p - sphere.center; }

// The face whose plane is nearest, in units of the box.
Vec3d normal_at(const scene::Box& box, const Vec3d& p) {
  double best = infinity;
  Vec3d normal;
  for (std::size_t i = 0; i < 3; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double distance =
          std::abs(p[i] - (side < 0 ? box.min[i] : box.max[i])) / (box.max[i] - box.min[i]);
      if (distance >= best) continue;
      best = distance;
      normal = {};
      normal[i] = side;
    }
  return normal;
}

// An end or the side, whichever is nearest.
Vec3d normal_at(const scene::Cylinder& cylinder, const Vec3d& p) {
  const Vec3d axis = normalize(cylinder.to - cylinder.from);
  const double along = dot(p - cylinder.from, axis), height = length(cylinder.to - cylinder.from);
  const Vec3d across = p - cylinder.from - axis * along;
  const double to_side = std::abs(length(across) - cylinder.radius), to_low = std::abs(along),
               to_high = std::abs(height - along);
  if (to_side < to_low && to_side < to_high) return across;
  return to_low < to_high ? -axis : axis;
}

template <class Closed>
std::optional<LocalHit> hit_closed(const Closed& shape, const LocalRay& ray, double t_min, double t_max) {
  const Intervald line = inside(shape, ray);
  if (line.empty()) return {};
  for (const double t : {line.lo, line.hi})
    if (t > t_min && t < t_max) return LocalHit{t, normal_at(shape, ray.origin + ray.direction * t)};
  return {};
}

std::optional<LocalHit> hit(const scene::Sphere& s, const LocalRay& ray, double t_min, double t_max) {
  return hit_closed(s, ray, t_min, t_max);
}
std::optional<LocalHit> hit(const scene::Box& b, const LocalRay& ray, double t_min, double t_max) {
  return hit_closed(b, ray, t_min, t_max);
}
std::optional<LocalHit> hit(const scene::Cylinder& c, const LocalRay& ray, double t_min, double t_max) {
  return hit_closed(c, ray, t_min, t_max);
}
std::optional<LocalHit> hit(const scene::Plane& plane, const LocalRay& ray, double t_min, double t_max) {
  const double t = dot(plane.point - ray.origin, plane.normal) / dot(ray.direction, plane.normal);
  if (!(t > t_min && t < t_max)) return {};
  return LocalHit{t, plane.normal};
}
std::optional<LocalHit> hit(const scene::Quad& quad, const LocalRay& ray, double t_min, double t_max) {
  const Vec3d n = cross(quad.u, quad.v);
  const double t = dot(quad.center - ray.origin, n) / dot(ray.direction, n);
  if (!(t > t_min && t < t_max)) return {};
  const Vec3d d = ray.origin + ray.direction * t - quad.center;
  const double n2 = length_squared(n);
  if (std::abs(dot(cross(d, quad.v), n)) > n2 || std::abs(dot(cross(quad.u, d), n)) > n2) return {};
  return LocalHit{t, n};
}

std::optional<LocalHit> hit(const scene::Disk& disk, const LocalRay& ray, double t_min, double t_max) {
  const auto found = hit(scene::Plane{disk.center, disk.normal}, ray, t_min, t_max);
  if (!found || length_squared(ray.origin + ray.direction * found->t - disk.center) > sqr(disk.radius))
    return {};
  return found;
}

// Scenes for the reference have no curves.
std::optional<LocalHit> hit(const scene::Curves&, const LocalRay&, double, double) {
  CHECK(false);
  return {};
}

// Every triangle, by Cramer's rule (Möller and Trumbore 1997).
std::optional<LocalHit> hit(const scene::TriangleMesh& mesh, const LocalRay& ray, double t_min,
                            double t_max) {
  std::optional<LocalHit> nearest;
  for (const auto& triangle : mesh.triangles) {
    const Vec3d &a = mesh.points[triangle[0]], e1 = mesh.points[triangle[1]] - a,
                e2 = mesh.points[triangle[2]] - a;
    const Vec3d across = cross(ray.direction, e2), from_a = ray.origin - a, other = cross(from_a, e1);
    const double determinant = dot(e1, across);
    const double u = dot(from_a, across) / determinant, v = dot(ray.direction, other) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) continue;
    const double t = dot(e2, other) / determinant;
    if (t > t_min && t < t_max) {
      nearest = LocalHit{t, cross(e1, e2)};
      t_max = t;
    }
  }
  return nearest;
}

// By the solid angle that the triangles fill, seen from p (van Oosterom and Strackee 1983): 4 pi times the
// winding.
bool contains(const scene::TriangleMesh& mesh, const Vec3d& p) {
  double sum = 0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3d a = normalize(mesh.points[triangle[0]] - p), b = normalize(mesh.points[triangle[1]] - p),
                c = normalize(mesh.points[triangle[2]] - p);
    sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return std::abs(sum) > 2 * pi;
}

// The ball around a mesh, as far as rays in it are concerned.
Intervald hull(const scene::TriangleMesh& mesh, const LocalRay& ray) {
  double radius = 0;
  for (const Vec3d& p : mesh.points) radius = std::max(radius, length(p - mesh.points[0]));
  return inside(scene::Sphere{mesh.points[0], 1.001 * radius}, ray);
}

Intervald interval_inside(const scene::Scene& scene, const scene::Shape& shape, const LocalRay& ray) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape)) return hull(scene.meshes[mesh->mesh.index], ray);
  if (const auto* cylinder = std::get_if<scene::Cylinder>(&shape)) return inside(*cylinder, ray);
  if (const auto* sphere = std::get_if<scene::Sphere>(&shape)) return inside(*sphere, ray);
  const auto* box = std::get_if<scene::Box>(&shape);
  CHECK(box != nullptr);
  return inside(*box, ray);
}

std::optional<LocalHit> hit(const scene::Scene& scene, const scene::Shape& shape, const LocalRay& ray,
                            double t_min, double t_max) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.mesh; })
          return hit(scene.meshes[s.mesh.index], ray, t_min, t_max);
        else
          return hit(s, ray, t_min, t_max);
      },
      shape);
}

bool contains(const scene::Scene& scene, const scene::Shape& shape, const Vec3d& p) {
  if (const auto* mesh = std::get_if<scene::Mesh>(&shape)) return contains(scene.meshes[mesh->mesh.index], p);
  if (const auto* sphere = std::get_if<scene::Sphere>(&shape))
    return length_squared(p - sphere->center) < sqr(sphere->radius);
  if (const auto* cylinder = std::get_if<scene::Cylinder>(&shape)) {
    const Vec3d axis = cylinder->to - cylinder->from, d = p - cylinder->from;
    const double along = dot(d, axis) / length_squared(axis);
    return along >= 0 && along < 1 && length_squared(d - axis * along) < sqr(cylinder->radius);
  }
  const auto& box = std::get<scene::Box>(shape);
  for (std::size_t i = 0; i < 3; ++i)
    if (p[i] < box.min[i] || p[i] >= box.max[i]) return false;
  return true;
}

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
    for (const scene::PhaseLobe& lobe : medium.phase)
      point.lobes.push_back(
          {{lobe.kind, {number(lobe.parameters[0], values), number(lobe.parameters[1], values)}},
           number(lobe.weight, values)});
    out.push_back(std::move(point));
  }
}

std::optional<World::LightHit> World::nearest_light(const Ray& ray, double t_min, double t_max) const {
  std::optional<LightHit> nearest;
  const LocalRay line{ray.origin, ray.direction};
  for (const scene::LightInstance& instance : scene_.lights) {
    const double limit = nearest ? nearest->t : t_max;
    if (const auto* sphere = std::get_if<optics::SphereLight>(&instance.light)) {
      if (ray.camera && !sphere->visible) continue;
      if (const auto found = hit(scene::Sphere{sphere->center, sphere->radius}, line, t_min, limit))
        nearest = {found->t, dot(found->normal, ray.direction) < 0 ? Vec3d(radiance(*sphere)) : Vec3d()};
    } else if (const auto* quad = std::get_if<optics::QuadLight>(&instance.light)) {
      if (ray.camera && !quad->visible) continue;
      if (const auto found = hit(scene::Quad{quad->center, quad->u, quad->v}, line, t_min, limit))
        nearest = {found->t, dot(found->normal, ray.direction) < 0 ? Vec3d(radiance(*quad)) : Vec3d()};
    } else if (const auto* disk = std::get_if<optics::DiskLight>(&instance.light)) {
      if (ray.camera && !disk->visible) continue;
      if (const auto found = hit(scene::Disk{disk->center, disk->normal, disk->radius}, line, t_min, limit))
        nearest = {found->t, dot(found->normal, ray.direction) < 0 ? Vec3d(radiance(*disk)) : Vec3d()};
    }
  }
  return nearest;
}

}  // namespace tyndall::render::reference
