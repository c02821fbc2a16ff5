#include "render/march.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/dark.h"
#include "render/march_sums.h"
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

// The ends of stretches and the crossings, in order.
void find_edges(const March& m, std::vector<double>& edges) {
  edges.clear();
  for (const Stretch& s : m.stretches) edges.insert(edges.end(), {s.t0, s.t1});
  if (!edges.empty())
    for (const MarchCrossing& c : m.crossings) edges.push_back(c.t);
  if (edges.size() > 2) {
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }
}

// Shares out the limit over regions that want more in all.
void limit_segments(const CompiledScene& world, double wanted, Worker& worker, March& m) {
  SegmentAllotment allotment(wanted, m.regions.size());
  SegmentShortage shortage(world);
  ActiveStretches stretches(m.stretches, worker.active);
  for (Region& region : m.regions) {
    double step = infinity;
    shortage.begin_part();
    for (const std::uint32_t i : stretches.between(region.t)) {
      step = std::min(step, m.stretches[i].step);
      shortage.add(m.stretches[i]);
    }
    region.count = allotment.next(wanted_segments(region.t.length(), step));
    shortage.end_part(region.t.length(), region.count);
  }
  shortage.count_in(worker.statistics);
}

// Cuts the ray at every edge, and lays segments into the regions between, where some volume is.
void lay_segments(const CompiledScene& world, Worker& worker, March& m) {
  m.regions.clear();
  const std::vector<double>& edges = worker.edges;
  find_edges(m, worker.edges);
  double wanted = 0;  // segments, before the limit
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
    const double segments = wanted_segments(region.t.length(), step);
    region.count = static_cast<std::uint32_t>(std::min<double>(segments, max_segments));
    wanted += segments;
    m.regions.push_back(region);
  }
  if (wanted > max_segments) limit_segments(world, wanted, worker, m);

  m.count = m.progress.laid = 0;
  for (Region& r : m.regions) {
    r.first = m.progress.laid;
    m.progress.laid += r.count;
  }
  if (const std::size_t room = m.progress.laid + widest_lanes; m.t0.size() < room) {
    m.t0.resize(room);
    m.dt.resize(room);
  }
  for (const Region& r : m.regions)
    lay_even_segments(r.t.lo, r.t.length() / r.count, r.count, m.t0.data() + r.first, m.dt.data() + r.first);
}

// The blocks of segments [first, end).
void lay_blocks(const CompiledScene& world, std::uint32_t first, std::uint32_t end, March& m) {
  for (const Stretch& s : m.stretches) {
    if (s.region_count == 0) continue;
    const Region& last_region = m.regions[s.first_region + s.region_count - 1];
    const std::uint32_t from = std::max(first, m.regions[s.first_region].first),
                        to = std::min(end, last_region.first + last_region.count);
    if (from >= to) continue;
    Block block;
    block.volume = s.volume;
    block.first = from;
    block.count = to - from;
    block.row_length = world.media[world.volumes[s.volume].medium].homogeneous ? 1 : block.count;
    m.blocks.push_back(block);
  }
}

// The new blocks of rays that go on, those of one medium next to each other: one batch each, whose rows they
// share. Makes room for the batches' outputs behind those of earlier rounds.
void lay_batches(const CompiledScene& world, std::span<const MarchRequest> requests,
                 std::span<const std::uint32_t> going, Worker& worker) {
  std::vector<MarchBatchEntry>& entries = worker.march_batch;
  entries.clear();
  for (const std::uint32_t r : going) {
    const March& m = *requests[r].out;
    for (std::uint32_t b = m.progress.blocks; b < m.blocks.size(); ++b)
      entries.push_back({world.volumes[m.blocks[b].volume].medium, r, b});
  }
  std::sort(entries.begin(), entries.end());
  std::size_t& floats = worker.march_floats;
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
  if (worker.march_pool.size() < floats) worker.march_pool.resize(floats);
}

// Where media are evaluated: somewhere in each segment, or at its start.
enum class Places { in_segments, at_starts };

// Runs one medium's program over the segments of all rays in it.
void evaluate_batch(const CompiledScene& world, std::span<const MarchRequest> requests,
                    std::span<const MarchBatchEntry> entries, Places places, Worker& worker) {
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
  std::size_t lane = 0;
  for (const MarchBatchEntry& e : entries) {
    const MarchRequest& request = requests[e.request];
    const March& m = *request.out;
    const Block& b = m.blocks[e.block];
    const double* const t0 = m.t0.data() + b.first;
    const compile::CompiledVolume& volume = world.volumes[b.volume];
    if (world.media[medium].homogeneous)
      lanes.set_time(lane, m.ray.time);
    else if (places == Places::at_starts)
      lanes.set(volume, m.ray, lane, PlacedSamples{t0, b.row_length});
    else
      lanes.set(volume, m.ray, lane,
                SegmentSamples{t0, m.dt.data() + b.first, request.seed, b.first, b.row_length});
    lane += b.row_length;
  }
  worker.outputs.clear();
  for (std::size_t k = 0; k < program.outputs.size(); ++k) worker.outputs.push_back(rows + k * count);
  lanes.run(count, worker.outputs);
  limit_outputs(world, medium, worker.outputs, count, worker);
}

// Runs the programs over the new blocks: one batch a medium.
void evaluate(const CompiledScene& world, std::span<const MarchRequest> requests,
              std::span<const std::uint32_t> going, Places places, Worker& worker) {
  lay_batches(world, requests, going, worker);
  const std::span<const MarchBatchEntry> entries = worker.march_batch;
  for (std::size_t first = 0; first < entries.size();) {
    std::size_t last = first;
    while (last < entries.size() && entries[last].medium == entries[first].medium) ++last;
    evaluate_batch(world, requests, entries.subspan(first, last - first), places, worker);
    first = last;
  }
}

// Adds one output of a block to a row of segments.
void add_output(const float* pool, const Block& b, std::size_t output, std::vector<float>& row) {
  const float* from = pool + b.rows + output * b.pitch;
  float* to = row.data() + b.first;
  if (b.row_length == 1)
    for (std::uint32_t k = 0; k < b.count; ++k) to[k] += from[0];
  else
    for (std::uint32_t k = 0; k < b.count; ++k) to[k] += from[k];
}

// Of the new blocks, which hold segments from m.count up to `end`. Coefficients add where volumes overlap.
void add_coefficients(const CompiledScene& world, const float* pool, std::uint32_t end, March& m) {
  const bool emission = world.features.medium_emission;
  const auto extend = [&](std::vector<float>& row) {
    if (row.size() < end + widest_lanes) row.resize(end + widest_lanes);
    std::fill(row.begin() + m.count, row.begin() + end, 0.0f);
  };
  for (int c = 0; c < m.channels; ++c) {
    extend(m.sigma_s[c]);
    if (emission) extend(m.emission[c]);
  }
  for (int c = 0; c < m.extinction_channels; ++c) extend(m.sigma_t[c]);
  for (; m.progress.blocks < m.blocks.size(); ++m.progress.blocks) {
    const Block& b = m.blocks[m.progress.blocks];
    const scene::Medium& medium = world.scene.media[world.volumes[b.volume].medium];
    for (int c = 0; c < m.channels; ++c) {
      add_output(pool, b, medium.sigma_s[c], m.sigma_s[c]);
      if (medium.emission) add_output(pool, b, (*medium.emission)[c], m.emission[c]);
    }
    for (int c = 0; c < m.extinction_channels; ++c) add_output(pool, b, medium.sigma_t[c], m.sigma_t[c]);
  }
}

// To be evaluated from the start.
std::vector<std::uint32_t>& all_of(std::span<const MarchRequest> requests, Worker& worker) {
  worker.march_floats = 0;
  worker.marches_going.resize(requests.size());
  std::iota(worker.marches_going.begin(), worker.marches_going.end(), 0u);
  return worker.marches_going;
}

void begin_march(const CompiledScene& world, const MarchRequest& request, Worker& worker) {
  March& m = *request.out;
  m.ray = request.ray;
  m.channels = world.features.chromatic ? 3 : 1;
  m.extinction_channels = world.features.chromatic_extinction ? 3 : 1;
  m.stretches.clear();
  m.blocks.clear();
  m.progress.blocks = 0;
  if (world.features.volumes) find_stretches(world, m.ray, request.kind, worker, m.stretches);
  m.progress.before_dark = segments_before_dark(world, m.stretches);
  lay_segments(world, worker, m);
  begin_sums(m);
}

// What scatters of the part that was marched.
void note_scattering_stretches(March& m) {
  m.scattering_stretches.clear();
  for (const Region& r : m.regions) {
    if (r.first >= m.count) break;
    if (!r.scatters) continue;
    const double end = r.first + r.count > m.count ? m.t0[m.count] : r.t.hi;
    if (!m.scattering_stretches.empty() && m.scattering_stretches.back().hi == r.t.lo)
      m.scattering_stretches.back().hi = end;
    else
      m.scattering_stretches.push_back({r.t.lo, end});
  }
}

}  // namespace

void march(const CompiledScene& world, std::span<const MarchRequest> requests, Worker& worker) {
  for (const MarchRequest& request : requests) begin_march(world, request, worker);
  std::vector<std::uint32_t>& going = all_of(requests, worker);
  for (std::uint32_t round = 0; !going.empty(); ++round) {
    for (const std::uint32_t i : going) {
      March& m = *requests[i].out;
      m.progress.round_end = requests[i].may_end_dark
                                 ? segments_until(m.progress.before_dark, round, m.progress.laid)
                                 : m.progress.laid;
      lay_blocks(world, m.count, m.progress.round_end, m);
    }
    evaluate(world, requests, going, Places::in_segments, worker);
    std::erase_if(going, [&](std::uint32_t i) {
      March& m = *requests[i].out;
      add_coefficients(world, worker.march_pool.data(), m.progress.round_end, m);
      add_segments(world, m.progress.round_end, worker, m);
      return m.count == m.progress.laid || !goes_on_in_the_dark(requests[i].seed, round, m);
    });
  }
  for (const MarchRequest& request : requests) {
    March& m = *request.out;
    m.pool = worker.march_pool.data();
    finish_sums(m);
    note_scattering_stretches(m);
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
    m.count = 0;
    m.dt.assign(m.t0.size(), 0.0);
    m.blocks.clear();
    m.progress.blocks = 0;
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
  evaluate(world, requests, all_of(requests, worker), Places::at_starts, worker);
  for (const MarchRequest& request : requests) {
    March& m = *request.out;
    const auto count = static_cast<std::uint32_t>(m.t0.size());
    m.pool = worker.march_pool.data();
    add_coefficients(world, m.pool, count, m);
    m.count = count;
    worker.statistics.segments += count;
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
