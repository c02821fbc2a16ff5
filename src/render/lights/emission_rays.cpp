#include "render/lights/emission_rays.h"

namespace tyndall::render {

void EmissionBatch::add(const compile::Ray& ray, const Rgb& contribution, std::uint32_t seed,
                        const LightTarget& target) {
  if (count_ == rays_.size()) rays_.push_back(std::make_unique<EmissionRay>());
  EmissionRay& added = *rays_[count_++];
  added.ray = ray;
  added.contribution = contribution;
  added.seed = seed;
  added.target = target;
}

std::span<const std::unique_ptr<EmissionRay>> EmissionBatch::trace(const compile::CompiledScene& world,
                                                                   ThreadContext& thread) {
  const auto rays = std::span<const std::unique_ptr<EmissionRay>>(rays_).first(count_);
  if (rays.empty()) return rays;
  requests_.clear();
  for (const auto& r : rays) {
    ++thread.statistics.shadow_rays;
    constexpr auto kind = compile::RayKind::scattered;
    const auto hit = world.features.walks_surfaces()
                         ? trace_through(world, r->ray, kind, thread, r->crossings)
                         : world.closest_hit(r->ray, kind);
    r->ray.t_max = hit ? hit->t : infinity;
    r->march.crossings.clear();
    for (const Crossing& c : r->crossings) r->march.crossings.push_back({c.t, 1 - c.surface.opacity});
    requests_.push_back({r->ray, kind, r->seed, &r->march, true});
  }
  marcher_.march(world, requests_, thread);
  for (const auto& r : rays) r->contribution *= r->march.emitted;
  return rays;
}

void EmissionBatch::clear() {
  for (std::size_t i = 0; i < count_; ++i) rays_[i]->march.outputs.reset();
  count_ = 0;
}

}  // namespace tyndall::render
