#include "render/march.h"

#include <algorithm>
#include <cmath>

#include "render/medium_lanes.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;

// The stretches that are active between two edges next to each other, one pair after another.
class ActiveStretches {
 public:
  // Keeps both; the stretches are in order of t0.
  ActiveStretches(std::span<const Stretch> all, std::vector<std::uint32_t>& active)
      : all_(all), active_(active) {
    active_.clear();
  }
  std::span<const std::uint32_t> between(const Intervald& t) {
    std::erase_if(active_, [&](std::uint32_t i) { return all_[i].t1 <= t.lo; });
    for (; next_ < all_.size() && all_[next_].t0 <= t.lo; ++next_)
      if (t.lo < all_[next_].t1) active_.push_back(next_);
    return active_;
  }

 private:
  std::span<const Stretch> all_;
  std::vector<std::uint32_t>& active_;
  std::uint32_t next_ = 0;
};

// Cuts the ray at every end of a stretch and at every crossing, and lays segments into the regions between,
// where some volume is.
void lay_segments(const CompiledScene& world, Worker& worker, March& m) {
  m.regions.clear();
  m.scattering_stretches.clear();
  std::vector<double>& edges = worker.edges;
  edges.clear();
  for (const Stretch& s : m.stretches) edges.insert(edges.end(), {s.t0, s.t1});
  if (!edges.empty())
    for (const MarchCrossing& c : m.crossings) edges.push_back(c.t);
  if (edges.size() > 2) {
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }

  double wanted = 0;  // segments, before the bound
  ActiveStretches stretches(m.stretches, worker.active);
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    Region region{{edges[e], edges[e + 1]}, 0, 0, false};
    const std::span<const std::uint32_t> active = stretches.between(region.t);
    if (active.empty()) continue;
    double step = infinity;
    for (const std::uint32_t i : active) {
      Stretch& s = m.stretches[i];
      if (s.region_count++ == 0) s.first_region = static_cast<std::uint32_t>(m.regions.size());
      region.scatters |= world.scene.media[world.volumes[s.volume].medium].scatters();
      step = std::min(step, s.step);
    }
    const double segments = std::max(1.0, std::ceil(region.t.length() / step));  // step infinite: one
    region.count = static_cast<std::uint32_t>(std::min<double>(segments, max_segments));
    wanted += segments;
    m.regions.push_back(region);
  }
  if (wanted > max_segments) {
    ++worker.statistics.widened_marches;
    const double shrink =
        std::max(1.0, double{max_segments} - static_cast<double>(m.regions.size())) / wanted;
    for (Region& r : m.regions)
      r.count = std::max(1u, static_cast<std::uint32_t>(r.count * std::min(1.0, shrink)));
  }

  m.count = 0;
  for (Region& r : m.regions) {
    r.first = m.count;
    m.count += r.count;
    if (!r.scatters) continue;
    if (!m.scattering_stretches.empty() && m.scattering_stretches.back().hi == r.t.lo)
      m.scattering_stretches.back().hi = r.t.hi;
    else
      m.scattering_stretches.push_back(r.t);
  }
  m.t0.resize(m.count);
  m.dt.resize(m.count);
  for (const Region& r : m.regions) {
    const double dt = r.t.length() / r.count;
    for (std::uint32_t k = 0; k < r.count; ++k) {
      m.t0[r.first + k] = r.t.lo + k * dt;
      m.dt[r.first + k] = dt;
    }
  }
}

// The segments of each stretch.
void lay_blocks(const CompiledScene& world, March& m) {
  m.blocks.clear();
  for (const Stretch& s : m.stretches) {
    if (s.region_count == 0) continue;
    const Region& first = m.regions[s.first_region];
    const Region& last = m.regions[s.first_region + s.region_count - 1];
    Block block;
    block.volume = s.volume;
    block.first = first.first;
    block.count = last.first + last.count - first.first;
    block.row_length = world.media[world.volumes[s.volume].medium].homogeneous ? 1 : block.count;
    m.blocks.push_back(block);
  }
}

// The blocks of all rays, those of one medium next to each other: one batch each, whose rows they share.
// Gives the floats that the batches' outputs take.
std::size_t lay_batches(const CompiledScene& world, std::span<const MarchRequest> requests, Worker& worker) {
  std::vector<MarchBatchEntry>& entries = worker.march_batch;
  entries.clear();
  for (std::uint32_t r = 0; r < requests.size(); ++r)
    for (std::uint32_t b = 0; b < requests[r].out->blocks.size(); ++b)
      entries.push_back({world.volumes[requests[r].out->blocks[b].volume].medium, r, b});
  std::sort(entries.begin(), entries.end());
  std::size_t floats = 0;
  for (auto first = entries.begin(); first != entries.end();) {
    std::size_t lanes = 0;
    auto last = first;
    for (; last != entries.end() && last->medium == first->medium; ++last) {
      Block& block = requests[last->request].out->blocks[last->block];
      block.rows = floats + lanes;
      lanes += block.row_length;
    }
    for (; first != last; ++first) requests[first->request].out->blocks[first->block].pitch = lanes;
    floats += lanes * world.scene.media[std::prev(last)->medium].full.outputs.size();
  }
  return floats;
}

// Runs one medium's program over the segments of all rays in it.
void evaluate_batch(const CompiledScene& world, std::span<const MarchRequest> requests,
                    std::span<const MarchBatchEntry> entries, Worker& worker) {
  const std::uint32_t medium = entries.front().medium;
  const vm::Program& program = world.scene.media[medium].full;
  const Block& front = requests[entries.front().request].out->blocks[entries.front().block];
  float* const rows = worker.march_pool.data() + front.rows;
  const std::size_t count = front.pitch;
  if (world.media[medium].constant) {
    for (std::size_t k = 0; k < program.outputs.size(); ++k)
      std::fill_n(rows + k * count, count, program.constants[program.outputs[k]]);
    return;
  }
  MediumLanes lanes(world, program, worker);
  lanes.reserve(count);
  if (!world.media[medium].homogeneous) {
    std::size_t lane = 0;
    for (const MarchBatchEntry& e : entries) {
      const MarchRequest& request = requests[e.request];
      const March& m = *request.out;
      const Block& b = m.blocks[e.block];
      lanes.set(world.volumes[b.volume], m.ray, lane, b.row_length, [&](std::size_t k) {
        const auto s = static_cast<std::uint32_t>(b.first + k);
        return m.t0[s] + jitter(request.seed, s) * m.dt[s];
      });
      lane += b.row_length;
    }
  }
  worker.outputs.clear();
  for (std::size_t k = 0; k < program.outputs.size(); ++k) worker.outputs.push_back(rows + k * count);
  lanes.run(count, worker.outputs);
  for (std::size_t k = 0; k < worker.outputs.size(); ++k)
    clamp_bad_values(worker.outputs[k], count, world.media[medium].may_be_negative[k], medium, k, worker);
}

// Runs the programs: one batch a medium.
void evaluate(const CompiledScene& world, std::span<const MarchRequest> requests, Worker& worker) {
  const std::size_t floats = lay_batches(world, requests, worker);
  if (worker.march_pool.size() < floats) worker.march_pool.resize(floats);
  const std::span<const MarchBatchEntry> entries = worker.march_batch;
  for (std::size_t first = 0; first < entries.size();) {
    std::size_t last = first;
    while (last < entries.size() && entries[last].medium == entries[first].medium) ++last;
    evaluate_batch(world, requests, entries.subspan(first, last - first), worker);
    first = last;
  }
}

// Adds one output of a block to a row of segments.
void add_output(const March& m, const Block& b, std::size_t output, std::vector<float>& row) {
  const float* from = m.pool + b.rows + output * b.pitch;
  float* to = row.data() + b.first;
  if (b.row_length == 1)
    for (std::uint32_t k = 0; k < b.count; ++k) to[k] += from[0];
  else
    for (std::uint32_t k = 0; k < b.count; ++k) to[k] += from[k];
}

// Coefficients add where volumes overlap.
void add_coefficients(const CompiledScene& world, March& m) {
  const bool emission = world.features.medium_emission;
  for (int c = 0; c < m.channels; ++c) {
    m.sigma_s[c].assign(m.count, 0.0f);
    if (emission) m.emission[c].assign(m.count, 0.0f);
  }
  for (int c = 0; c < m.extinction_channels; ++c) m.sigma_t[c].assign(m.count, 0.0f);
  for (const Block& b : m.blocks) {
    const scene::Medium& medium = world.scene.media[world.volumes[b.volume].medium];
    for (int c = 0; c < m.channels; ++c) {
      add_output(m, b, medium.sigma_s[c], m.sigma_s[c]);
      if (medium.emission) add_output(m, b, (*medium.emission)[c], m.emission[c]);
    }
    for (int c = 0; c < m.extinction_channels; ++c) add_output(m, b, medium.sigma_t[c], m.sigma_t[c]);
  }
}

// Transmittance at every segment's start, and ∫ T over every segment (into `reach`), each exact for constant
// coefficients.
void accumulate_transmittance(int channel, const std::vector<float>& sigma_t, March& m,
                              std::vector<double>& transmittance, std::vector<double>& reach) {
  transmittance.resize(m.count + 1);
  reach.resize(m.count);
  double t = 1;
  auto crossing = m.crossings.begin();
  const auto cross_before = [&](double end) {
    for (; crossing != m.crossings.end() && crossing->t <= end; ++crossing) {
      crossing->before[channel] = static_cast<float>(t);
      t *= crossing->pass;
    }
  };
  for (std::uint32_t i = 0; i < m.count; ++i) {
    cross_before(m.t0[i]);
    transmittance[i] = t;
    const double sigma = sigma_t[i], depth = sigma * m.dt[i];
    reach[i] = t * m.dt[i];
    if (depth == 0) continue;
    // Either way 1 - T and the sum of sigma * reach are equal to rounding.
    if (depth < 0.25) {
      reach[i] *= exp_average(depth);
      t -= sigma * reach[i];
    } else {
      const double through = std::exp(-depth);
      reach[i] *= (1 - through) / depth;
      t *= through;
    }
  }
  cross_before(infinity);
  transmittance[m.count] = t;
}

// Running sums from the ray's start.
void accumulate(const CompiledScene& world, Worker& worker, March& m) {
  Vec3d emitted;
  for (int c = 0; c < m.channels; ++c) {
    if (c < m.extinction_channels)
      accumulate_transmittance(c, m.sigma_t[c], m, m.transmittance[c], worker.reach);
    m.scattered[c].resize(m.count + 1);
    double s = 0;
    for (std::uint32_t i = 0; i < m.count; ++i) {
      m.scattered[c][i] = s;
      s += m.sigma_s[c][i] * worker.reach[i];
    }
    m.scattered[c][m.count] = s;
    if (world.features.medium_emission)
      for (std::uint32_t i = 0; i < m.count; ++i) emitted[c] += m.emission[c][i] * worker.reach[i];
  }
  if (m.extinction_channels == 1)
    for (MarchCrossing& crossing : m.crossings) crossing.before = Rgb(crossing.before.x);
  m.emitted = m.channels == 1 ? Rgb(static_cast<float>(emitted.x)) : Rgb(emitted);
}

}  // namespace

void march(const CompiledScene& world, std::span<const MarchRequest> requests, Worker& worker) {
  for (const MarchRequest& request : requests) {
    March& m = *request.out;
    m.ray = request.ray;
    m.channels = world.features.chromatic ? 3 : 1;
    m.extinction_channels = world.features.chromatic_extinction ? 3 : 1;
    m.stretches.clear();
    if (world.features.volumes) find_stretches(world, m.ray, request.kind, worker, m.stretches);
    lay_segments(world, worker, m);
    lay_blocks(world, m);
  }
  evaluate(world, requests, worker);
  for (const MarchRequest& request : requests) {
    March& m = *request.out;
    m.pool = worker.march_pool.data();
    add_coefficients(world, m);
    accumulate(world, worker, m);
    worker.statistics.marches += m.count > 0;
    worker.statistics.segments += m.count;
  }
}

void march(const CompiledScene& world, const compile::Ray& ray, compile::RayKind kind, std::uint32_t seed,
           Worker& worker, March& out) {
  const MarchRequest request{ray, kind, seed, &out};
  march(world, std::span(&request, 1), worker);
}

void evaluate_points(const CompiledScene& world, std::span<const MarchRequest> requests, Worker& worker) {
  for (const MarchRequest& request : requests) {
    March& m = *request.out;
    m.count = static_cast<std::uint32_t>(m.t0.size());
    m.dt.assign(m.count, 0.0);
    m.blocks.clear();
    for (const auto& i : m.intervals) {
      const auto first = std::lower_bound(m.t0.begin(), m.t0.end(), i.t0),
                 last = std::lower_bound(first, m.t0.end(), i.t1);
      if (first == last) continue;
      Block block;
      block.volume = i.volume;
      block.first = static_cast<std::uint32_t>(first - m.t0.begin());
      block.count = static_cast<std::uint32_t>(last - first);
      block.row_length = world.media[world.volumes[i.volume].medium].homogeneous ? 1 : block.count;
      m.blocks.push_back(block);
    }
  }
  evaluate(world, requests, worker);
  for (const MarchRequest& request : requests) {
    request.out->pool = worker.march_pool.data();
    add_coefficients(world, *request.out);
    worker.statistics.segments += request.out->count;
  }
}

std::uint32_t March::segment_at(double t) const {
  const auto after = std::upper_bound(t0.begin(), t0.begin() + count, t);
  return after == t0.begin() ? 0 : static_cast<std::uint32_t>(after - t0.begin() - 1);
}

double March::optical_depth() const {
  double sum = 0;
  for (int c = 0; c < extinction_channels; ++c)
    for (std::uint32_t i = 0; i < count; ++i) sum += sigma_t[c][i] * dt[i];
  return sum / extinction_channels;
}

Rgb March::albedo_at(std::uint32_t i) const {
  Rgb albedo;
  for (int c = 0; c < 3; ++c) {
    const float s = sigma_s[channels == 1 ? 0 : c][i], t = sigma_t[extinction_row(c)][i];
    albedo[c] = t > 0 ? s / t : 0.0f;
  }
  return albedo;
}

Vec3d March::transmittance_at(std::uint32_t i, double t) const {
  Vec3d out;
  const double x = std::clamp(t - t0[i], 0.0, dt[i]);
  for (int c = 0; c < extinction_channels; ++c)
    out[c] = transmittance[c][i] * std::exp(-double{sigma_t[c][i]} * x);
  return extinction_channels == 1 ? Vec3d(out.x) : out;
}

}  // namespace tyndall::render
