#include "render/surface/transparent_hits.h"

#include <algorithm>

#include "base/check.h"
#include "render/surface/surface_walk.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;
using compile::Ray;
using compile::RayKind;
using compile::SurfaceHit;

// What passes less than this in all counts as opaque: a thousandth of a float's last digit.
constexpr float least_pass = 1e-10f;

bool is_opaque(const CompiledScene& world, const SurfaceHit& hit) {
  return world.materials[hit.material].opaque;
}

}  // namespace

void HitSurfaces::add(const SurfacePoint& point, const Rgb& throughput) {
  list_.push_back({&point, throughput, std::max(0.0f, luminance(throughput * point.reflectance))});
  mass_ += list_.back().mass;
}

Rgb HitSurfaces::scattered() const {
  Rgb sum;
  for (const HitSurface& surface : list_) sum += surface.throughput * surface.point->reflectance;
  return sum;
}

const HitSurface& HitSurfaces::choose(double u) const {
  const HitSurface* chosen = nullptr;
  double rest = u * mass_;
  for (const HitSurface& surface : list_) {
    if (surface.mass <= 0) continue;
    chosen = &surface;
    if (rest < surface.mass) break;
    rest -= surface.mass;
  }
  CHECK(chosen);
  return *chosen;
}

std::optional<SurfaceHit> trace_through(const CompiledScene& world, const Ray& ray, RayKind kind,
                                        ThreadContext& thread, std::vector<Crossing>& crossings) {
  crossings.clear();
  SurfaceWalk walk(world, ray, kind);
  float passed = 1;
  while (const auto hit = walk.next()) {
    if (hit->light != compile::no_index || is_opaque(world, *hit)) return hit;
    SurfacePoint surface = evaluate_surface(world, *hit, ray.direction, thread);
    passed *= 1 - surface.opacity;
    if (passed < least_pass) return hit;
    crossings.push_back({hit->t, std::move(surface)});
  }
  return std::nullopt;
}

float pass_to_light(const CompiledScene& world, const Ray& ray, std::uint32_t target_light,
                    ThreadContext& thread) {
  SurfaceWalk walk(world, ray, RayKind::shadow);
  float passed = 1;
  while (passed >= least_pass) {
    const auto hit = walk.next();
    if (!hit) return passed;
    if (hit->light != compile::no_index) {
      if (hit->light != target_light) return 0;
    } else if (is_opaque(world, *hit)) {
      return 0;
    } else {
      passed *= 1 - evaluate_opacity(world, *hit, thread);
    }
  }
  return 0;
}

}  // namespace tyndall::render
