#include "render/crossings.h"

#include <algorithm>

#include "base/check.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;
using compile::Ray;
using compile::RayKind;
using compile::SurfaceHit;

// What passes less than this in all counts as opaque: a thousandth of a float's last digit.
constexpr float least_pass = 1e-10f;

// Nothing need be evaluated to know that the surface is all there: where bodies of glass overlap a boundary
// may not be.
bool certainly_stops(const CompiledScene& world, const SurfaceHit& hit) {
  const compile::CompiledMaterial& material = world.materials[hit.material];
  return material.opaque && !(world.solids && material.transmits);
}

// The rest of a ray behind a surface that was met at t of it.
Ray behind(const CompiledScene& world, const Ray& ray, const SurfaceHit& hit) {
  const Vec3d off = hit.normal * compile::surface_offset(world, hit.position);
  return {dot(hit.normal, ray.direction) > 0 ? hit.position + off : hit.position - off, ray.direction,
          ray.t_max - hit.t, ray.time};
}

}  // namespace

void MetSurfaces::add(const SurfacePoint& point, const Rgb& throughput) {
  list_.push_back({&point, throughput, std::max(0.0f, luminance(throughput * point.reflectance))});
  mass_ += list_.back().mass;
}

Rgb MetSurfaces::scattered() const {
  Rgb sum;
  for (const MetSurface& surface : list_) sum += surface.throughput * surface.point->reflectance;
  return sum;
}

const MetSurface& MetSurfaces::choose(double u) const {
  const MetSurface* chosen = nullptr;
  double rest = u * mass_;
  for (const MetSurface& surface : list_) {
    if (surface.mass <= 0) continue;
    chosen = &surface;
    if (rest < surface.mass) break;
    rest -= surface.mass;
  }
  CHECK(chosen);
  return *chosen;
}

std::optional<SurfaceHit> trace_through(const CompiledScene& world, const Ray& ray, RayKind kind,
                                        Worker& worker, std::vector<Crossing>& crossings) {
  crossings.clear();
  Ray rest = ray;
  double start = 0;
  float passed = 1;
  for (;;) {
    auto hit = world.closest_hit(rest, kind);
    if (!hit || hit->light != compile::no_index || certainly_stops(world, *hit)) {
      if (hit) hit->t += start;
      return hit;
    }
    SurfacePoint surface = evaluate_surface(world, *hit, ray.direction, worker);
    passed *= 1 - surface.opacity;
    rest = behind(world, rest, *hit);
    hit->t += start;
    if (passed < least_pass) return hit;
    start = hit->t;
    crossings.push_back({hit->t, std::move(surface)});
  }
}

float pass_to_light(const CompiledScene& world, const Ray& ray, std::uint32_t target_light, Worker& worker) {
  Ray rest = ray;
  float passed = 1;
  while (passed >= least_pass) {
    const auto hit = world.closest_hit(rest, RayKind::shadow);
    if (!hit) return passed;
    if (hit->light != compile::no_index) {
      if (hit->light != target_light) return 0;
    } else {
      passed *= 1 - evaluate_opacity(world, *hit, worker);
    }
    rest = behind(world, rest, *hit);
  }
  return 0;
}

}  // namespace tyndall::render
