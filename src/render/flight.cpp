#include "render/flight.h"

#include <algorithm>
#include <cmath>

#include "base/sampler.h"
#include "compile/grid_walk.h"
#include "render/medium_lanes.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;

constexpr std::size_t candidates_together = 32;

// A majorant whose optical depth over one segment is beyond this is cut to it (counted in the statistics):
// shaders without a bound would never let a ray through.
constexpr double greatest_depth = 1e5;

// Null collisions that an emitting volume is to have at least, so that its light is met.
constexpr double least_candidates = 4;

double uniform(const FlightRequest& r) {
  return (static_cast<double>(hash_bits(r.seed, r.flight->counter++) >> 11) + 0.5) * 0x1p-53;
}

struct Bound {
  double t0, t1, majorant;
};

// Of a medium that does not vary in space, the greatest channel.
double uniform_extinction(const CompiledScene& world, const compile::CompiledVolume& volume, const March& m,
                          double t, Worker& worker) {
  if (const auto& constant = world.media[volume.medium].constant_sigma_t) return max_component(*constant);
  const scene::Medium& medium = world.scene.media[volume.medium];
  MediumLanes lanes(world, medium.extinction, worker);
  lanes.reserve(1);
  lanes.set(volume, m.ray, 0, PlacedSamples{&t, 1});
  std::vector<float> values(medium.extinction.outputs.size());
  worker.outputs.clear();
  for (float& v : values) worker.outputs.push_back(&v);
  lanes.run(1, worker.outputs);
  limit_extinction(world, volume.medium, worker.outputs, 1, worker);
  float greatest = 0;
  for (const std::uint8_t k : medium.extinction_sigma_t) greatest = std::max(greatest, values[k]);
  return greatest;
}

// Bounds of one volume's stay.
void bounds_of(const CompiledScene& world, const March& m, const compile::VolumeInterval& i, Worker& worker,
               std::vector<Bound>& out) {
  const compile::CompiledVolume& volume = world.volumes[i.volume];
  const double floor = world.scene.media[volume.medium].emission ? least_candidates / (i.t1 - i.t0) : 0;
  if (volume.grid == compile::no_index) {
    // One value everywhere: of a program that need not be run, or of one that is run once.
    out.push_back({i.t0, i.t1, std::max(floor, uniform_extinction(world, volume, m, i.t0, worker))});
    return;
  }
  compile::GridWalk walk(*world.grids[volume.grid_at(m.ray.time)], volume.medium_from_render_at(m.ray.time),
                         m.ray, i.t0, i.t1, worker.bounds);
  compile::MajorantSegment s;
  while (walk.next(s)) {
    double majorant = s.bounds.majorant;
    const double most = greatest_depth / std::max(s.t1 - s.t0, 1e-300);
    if (majorant > most && s.bounds.minorant < s.bounds.majorant) {
      majorant = std::max<double>(most, s.bounds.minorant);
      ++worker.statistics.cut_majorants;
    }
    out.push_back({s.t0, s.t1, std::max(floor, majorant)});
  }
}

// The sum of all volumes' bounds.
void lay_line(const CompiledScene& world, const March& m, Worker& worker, MajorantLine& line) {
  std::vector<Bound> bounds;
  for (const compile::VolumeInterval& i : m.intervals) bounds_of(world, m, i, worker, bounds);
  line.edges.clear();
  for (const Bound& b : bounds) line.edges.insert(line.edges.end(), {b.t0, b.t1});
  std::sort(line.edges.begin(), line.edges.end());
  line.edges.erase(std::unique(line.edges.begin(), line.edges.end()), line.edges.end());
  line.majorant.assign(line.edges.empty() ? 0 : line.edges.size() - 1, 0.0);
  for (const Bound& b : bounds) {
    auto k = static_cast<std::size_t>(std::lower_bound(line.edges.begin(), line.edges.end(), b.t0) -
                                      line.edges.begin());
    for (; k < line.majorant.size() && line.edges[k] < b.t1; ++k) line.majorant[k] += b.majorant;
  }
}

// The next candidates after the cursor, a Poisson process with the majorant's rate. Leaves the cursor at the
// last one, or at infinity when there are no more.
void draw_candidates(const FlightRequest& r) {
  Flight& f = *r.flight;
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

Vec3d extinction(const March& m, std::size_t i) {
  return {m.sigma_t[m.extinction_row(0)][i], m.sigma_t[m.extinction_row(1)][i],
          m.sigma_t[m.extinction_row(2)][i]};
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

// Surfaces up to t that let only a part through are met by chance too: a path has one end.
void cross_until(const FlightRequest& r, double t) {
  Flight& f = *r.flight;
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

// What the candidates are, one after the other. False when the flight is over.
bool walk_candidates(const CompiledScene& world, const FlightRequest& r, Vec3d& emitted) {
  Flight& f = *r.flight;
  const March& m = *r.march;
  for (std::size_t j = 0; j < m.t0.size(); ++j) {
    cross_until(r, m.t0[j]);
    const double majorant = f.candidate_majorant[j];
    const Vec3d sigma_t = extinction(m, j);
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

// A flight that goes on only for the sake of its aimed point, and from which little is left, ends by
// roulette.
bool still_worth(const FlightRequest& r) {
  Flight& f = *r.flight;
  if (!f.ended()) return true;
  const double left = std::max({f.aimed_through.x, f.aimed_through.y, f.aimed_through.z});
  if (left * f.aimed_boost > 0.01) return true;
  constexpr double survival = 0.1;
  const bool survives = uniform(r) < survival;
  f.aimed_boost = survives ? f.aimed_boost / survival : 0.0;
  return survives;
}

// The points that light is taken at, evaluated again side by side: what the march holds when all is done.
void keep_points(const FlightRequest& r) {
  March& m = *r.march;
  const Flight& f = *r.flight;
  m.t0.clear();
  if (f.collided) m.t0.push_back(f.t);
  if (f.aimed_t) m.t0.push_back(*f.aimed_t);
  std::sort(m.t0.begin(), m.t0.end());
}

// The march's totals are what the flight found: all is scattered at one point, or all goes through.
void show_in_march(const Flight& f, March& m) {
  for (std::size_t c = 0; c < 3; ++c) {
    m.transmittance[c].resize(m.count + 1);
    m.scattered[c].resize(m.count + 1);
    m.transmittance[c][m.count] = f.ended() ? 0.0 : f.weight[c];
    m.scattered[c][m.count] = f.collided ? f.weight[c] : 0.0;
  }
}

void finish(const FlightRequest& r, const Vec3d& emitted) {
  March& m = *r.march;
  Flight& f = *r.flight;
  cross_until(r, infinity);
  m.emitted = Rgb(emitted);
  if (!f.collided) f.weight = Rgb(f.through);
  show_in_march(f, m);
  if (!f.aimed_t) return;
  const std::uint32_t i = m.segment_at(*f.aimed_t);
  const Vec3d sigma_t = extinction(m, i), sigma_s = channels(m.sigma_s, m, i);
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
  m.scattering_stretches.clear();
  if (world.features.volumes) world.volume_intervals(ray, kind, m.intervals);
  for (const compile::VolumeInterval& i : m.intervals) {  // in order of t0
    if (!world.scene.media[world.volumes[i.volume].medium].scatters()) continue;
    auto& stretches = m.scattering_stretches;
    if (!stretches.empty() && i.t0 <= stretches.back().hi)
      stretches.back().hi = std::max(stretches.back().hi, i.t1);
    else
      stretches.push_back({i.t0, i.t1});
  }
}

void track(const CompiledScene& world, std::span<const FlightRequest> requests, Worker& worker) {
  std::vector<MarchRequest> batch;
  std::vector<Vec3d> emitted(requests.size());
  std::vector<std::size_t> flying;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    Flight& f = *requests[i].flight;
    const std::optional<double> aimed = f.aimed_t;
    MajorantLine line = std::move(f.line);
    std::vector<double> memory = std::move(f.candidate_majorant);
    f = {};
    f.aimed_t = aimed;
    f.line = std::move(line);
    f.candidate_majorant = std::move(memory);
    f.through = f.aimed_through = f.aimed_weights = Vec3d(1);
    lay_line(world, *requests[i].march, worker, f.line);
    if (!f.line.majorant.empty()) flying.push_back(i);
  }
  while (!flying.empty()) {
    batch.clear();
    for (const std::size_t i : flying) {
      draw_candidates(requests[i]);
      batch.push_back({requests[i].march->ray, {}, 0, requests[i].march});
    }
    evaluate_points(world, batch, worker);
    std::erase_if(flying, [&](std::size_t i) {
      return !(walk_candidates(world, requests[i], emitted[i]) && still_worth(requests[i]));
    });
  }
  batch.clear();
  for (const FlightRequest& r : requests) {
    keep_points(r);
    batch.push_back({r.march->ray, {}, 0, r.march});
  }
  evaluate_points(world, batch, worker);
  for (std::size_t i = 0; i < requests.size(); ++i) finish(requests[i], emitted[i]);
}

void fly_to_depth(March& m, const Rgb& throughput, float u_channel, float u, Flight& f) {
  f.collided = f.stopped = false;
  f.aimed_t = {};
  std::array<double, 3> share{};
  double all = 0;
  for (std::size_t c = 0; c < 3; ++c) all += share[c] = std::abs(throughput[c]);
  if (!(all > 0)) share = {1, 1, 1}, all = 3;
  std::size_t channel = 0;
  for (double rest = u_channel * all; channel < 2 && rest >= share[channel]; ++channel)
    rest -= share[channel];
  const auto mean = [&](const Vec3d& v) { return (share[0] * v.x + share[1] * v.y + share[2] * v.z) / all; };
  const int row = m.extinction_row(static_cast<int>(channel));
  const double left = 1 - double{u};  // the flight ends where less is left

  double reached = infinity;  // no surface lets it further than here
  for (MarchCrossing& c : m.crossings) {
    const Vec3d before(c.before);
    c.before = {};
    if (f.stopped || before[channel] * c.pass >= left) continue;
    f.stopped = true;
    reached = c.t;
    c.before = Rgb(before / (mean(before) * (1 - c.pass)));
  }
  const std::vector<double>& transmittance = m.transmittance[row];
  for (std::uint32_t i = 0; i < m.count && m.t0[i] < reached; ++i) {
    const double sigma = m.sigma_t[row][i], end = transmittance[i] * std::exp(-sigma * m.dt[i]);
    if (end >= left) continue;
    f.collided = true;
    f.t = m.t0[i] + std::clamp(std::log(transmittance[i] / left) / sigma, 0.0, m.dt[i]);
    const Vec3d through(m.transmittance_at(i, f.t));
    f.density = mean(extinction(m, i) * through);
    f.weight = f.density > 0 ? Rgb(through * Vec3d(m.sigma_s_at(i)) / f.density) : Rgb{};
    break;
  }
  if (f.collided) {
    f.stopped = false;
    for (MarchCrossing& c : m.crossings) c.before = {};
  } else {
    const Vec3d through(m.end_transmittance());
    f.weight = mean(through) > 0 ? Rgb(through / mean(through)) : Rgb{};
  }
  show_in_march(f, m);
}

}  // namespace tyndall::render
