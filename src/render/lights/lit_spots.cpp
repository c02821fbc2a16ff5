#include "render/lights/lit_spots.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/interval.h"
#include "base/numerics.h"
#include "base/sampler.h"
#include "render/context/thread_context.h"
#include "render/surface/surface_interaction.h"

namespace tyndall::render {

namespace {

constexpr std::size_t most_lamps = 64;  // that rays are sent from
constexpr std::uint32_t rays_of_all = 4096, most_rays_of_lamp = 1024;

// What a ray from a lamp meets first, lamps aside.
std::optional<compile::SurfaceHit> first_surface(const compile::CompiledScene& world,
                                                 const compile::Ray& ray) {
  compile::HitOrder after;
  while (const auto hit = world.closest_hit(ray, compile::RayKind::scattered, after)) {
    if (hit->light == compile::no_index) return hit;
    after = {hit->t, hit->surface, hit->part};
  }
  return std::nullopt;
}

// Where a direction that is uniform over the sphere, from a point of a lamp, meets a surface. Its light
// arrives from that point with `radiance / pdf` per solid angle, over the area 4π d² / (rays cos) that the
// ray stands for.
std::optional<LitPoint> lit_point(const compile::CompiledScene& world, const compile::CompiledLight& lamp,
                                  const SobolPoint& u, double rays, double time, ThreadContext& thread) {
  const auto pivot = lamp.sample_pivot(u[2], u[3]);
  if (!pivot) return std::nullopt;
  const double z = 1 - 2.0 * u[0], phi = 2 * pi * u[1], r = safe_sqrt(1 - z * z);
  const compile::Ray ray{pivot->position, {r * std::cos(phi), r * std::sin(phi), z}, infinity, time};
  const auto hit = first_surface(world, ray);
  if (!hit) return std::nullopt;
  const SurfacePoint surface = evaluate_surface(world, *hit, ray.direction, thread);
  if (surface.only_deltas) return std::nullopt;
  const auto arriving = lamp.sample(surface.offset_position, *pivot, u[2], u[3]);
  if (!arriving) return std::nullopt;
  const double d = hit->t, cosine = std::abs(dot(surface.normal, ray.direction));
  const double power = optics::mean(arriving->radiance_over_pdf * surface.reflectance) * surface.opacity * 4 *
                       pi * sqr(d) / rays;
  if (!(power > 0 && cosine > 0)) return std::nullopt;
  return LitPoint{surface.position, std::min(2 * d / std::sqrt(rays * cosine), d), power};
}

// Some of the points, and the sphere around them.
struct Cluster {
  std::span<LitPoint> points;
  LitSpot spot;
  // Of dividing it: spots of equal power are small where it is dense.
  double worth() const { return points.size() > 1 ? spot.power : 0; }

  explicit Cluster(std::span<LitPoint> all) : points(all) {
    for (const LitPoint& p : points) {
      spot.center += p.position * p.power;
      spot.power += p.power;
    }
    spot.center /= spot.power;
    for (const LitPoint& p : points)
      spot.radius = std::max(spot.radius, length(p.position - spot.center) + p.radius);
  }
};

// Divides the points at the middle of their longest side.
std::size_t divided(std::span<LitPoint> points) {
  Vec3d lo(infinity), hi(-infinity);
  for (const LitPoint& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p.position[k]);
      hi[k] = std::max(hi[k], p.position[k]);
    }
  const Vec3d size = hi - lo;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const double middle = (lo[axis] + hi[axis]) / 2;
  const auto second = std::partition(points.begin(), points.end(),
                                     [&](const LitPoint& p) { return p.position[axis] < middle; });
  return static_cast<std::size_t>(second - points.begin());
}

}  // namespace

std::vector<LitSpot> gathered(std::span<LitPoint> points, std::size_t most) {
  std::vector<Cluster> clusters;
  if (!points.empty()) clusters.emplace_back(points);
  while (!clusters.empty() && clusters.size() < most) {
    const auto worst =
        std::max_element(clusters.begin(), clusters.end(),
                         [](const Cluster& a, const Cluster& b) { return a.worth() < b.worth(); });
    if (!(worst->worth() > 0)) break;
    const std::span<LitPoint> all = worst->points;
    const std::size_t first = divided(all);
    if (first == 0 || first == all.size()) break;  // all in one place
    *worst = Cluster(all.first(first));
    clusters.emplace_back(all.subspan(first));
  }
  std::vector<LitSpot> out;
  for (const Cluster& c : clusters) out.push_back(c.spot);
  return out;
}

std::unique_ptr<const LitSpots> LitSpots::of(const compile::CompiledScene& world) {
  std::vector<std::pair<double, std::uint32_t>> lamps;
  for (std::uint32_t i = 0; i < world.lights.size(); ++i)
    if (const auto bounds = world.lights[i].bounds()) lamps.push_back({-bounds->intensity, i});
  std::sort(lamps.begin(), lamps.end());
  lamps.resize(std::min(lamps.size(), most_lamps));
  if (lamps.empty()) return nullptr;
  const auto rays = std::min(rays_of_all / static_cast<std::uint32_t>(lamps.size()), most_rays_of_lamp);
  const double time = world.features.motion ? 0.5 : 0;
  ThreadContext thread;
  std::vector<LitPoint> points;
  for (const auto& [_, i] : lamps) {
    const compile::LightAt lamp(world, i, time);
    for (std::uint32_t n = 0; n < rays; ++n)
      if (const auto point = lit_point(world, *lamp, sobol_point(n, hash_bits(i)), rays, time, thread))
        points.push_back(*point);
  }
  if (points.empty()) return nullptr;
  return std::make_unique<const LitSpots>(gathered(points, most_spots));
}

}  // namespace tyndall::render
