#include "render/transmittance/shadow_rays.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "render/march/segment_limit.h"
#include "render/march/transmittance_roulette.h"
#include "render/surface/transparent_hits.h"
#include "render/transmittance/transmittance_estimators.h"

namespace tyndall::render {

namespace {

// Whether a shadow ray's interval is marched: there is no closed form, and no tracking through a grid.
bool is_marched(const compile::CompiledScene& world, const MarchedInterval& s, Transmittance method) {
  const compile::CompiledVolume& volume = world.volumes[s.volume];
  return !world.media[volume.medium].constant_sigma_t &&
         !(by_ratio(method) && volume.grid != compile::no_index);
}

// What a shadow ray's marched intervals get of the segments that it may have.
SegmentAllotment allotment_of(const compile::CompiledScene& world, std::span<const MarchedInterval> marched,
                              Transmittance method, Statistics& statistics) {
  double wanted = 0;
  std::size_t parts = 0;
  for (const MarchedInterval& s : marched) {
    if (!is_marched(world, s, method)) continue;
    wanted += wanted_segments(s.t1 - s.t0, s.step);
    ++parts;
  }
  const SegmentAllotment allotment(wanted, parts);
  if (wanted <= max_segments) return allotment;
  SegmentAllotment given = allotment;
  SegmentShortage shortage(world);
  for (const MarchedInterval& s : marched) {
    if (!is_marched(world, s, method)) continue;
    shortage.begin_part();
    shortage.add(s);
    shortage.end_part(s.t1 - s.t0, given.next(wanted_segments(s.t1 - s.t0, s.step)));
  }
  shortage.count_in(statistics);
  return allotment;
}

// Each march of one ray has its own jitter; the first has the ray's.
std::uint32_t march_seed(std::uint32_t seed, std::uint32_t march) {
  return march == 0 ? seed : static_cast<std::uint32_t>(hash_bits(seed, march) >> 32);
}

}  // namespace

std::span<const ShadowRay> ShadowBatch::trace(const compile::CompiledScene& world, Transmittance method,
                                              std::span<const ScatteringOrder> orders,
                                              ThreadContext& thread) {
  CHECK(orders.empty() || !by_ratio(method));
  closed_.assign(rays_.size(), Vec3d{});
  boost_.assign(rays_.size(), 1.0);
  before_roulette_.resize(rays_.size());
  segments_.resize(rays_.size());
  estimates_.assign(rays_.size(), {0, 0});
  depth_.clear();
  rest_.clear();
  ratio_.clear(rays_.size());
  for (std::uint32_t r = 0; r < rays_.size(); ++r) {
    ++thread.statistics.shadow_rays;
    const float visible = world.features.see_through
                              ? pass_to_light(world, rays_[r].ray, rays_[r].target_light, thread)
                              : !world.occluded(rays_[r].ray, rays_[r].target_light);
    rays_[r].contribution *= visible;
    rays_[r].higher = Rgb(visible);
    const bool brings = !is_black(rays_[r].contribution) || (visible > 0 && rays_[r].has_higher());
    if (world.features.volumes && brings) collect_intervals(world, r, method, thread);
  }
  for (std::uint32_t round = 0; !rest_.empty(); ++round) {
    take_intervals(round);
    march_intervals(world, thread);
  }
  ratio_.run(world, method, rays_, thread);

  for (std::uint32_t r = 0; r < rays_.size(); ++r) {
    rays_[r].contribution *= transmittance(world, r, method, 1);
    Rgb higher;
    for (std::size_t k = 0; rays_[r].has_higher() && k < orders.size(); ++k)
      higher += higher_[rays_[r].first_higher + k] * transmittance(world, r, method, orders[k].extinction);
    rays_[r].higher *= higher;
  }
  return rays_;
}

Rgb ShadowBatch::transmittance(const compile::CompiledScene& world, std::uint32_t ray, Transmittance method,
                               double extinction) {
  const bool grey = !world.features.chromatic_extinction;
  Vec3d t;
  for (std::size_t c = 0; c < 3; ++c)
    t[c] = c > 0 && grey ? t[0] : transmittance(ray, c, method, extinction) * ratio_.transmittance(ray)[c];
  return Rgb(t);
}

// Closed forms at once; the rest is kept for the march.
void ShadowBatch::collect_intervals(const compile::CompiledScene& world, std::uint32_t ray,
                                    Transmittance method, ThreadContext& thread) {
  if (by_ratio(method))  // walks through the grids by itself
    finder_.find_whole(world, rays_[ray].ray, compile::RayKind::shadow, marched_);
  else
    finder_.find(world, rays_[ray].ray, compile::RayKind::shadow, thread.skips_empty, marched_);
  SegmentAllotment allotment = allotment_of(world, marched_, method, thread.statistics);
  std::uint32_t laid = 0;  // segments of each march
  for (const MarchedInterval& s : marched_) {
    const compile::CompiledVolume& volume = world.volumes[s.volume];
    const compile::CompiledMedium& medium = world.media[volume.medium];
    const double length = s.t1 - s.t0;
    if (medium.constant_sigma_t) {
      closed_[ray] += Vec3d(*medium.constant_sigma_t) * length;
      continue;
    }
    if (!is_marched(world, s, method)) {
      ratio_.add(ray, {s.t0, s.t1, s.volume}, volume.medium);
      continue;
    }
    if (estimates_[ray].count == 0) lay_estimates(ray, method);
    const Estimates& e = estimates_[ray];
    std::uint32_t n = allotment.next(wanted_segments(length, s.step));
    if (method == Transmittance::jackknife) n = (n + 1) / 2;  // of two marches: as many in all
    const double dt = length / n;
    for (std::uint32_t march = e.first; march < e.first + e.count; ++march)
      rest_.push_back({volume.medium, s.volume, ray, march, laid, n, s.t0, dt});
    laid += n;
  }
  // Higher orders may see much of what is dark to the first.
  before_roulette_[ray] = rays_[ray].has_higher() ? laid : segments_before_roulette(world, marched_);
  segments_[ray] = laid;
}

// The next part of all intervals, twice as long in each round. Rays whose beginning is opaque end by chance;
// the others bring as much more. Whatever an estimator makes of the depths, the mean is the same: the chance
// hangs on the beginning alone.
void ShadowBatch::take_intervals(std::uint32_t round) {
  intervals_.clear();
  std::size_t kept = 0;
  std::uint32_t at = static_cast<std::uint32_t>(rays_.size()), end = 0;
  bool goes_on = false;
  for (const ShadowInterval& inside : rest_) {  // ray after ray
    if (inside.ray != at) {
      at = inside.ray;
      end = segments_until(before_roulette_[at], round, segments_[at]);
      goes_on = round == 0 || survives(at, round);
    }
    if (!goes_on) continue;
    const std::uint32_t count = std::min(inside.count, end - std::min(inside.first, end));
    ShadowInterval part = inside;
    part.count = count;
    if (count > 0) intervals_.push_back(part);
    part.first += count;
    part.t0 += count * inside.dt;
    part.count = inside.count - count;
    if (part.count > 0) rest_[kept++] = part;
  }
  rest_.resize(kept);
}

bool ShadowBatch::survives(std::uint32_t ray, std::uint32_t round) {
  const Estimates& e = estimates_[ray];
  double depth = infinity;
  for (std::uint32_t march = e.first; march < e.first + e.count; ++march)
    for (std::size_t c = 0; c < 3; ++c) depth = std::min(depth, closed_[ray][c] + depth_[march][c]);
  const double survival = transmittance_survival(std::exp(-depth) * boost_[ray]);
  const bool survives = survives_transmittance_roulette(rays_[ray].seed, round, survival);
  boost_[ray] /= survival;
  rays_[ray].contribution *= survives ? static_cast<float>(1 / survival) : 0.0f;
  return survives;
}

// How many marches of its own a ray gets.
void ShadowBatch::lay_estimates(std::uint32_t ray, Transmittance method) {
  Estimates& e = estimates_[ray];
  e.first = static_cast<std::uint32_t>(depth_.size());
  switch (method) {
    case Transmittance::march:
    case Transmittance::ratio:
    case Transmittance::residual_ratio:
      e.count = 1;
      break;
    case Transmittance::jackknife:
      e.count = 2;
      break;
    case Transmittance::series:
      e.count = 1 + series_order(rays_[ray].seed);
      break;
  }
  depth_.resize(depth_.size() + e.count);
}

double ShadowBatch::transmittance(std::uint32_t ray, std::size_t c, Transmittance method, double extinction) {
  const Estimates& e = estimates_[ray];
  const double closed = std::exp(-extinction * closed_[ray][c]);
  if (e.count == 0) return closed;
  one_channel_.clear();
  for (std::uint32_t k = 0; k < e.count; ++k) one_channel_.push_back(extinction * depth_[e.first + k][c]);
  switch (method) {
    case Transmittance::march:
    case Transmittance::ratio:
    case Transmittance::residual_ratio:
      return closed * std::exp(-one_channel_[0]);
    case Transmittance::jackknife:
      return closed * jackknife(one_channel_[0], one_channel_[1]);
    case Transmittance::series:
      return closed * power_series(one_channel_);
  }
  return closed;
}

// Runs the extinction programs medium by medium, over all rays' segments.
void ShadowBatch::march_intervals(const compile::CompiledScene& world, ThreadContext& thread) {
  std::stable_sort(intervals_.begin(), intervals_.end(),
                   [](const ShadowInterval& a, const ShadowInterval& b) { return a.medium < b.medium; });
  for (auto first = intervals_.begin(); first != intervals_.end();) {
    const auto last = std::find_if(first, intervals_.end(),
                                   [&](const ShadowInterval& s) { return s.medium != first->medium; });
    const compile::CompiledMedium& medium = world.media[first->medium];
    std::size_t count = 0;
    for (auto s = first; s != last; ++s) count += s->count;

    batch_.begin(world, first->medium, MediumProgram::extinction, count);
    for (auto s = first; s != last; ++s) {
      const std::uint32_t seed = march_seed(rays_[s->ray].seed, s->march - estimates_[s->ray].first);
      batch_.add(world.volumes[s->volume], rays_[s->ray].ray,
                 UniformSamples{s->t0, s->dt, seed, s->first, s->count, !world.features.proven_steps});
    }
    values_.resize(count * batch_.output_count());
    batch_.run(values_.data(), thread);
    thread.statistics.segments += count;
    std::size_t lane = 0;
    Vec3d tau;
    for (auto s = first; s != last; lane += s->count, ++s)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint8_t output = medium.extinction_sigma_t[c];
        if (c > 0 && output == medium.extinction_sigma_t[c - 1]) {
          tau[c] = tau[c - 1];
        } else {
          tau[c] = 0;
          const float* const extinction = values_.data() + output * count + lane;
          for (std::uint32_t k = 0; k < s->count; ++k) tau[c] += extinction[k];
          tau[c] *= s->dt;
        }
        depth_[s->march][c] += tau[c];
      }
    for (auto s = first; s != last; ++s) rays_[s->ray].segments += s->count;
    first = last;
  }
}

}  // namespace tyndall::render
