#include "render/transmittance/ratio_tracking.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "base/sampler.h"
#include "render/march/majorant_limit.h"
#include "render/transmittance/shadow_rays.h"

namespace tyndall::render {

namespace {

constexpr std::uint32_t points_a_round = 32;

double uniform(std::uint32_t seed, std::uint32_t volume, std::uint32_t& counter) {
  return open_unit_double(hash_bits(hash_bits(seed, volume), counter++));
}

}  // namespace

void RatioTracking::run(const compile::CompiledScene& world, Transmittance method, std::span<ShadowRay> rays,
                        ThreadContext& thread) {
  std::stable_sort(walks_.begin(), walks_.end(),
                   [](const Walk& a, const Walk& b) { return a.medium < b.medium; });
  while (!walks_.empty()) {
    points_.clear();
    for (Walk& walk : walks_) draw_points(world, method, rays, walk, thread);
    evaluate(world, rays, thread);
    std::erase_if(walks_, [&](Walk& walk) { return !goes_on(rays, walk); });
  }
}

// The next points, a Poisson process. About a control c, points at rate r multiply by 1 - (sigma_t - c)/r,
// and e^-∫c is known. Ratio tracking: c = 0 and r the majorant. Residual: c the middle of the bounds and r
// half their difference, so half as many points and factors in [0, 2].
void RatioTracking::draw_points(const compile::CompiledScene& world, Transmittance method,
                                std::span<ShadowRay> rays, Walk& walk, ThreadContext& thread) {
  const compile::CompiledVolume& volume = world.volumes[walk.volume];
  ShadowRay& ray = rays[walk.ray];
  walk.first = static_cast<std::uint32_t>(points_.size());
  walk.count = 0;
  double controlled = 0;  // ∫ control up to the walk's new start
  compile::MajorantDda grid(*world.grids[volume.grid_at(ray.ray.time)],
                            volume.medium_from_render_at(ray.ray.time), ray.ray, walk.t0, walk.t1, bounds_);
  compile::MajorantSegment s;
  bool ended = true;
  while (ended && grid.next(s)) {
    const double majorant = limited_majorant(s, thread), minorant = s.bounds.minorant;
    const bool residual = method == Transmittance::residual_ratio;
    const double control = residual ? 0.5 * (minorant + majorant) : 0.0;
    const double rate = residual ? 0.5 * (majorant - minorant) : majorant;
    double t = s.t0;
    while (rate > 0) {
      const double next = t - std::log(uniform(ray.seed, walk.volume, walk.counter)) / rate;
      if (next >= s.t1) break;
      t = next;
      points_.push_back({t, control, 1 / rate});
      if (++walk.count == points_a_round) {
        ended = false;
        break;
      }
    }
    controlled += control * ((ended ? s.t1 : t) - s.t0);
    walk.t0 = ended ? s.t1 : t;
  }
  if (ended) walk.t0 = walk.t1;
  ray.segments += walk.count;
  transmittance_[walk.ray] *= std::exp(-controlled);
}

// One batch a medium.
void RatioTracking::evaluate(const compile::CompiledScene& world, std::span<const ShadowRay> rays,
                             ThreadContext& thread) {
  for (std::size_t first = 0; first < walks_.size();) {
    std::size_t last = first, count = 0;
    for (; last < walks_.size() && walks_[last].medium == walks_[first].medium; ++last)
      count += walks_[last].count;
    const compile::CompiledMedium& medium = world.media[walks_[first].medium];
    batch_.begin(world, walks_[first].medium, MediumProgram::extinction, count);
    for (std::size_t w = first; w < last; ++w) {
      const Walk& walk = walks_[w];
      places_.clear();
      for (std::size_t k = 0; k < walk.count; ++k) places_.push_back(points_[walk.first + k].t);
      batch_.add(world.volumes[walk.volume], rays[walk.ray].ray, PlacedSamples{places_.data(), walk.count});
    }
    values_.resize(count * batch_.output_count());
    batch_.run(values_.data(), thread);
    thread.statistics.segments += count;
    std::size_t lane = 0;
    for (std::size_t w = first; w < last; lane += walks_[w].count, ++w) {
      Vec3d& transmittance = transmittance_[walks_[w].ray];
      for (std::uint32_t k = 0; k < walks_[w].count; ++k) {
        const Point& point = points_[walks_[w].first + k];
        for (std::size_t c = 0; c < 3; ++c)
          transmittance[c] *= 1 - (values_[medium.extinction_sigma_t[c] * count + lane + k] - point.control) *
                                      point.inverse_rate;
      }
    }
    first = last;
  }
}

// Roulette once a hundredth is left.
bool RatioTracking::goes_on(std::span<const ShadowRay> rays, Walk& walk) {
  if (!(walk.t0 < walk.t1)) return false;
  Vec3d& left = transmittance_[walk.ray];
  const double most = std::max({std::abs(left.x), std::abs(left.y), std::abs(left.z)});
  if (most > 0.01) return true;
  constexpr double survival = 0.25;
  const bool survives = most > 0 && uniform(rays[walk.ray].seed, walk.volume, walk.counter) < survival;
  left = survives ? left / survival : Vec3d{};
  return survives;
}

}  // namespace tyndall::render
