#include "compile/steps/pilot_lines.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/check.h"
#include "base/numerics.h"
#include "base/overloaded.h"
#include "base/sampler.h"
#include "compile/geometry/geometry.h"
#include "compile/majorant/majorant_grid.h"

namespace tyndall::compile {

namespace {

// Rays of the camera across the picture and down.
constexpr int rays_across = 24, rays_down = 18;

// Through a place of the picture, in [-1, 1]² from its middle; through the middle of the lens.
Ray view_ray(const CompiledScene& world, const scene::Camera& camera, double x, double y) {
  const scene::Resolution& size = world.scene.settings.resolution;
  const double aspect = static_cast<double>(size.width) / size.height;
  const auto axes = std::visit([](const auto& c) { return Transform::look_at(c.from, c.to, c.up); }, camera);
  CHECK(axes.has_value());  // resolve refuses cameras without a direction
  const Vec3d origin = std::visit([](const auto& c) { return c.from; }, camera) - world.origin;
  return std::visit(
      Overloaded{[&](const scene::PerspectiveCamera& c) -> Ray {
                   const double half = std::tan(c.fov.radians / 2);
                   return {origin, normalize(axes->x * (x * half * aspect) + axes->y * (y * half) - axes->z),
                           infinity};
                 },
                 [&](const scene::OrthographicCamera& c) -> Ray {
                   return {origin + axes->x * (x * c.height / 2 * aspect) + axes->y * (y * c.height / 2),
                           -axes->z, infinity};
                 },
                 [&](const scene::SphericalCamera&) -> Ray {
                   const double longitude = x * pi, latitude = y * pi / 2;
                   return {
                       origin,
                       (axes->x * std::sin(longitude) - axes->z * std::cos(longitude)) * std::cos(latitude) +
                           axes->y * std::sin(latitude),
                       infinity};
                 }},
      camera);
}

// Cut to what is not proven to be empty; of no length where nothing is left.
PilotLine occupied(const CompiledScene& world, PilotLine line) {
  const CompiledVolume& volume = world.volumes[line.volume];
  if (volume.grid == no_index) return line;
  const Transform medium_from_render = volume.medium_from_render_at(line.ray.time);
  const Intervald part = world.grids[volume.grid_at(line.ray.time)]->occupied_part(
      medium_from_render.point(line.ray.origin), medium_from_render.vector(line.ray.direction),
      {line.t0, line.t1});
  line.t0 = part.lo;
  line.t1 = part.empty() ? part.lo : part.hi;
  return line;
}

Vec3d random_direction(std::uint64_t number) {
  const double z = 1 - 2 * pilot_random(number, 0), r = safe_sqrt(1 - z * z),
               phi = 2 * pi * pilot_random(number, 1);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

PilotLine stay_of(const CompiledScene& world, const Ray& ray, std::uint32_t volume) {
  std::vector<VolumeInterval> inside;
  world.volume_intervals(ray, RayKind::scattered, inside);
  for (const VolumeInterval& i : inside)
    if (i.volume == volume) return occupied(world, {ray, i.t0, i.t1, volume});
  return {ray, 0, 0, volume};
}

}  // namespace

double pilot_random(std::uint64_t number, std::uint64_t dimension) {
  return open_unit_double(hash_bits(number, dimension));
}

SeenLines seen_lines(const CompiledScene& world) {
  SeenLines seen;
  seen.of_volume.resize(world.volumes.size());
  std::vector<VolumeInterval> inside;
  for (int row = 0; row < rays_down; ++row)
    for (int column = 0; column < rays_across; ++column) {
      const std::uint64_t number = seen.rays++;
      const double time = world.features.motion ? pilot_random(number, 2) : 0;
      const double x = 2 * (column + pilot_random(number, 0)) / rays_across - 1,
                   y = 2 * (row + pilot_random(number, 1)) / rays_down - 1;
      Ray ray = world.scene.motion.camera.empty()
                    ? view_ray(world, world.scene.camera, x, y)
                    : view_ray(world, scene::at(world.scene.motion.camera, time), x, y);
      ray.time = time;
      if (const auto hit = world.closest_hit(ray, RayKind::camera)) ray.t_max = hit->t;
      world.volume_intervals(ray, RayKind::camera, inside);
      for (const VolumeInterval& i : inside) {
        const PilotLine line = occupied(world, {ray, i.t0, i.t1, i.volume});
        if (line.t1 > line.t0) seen.of_volume[i.volume].push_back(line);
      }
    }
  return seen;
}

PilotLine line_from(const CompiledScene& world, const Vec3d& point, double time, std::uint32_t volume,
                    std::uint64_t number) {
  Ray ray{point, random_direction(number), infinity, time};
  if (!world.distant_lights.empty() && number % 2 == 0) {
    const std::uint32_t light = world.distant_lights[number / 2 % world.distant_lights.size()];
    if (const auto toward = world.lights[light].toward()) ray.direction = *toward;
  }
  if (const auto hit = world.closest_hit(ray, RayKind::scattered)) ray.t_max = hit->t;
  return stay_of(world, ray, volume);
}

PilotLine line_through(const CompiledScene& world, std::uint32_t volume, std::uint64_t number) {
  const double time = world.features.motion ? pilot_random(number, 2) : 0;
  const Bounds box = world.geometry->volume_bounds(world.volumes[volume], {time, time});
  Vec3d point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = lerp(box.lo[axis], box.hi[axis], pilot_random(number, 3 + axis));
  const double reach = length(box.hi - box.lo);
  const Vec3d direction = random_direction(number);
  return stay_of(world, {point - direction * reach, direction, 2 * reach, time}, volume);
}

}  // namespace tyndall::compile
