#include "render/emission_rays.h"

#include "render/worker.h"

namespace tyndall::render {

void EmissionBatch::add(const compile::Ray& ray, const Rgb& contribution, std::uint32_t seed) {
  if (count_ == rays_.size()) rays_.push_back(std::make_unique<EmissionRay>());
  EmissionRay& added = *rays_[count_++];
  added.ray = ray;
  added.contribution = contribution;
  added.seed = seed;
  added.sample = sample_;
  added.part = part_;
}

std::span<const std::unique_ptr<EmissionRay>> EmissionBatch::trace(const compile::CompiledScene& world,
                                                                   Worker& worker) {
  const auto rays = std::span<const std::unique_ptr<EmissionRay>>(rays_).first(count_);
  if (rays.empty()) return rays;
  requests_.clear();
  for (const auto& r : rays) {
    ++worker.statistics.shadow_rays;
    constexpr auto kind = compile::RayKind::scattered;
    const auto hit = world.features.walks_surfaces()
                         ? trace_through(world, r->ray, kind, worker, r->crossings)
                         : world.closest_hit(r->ray, kind);
    r->ray.t_max = hit ? hit->t : infinity;
    r->march.crossings.clear();
    for (const Crossing& c : r->crossings) r->march.crossings.push_back({c.t, 1 - c.surface.opacity});
    requests_.push_back({r->ray, kind, r->seed, &r->march, true});
  }
  march(world, requests_, worker);
  for (const auto& r : rays) r->contribution *= r->march.emitted;
  return rays;
}

}  // namespace tyndall::render
