#include "render/tracking/delta_tracking.h"

#include <algorithm>
#include <cmath>

#include "base/sampler.h"
#include "render/march/majorant_limit.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;

constexpr std::size_t candidates_together = 32;

// Null collisions that an emitting volume is to have at least, so that paths end in its light.
constexpr double least_candidates = 4;

double uniform(const TrackingRequest& r) {
  return open_unit_double(hash_bits(r.seed, r.free_path->counter++));
}

// The next candidates after the cursor, a Poisson process with the majorant's rate. Leaves the cursor at the
// last one, or at infinity when there are no more.
void draw_candidates(const TrackingRequest& r) {
  FreePath& f = *r.free_path;
  March& m = *r.march;
  m.t0.clear();
  f.candidate_majorant.clear();
  const auto after = std::upper_bound(f.line.edges.begin(), f.line.edges.end(), f.cursor);
  auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - f.line.edges.begin() - 1, 0));
  double t = std::max(f.cursor, f.line.edges.empty() ? 0.0 : f.line.edges.front());
  double depth = -std::log(uniform(r));  // optical depth of the majorant to the next candidate
  for (; k < f.line.majorant.size();) {
    const double majorant = f.line.majorant[k], left = (f.line.edges[k + 1] - t) * majorant;
    if (depth >= left) {
      depth -= left;
      t = f.line.edges[++k];
      continue;
    }
    t += depth / majorant;
    m.t0.push_back(t);
    f.candidate_majorant.push_back(majorant);
    if (m.t0.size() == candidates_together) break;
    depth = -std::log(uniform(r));
  }
  f.cursor = k < f.line.majorant.size() ? t : infinity;
}

Vec3d channels(const std::array<std::vector<float>, 3>& rows, const March& m, std::size_t i) {
  return m.channels == 1 ? Vec3d(rows[0][i]) : Vec3d{rows[0][i], rows[1][i], rows[2][i]};
}
double sum_of(const Vec3d& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// Probability that a candidate is null, for what the path would carry to it.
double null_probability(const Rgb& throughput, const Vec3d& through, const Vec3d& null, double majorant) {
  const Vec3d carried = Vec3d(throughput) * through;
  const double all = sum_of(carried);
  const double share = all > 0 ? sum_of(carried * null) / all : (null.x + null.y + null.z) / 3;
  return std::min(share / majorant, 1.0);
}

// Surfaces up to t that let only a part through are hit by chance too: a path has one end.
void cross_until(const TrackingRequest& r, double t) {
  FreePath& f = *r.free_path;
  auto& crossings = r.march->crossings;
  for (; f.crossing < crossings.size() && crossings[f.crossing].t <= t; ++f.crossing) {
    MarchCrossing& c = crossings[f.crossing];
    c.before = {};
    if (f.aimed_t && c.t < *f.aimed_t) {
      f.aimed_through *= c.pass;
      f.aimed_null_probability *= c.pass;
    }
    if (f.ended()) continue;
    if (uniform(r) >= c.pass) {
      f.stopped = true;
      c.before = Rgb(f.through / (1 - c.pass));  // of which the surface's opacity takes its part
    } else {
      f.null_probability *= c.pass;
    }
  }
}

// What the candidates are, one after the other. False when the free path is over.
bool walk_candidates(const CompiledScene& world, const TrackingRequest& r, Vec3d& emitted) {
  FreePath& f = *r.free_path;
  const March& m = *r.march;
  for (std::size_t j = 0; j < m.t0.size(); ++j) {
    cross_until(r, m.t0[j]);
    const double majorant = f.candidate_majorant[j];
    const Vec3d sigma_t = m.sigma_t_at(j);
    Vec3d null;
    for (std::size_t c = 0; c < 3; ++c) null[c] = std::max(0.0, majorant - sigma_t[c]);
    const double p_null = null_probability(r.throughput, f.through, null, majorant);
    if (!f.ended()) {
      if (world.features.medium_emission) emitted += f.through * channels(m.emission, m, j) / majorant;
      if (uniform(r) >= p_null) {
        f.collided = true;
        f.t = m.t0[j];
        f.density = majorant * (1 - p_null) * f.null_probability;
        f.weight = Rgb(f.through * channels(m.sigma_s, m, j) / (majorant * (1 - p_null)));
      }
    }
    const bool aims = f.aimed_t && m.t0[j] < *f.aimed_t;
    if (aims) {
      f.aimed_through = f.aimed_through * null / majorant;
      f.aimed_null_probability *= p_null;
    }
    if (f.ended() && !(aims && f.aimed_null_probability > 0)) return false;
    if (p_null > 0) {
      f.through = f.through * null / (majorant * p_null);
      f.null_probability *= p_null;
    }
    if (aims) f.aimed_weights = f.through;
  }
  return f.cursor < infinity;
}

// A free path that goes on only for the sake of its aimed point, and on which little is left, ends by Russian
// roulette.
bool still_worth(const TrackingRequest& r) {
  FreePath& f = *r.free_path;
  if (!f.ended()) return true;
  const double left = std::max({f.aimed_through.x, f.aimed_through.y, f.aimed_through.z});
  if (left * f.aimed_boost > 0.01) return true;
  constexpr double survival = 0.1;
  const bool survives = uniform(r) < survival;
  f.aimed_boost = survives ? f.aimed_boost / survival : 0.0;
  return survives;
}

// The points that light is taken at, evaluated again side by side: what the march holds when all is done.
void keep_points(const TrackingRequest& r) {
  March& m = *r.march;
  const FreePath& f = *r.free_path;
  m.t0.clear();
  if (f.collided) m.t0.push_back(f.t);
  if (f.aimed_t) m.t0.push_back(*f.aimed_t);
  std::sort(m.t0.begin(), m.t0.end());
}

void finish(const TrackingRequest& r, const Vec3d& emitted) {
  March& m = *r.march;
  FreePath& f = *r.free_path;
  cross_until(r, infinity);
  m.emitted = Rgb(emitted);
  if (!f.collided) f.weight = Rgb(f.through);
  set_totals(f, m);
  if (!f.aimed_t) return;
  const std::uint32_t i = m.segment_at(*f.aimed_t);
  const Vec3d sigma_t = m.sigma_t_at(i), sigma_s = channels(m.sigma_s, m, i);
  f.aimed_weight = Rgb(f.aimed_through * sigma_s * f.aimed_boost);
  // As density: majorant (1 - P_null) = the share of extinction in what is carried.
  const Vec3d carried = Vec3d(r.throughput) * f.aimed_weights;
  const double all = sum_of(carried);
  const double real = all > 0 ? sum_of(carried * sigma_t) / all : (sigma_t.x + sigma_t.y + sigma_t.z) / 3;
  f.aimed_density = real * f.aimed_null_probability;
}

}  // namespace

void find_volumes(const CompiledScene& world, const compile::Ray& ray, compile::RayKind kind, March& m) {
  m.ray = ray;
  m.channels = world.features.chromatic ? 3 : 1;
  m.extinction_channels = world.features.chromatic_extinction ? 3 : 1;
  m.intervals.clear();
  m.regions.clear();
  m.scattering_intervals.clear();
  if (world.features.volumes) world.volume_intervals(ray, kind, m.intervals);
  for (const compile::VolumeInterval& i : m.intervals) {  // in order of t0
    if (!world.media[world.volumes[i.volume].medium].scatters()) continue;
    auto& scattering = m.scattering_intervals;
    if (!scattering.empty() && i.t0 <= scattering.back().hi)
      scattering.back().hi = std::max(scattering.back().hi, i.t1);
    else
      scattering.push_back({i.t0, i.t1});
  }
}

// Of a medium that does not vary in space, the greatest channel.
double DeltaTracker::uniform_extinction(const CompiledScene& world, const compile::CompiledVolume& volume,
                                        const March& m, double t, ThreadContext& thread) {
  if (const auto& constant = world.media[volume.medium].constant_sigma_t) return max_component(*constant);
  batch_.begin(world, volume.medium, MediumProgram::extinction, 1);
  batch_.add(volume, m.ray, PlacedSamples{&t, 1});
  values_.resize(batch_.output_count());
  batch_.run(values_.data(), thread);
  float greatest = 0;
  for (const std::uint8_t k : world.media[volume.medium].extinction_sigma_t)
    greatest = std::max(greatest, values_[k]);
  return greatest;
}

// Bounds of the extinction of one volume.
void DeltaTracker::add_bounds(const CompiledScene& world, const March& m, const compile::VolumeInterval& i,
                              ThreadContext& thread) {
  const compile::CompiledVolume& volume = world.volumes[i.volume];
  const double floor = world.media[volume.medium].emission ? least_candidates / (i.t1 - i.t0) : 0;
  if (volume.grid == compile::no_index) {
    // One value everywhere: of a program that need not be run, or of one that is run once.
    bounds_.push_back({i.t0, i.t1, std::max(floor, uniform_extinction(world, volume, m, i.t0, thread))});
    return;
  }
  compile::MajorantDda walk(*world.grids[volume.grid_at(m.ray.time)],
                            volume.medium_from_render_at(m.ray.time), m.ray, i.t0, i.t1, majorant_scratch_);
  compile::MajorantSegment s;
  while (walk.next(s)) {
    bounds_.push_back({s.t0, s.t1, std::max(floor, limited_majorant(s, thread))});
  }
}

// The sum of all volumes' bounds.
void DeltaTracker::lay_line(const CompiledScene& world, const March& m, ThreadContext& thread,
                            MajorantLine& line) {
  bounds_.clear();
  for (const compile::VolumeInterval& i : m.intervals) add_bounds(world, m, i, thread);
  line.edges.clear();
  for (const Bound& b : bounds_) line.edges.insert(line.edges.end(), {b.t0, b.t1});
  std::sort(line.edges.begin(), line.edges.end());
  line.edges.erase(std::unique(line.edges.begin(), line.edges.end()), line.edges.end());
  line.majorant.assign(line.edges.empty() ? 0 : line.edges.size() - 1, 0.0);
  for (const Bound& b : bounds_) {
    auto k = static_cast<std::size_t>(std::lower_bound(line.edges.begin(), line.edges.end(), b.t0) -
                                      line.edges.begin());
    for (; k < line.majorant.size() && line.edges[k] < b.t1; ++k) line.majorant[k] += b.majorant;
  }
}

// Clears the free paths, but for their aims and their memory, and lays the majorants along their rays.
void DeltaTracker::begin(const CompiledScene& world, std::span<const TrackingRequest> requests,
                         ThreadContext& thread) {
  emitted_.assign(requests.size(), Vec3d{});
  unfinished_.clear();
  for (std::size_t i = 0; i < requests.size(); ++i) {
    FreePath& f = *requests[i].free_path;
    const std::optional<double> aimed = f.aimed_t;
    MajorantLine line = std::move(f.line);
    std::vector<double> memory = std::move(f.candidate_majorant);
    f = {};
    f.aimed_t = aimed;
    f.line = std::move(line);
    f.candidate_majorant = std::move(memory);
    f.through = f.aimed_through = f.aimed_weights = Vec3d(1);
    lay_line(world, *requests[i].march, thread, f.line);
    if (!f.line.majorant.empty()) unfinished_.push_back(i);
  }
}

void DeltaTracker::track(const CompiledScene& world, std::span<const TrackingRequest> requests,
                         ThreadContext& thread) {
  begin(world, requests, thread);
  while (!unfinished_.empty()) {
    points_.clear();
    for (const std::size_t i : unfinished_) {
      draw_candidates(requests[i]);
      points_.push_back({requests[i].march->ray, {}, 0, requests[i].march});
    }
    marcher_.evaluate_points(world, points_, thread);
    std::erase_if(unfinished_, [&](std::size_t i) {
      requests[i].march->outputs.reset();
      return !(walk_candidates(world, requests[i], emitted_[i]) && still_worth(requests[i]));
    });
  }
  points_.clear();
  for (const TrackingRequest& r : requests) {
    keep_points(r);
    points_.push_back({r.march->ray, {}, 0, r.march});
  }
  marcher_.evaluate_points(world, points_, thread);
  for (std::size_t i = 0; i < requests.size(); ++i) finish(requests[i], emitted_[i]);
}

}  // namespace tyndall::render
