#include "render/march/ray_march.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/march/segment_limit.h"
#include "render/march/transmittance_roulette.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;

// The intervals that are active between two edges next to each other, one pair after another.
class ActiveIntervals {
 public:
  // Keeps both; the intervals are in order of t0.
  ActiveIntervals(std::span<const MarchedInterval> all, std::vector<std::uint32_t>& active)
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
  std::span<const MarchedInterval> all_;
  std::vector<std::uint32_t>& active_;
  std::uint32_t next_ = 0;
};

// The ends of intervals and the crossings, in order.
void find_edges(const March& m, std::vector<double>& edges) {
  edges.clear();
  for (const MarchedInterval& s : m.marched) edges.insert(edges.end(), {s.t0, s.t1});
  if (!edges.empty())
    for (const MarchCrossing& c : m.crossings) edges.push_back(c.t);
  if (edges.size() > 2) {
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }
}

// The blocks of segments [first, end).
void lay_blocks(const CompiledScene& world, std::uint32_t first, std::uint32_t end, March& m) {
  for (const MarchedInterval& s : m.marched) {
    if (s.region_count == 0) continue;
    const Region& last_region = m.regions[s.first_region + s.region_count - 1];
    const std::uint32_t from = std::max(first, m.regions[s.first_region].first),
                        to = std::min(end, last_region.first + last_region.count);
    if (from >= to) continue;
    Block block;
    block.volume = s.volume;
    block.first = from;
    block.count = to - from;
    block.row_length = world.media[world.volumes[s.volume].medium].uniform ? 1 : block.count;
    m.blocks.push_back(block);
  }
}

// Adds one output of a block to a row of segments.
void add_output(const float* outputs, const Block& b, std::size_t output, std::vector<float>& row) {
  const float* from = outputs + b.rows + output * b.pitch;
  float* to = row.data() + b.first;
  if (b.row_length == 1)
    for (std::uint32_t k = 0; k < b.count; ++k) to[k] += from[0];
  else
    for (std::uint32_t k = 0; k < b.count; ++k) to[k] += from[k];
}

// Of the new blocks, which hold segments from m.count up to `end`. Coefficients add where volumes overlap.
void add_coefficients(const CompiledScene& world, const float* outputs, std::uint32_t end, March& m) {
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
    const compile::CompiledMedium& medium = world.media[world.volumes[b.volume].medium];
    for (int c = 0; c < m.channels; ++c) {
      add_output(outputs, b, medium.sigma_s[c], m.sigma_s[c]);
      if (medium.emission) add_output(outputs, b, (*medium.emission)[c], m.emission[c]);
    }
    for (int c = 0; c < m.extinction_channels; ++c) add_output(outputs, b, medium.sigma_t[c], m.sigma_t[c]);
  }
}

// What scatters of the part that was marched.
void note_scattering_intervals(March& m) {
  m.scattering_intervals.clear();
  for (const Region& r : m.regions) {
    if (r.first >= m.count) break;
    if (!r.scatters) continue;
    const double end = r.first + r.count > m.count ? m.t0[m.count] : r.t.hi;
    if (!m.scattering_intervals.empty() && m.scattering_intervals.back().hi == r.t.lo)
      m.scattering_intervals.back().hi = end;
    else
      m.scattering_intervals.push_back({r.t.lo, end});
  }
}

// The blocks of a march whose segments are points: of every volume, those that lie in it.
void lay_points(const CompiledScene& world, March& m) {
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
    block.row_length = world.media[world.volumes[i.volume].medium].uniform ? 1 : block.count;
    m.blocks.push_back(block);
  }
}

}  // namespace

// Shares out the limit over regions that want more in all.
void RayMarcher::limit_segments(const CompiledScene& world, double wanted, March& m, Statistics& statistics) {
  SegmentAllotment allotment(wanted, m.regions.size());
  SegmentShortage shortage(world);
  ActiveIntervals marched(m.marched, active_);
  for (Region& region : m.regions) {
    double step = infinity;
    shortage.begin_part();
    for (const std::uint32_t i : marched.between(region.t)) {
      step = std::min(step, m.marched[i].step);
      shortage.add(m.marched[i]);
    }
    region.count = allotment.next(wanted_segments(region.t.length(), step));
    shortage.end_part(region.t.length(), region.count);
  }
  shortage.count_in(statistics);
}

// Cuts the ray at every edge, and lays segments into the regions between, where some volume is.
void RayMarcher::lay_segments(const CompiledScene& world, March& m, Statistics& statistics) {
  m.regions.clear();
  const std::vector<double>& edges = edges_;
  find_edges(m, edges_);
  double wanted = 0;  // segments, before the limit
  ActiveIntervals marched(m.marched, active_);
  for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
    Region region{{edges[e], edges[e + 1]}, 0, 0, false};
    const std::span<const std::uint32_t> active = marched.between(region.t);
    if (active.empty()) continue;
    double step = infinity;
    for (const std::uint32_t i : active) {
      MarchedInterval& s = m.marched[i];
      if (s.region_count++ == 0) s.first_region = static_cast<std::uint32_t>(m.regions.size());
      region.scatters |= world.media[world.volumes[s.volume].medium].scatters();
      step = std::min(step, s.step);
    }
    const double segments = wanted_segments(region.t.length(), step);
    region.count = static_cast<std::uint32_t>(std::min<double>(segments, max_segments));
    wanted += segments;
    m.regions.push_back(region);
  }
  if (wanted > max_segments) limit_segments(world, wanted, m, statistics);

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
    lay_uniform_segments(r.t.lo, r.t.length() / r.count, r.count, m.t0.data() + r.first,
                         m.dt.data() + r.first);
}

// The new blocks of rays that go on, those of one medium next to each other: one batch each, whose rows they
// share. Makes room for the batches' outputs behind those of earlier rounds.
void RayMarcher::lay_batches(const CompiledScene& world, std::span<const MarchRequest> requests) {
  std::vector<BatchEntry>& entries = entries_;
  entries.clear();
  for (const std::uint32_t r : going_) {
    const March& m = *requests[r].out;
    for (std::uint32_t b = m.progress.blocks; b < m.blocks.size(); ++b)
      entries.push_back({world.volumes[m.blocks[b].volume].medium, r, b});
  }
  std::sort(entries.begin(), entries.end());
  for (auto first = entries.begin(); first != entries.end();) {
    std::size_t lanes = 0;
    auto last = first;
    for (; last != entries.end() && last->medium == first->medium; ++last) {
      Block& block = requests[last->request].out->blocks[last->block];
      block.rows = floats_ + lanes;
      lanes += block.row_length;
    }
    for (; first != last; ++first) requests[first->request].out->blocks[first->block].pitch = lanes;
    floats_ += lanes * world.media[std::prev(last)->medium].full.outputs.size();
  }
  if (outputs_->size() < floats_) outputs_->resize(floats_);
}

// Runs one medium's program over the segments of all rays in it.
void RayMarcher::evaluate_batch(const CompiledScene& world, std::span<const MarchRequest> requests,
                                std::span<const BatchEntry> entries, Places places, ThreadContext& thread) {
  const std::uint32_t medium = entries.front().medium;
  const vm::Program& program = world.media[medium].full;
  const Block& front = requests[entries.front().request].out->blocks[entries.front().block];
  float* const rows = outputs_->data() + front.rows;
  const std::size_t count = front.pitch;
  if (world.media[medium].constant) {
    for (std::size_t k = 0; k < program.outputs.size(); ++k)
      std::fill_n(rows + k * count, count, program.constants[program.outputs[k]]);
    return;
  }
  batch_.begin(world, medium, MediumProgram::full, count);
  for (const BatchEntry& e : entries) {
    const MarchRequest& request = requests[e.request];
    const March& m = *request.out;
    const Block& b = m.blocks[e.block];
    const double* const t0 = m.t0.data() + b.first;
    const compile::CompiledVolume& volume = world.volumes[b.volume];
    if (world.media[medium].uniform)
      batch_.add_at_time(m.ray.time, b.row_length);
    else if (places == Places::at_starts)
      batch_.add(volume, m.ray, PlacedSamples{t0, b.row_length});
    else
      batch_.add(volume, m.ray,
                 SegmentSamples{t0, m.dt.data() + b.first, request.seed, b.first, b.row_length,
                                !world.features.proven_steps});
  }
  batch_.run(rows, thread);
}

// Runs the programs over the new blocks: one batch a medium.
void RayMarcher::evaluate(const CompiledScene& world, std::span<const MarchRequest> requests, Places places,
                          ThreadContext& thread) {
  lay_batches(world, requests);
  const std::span<const BatchEntry> entries = entries_;
  for (std::size_t first = 0; first < entries.size();) {
    std::size_t last = first;
    while (last < entries.size() && entries[last].medium == entries[first].medium) ++last;
    evaluate_batch(world, requests, entries.subspan(first, last - first), places, thread);
    first = last;
  }
}

// All requests are to be evaluated from the start.
void RayMarcher::start(std::span<const MarchRequest> requests) {
  for (const MarchRequest& request : requests) request.out->outputs.reset();
  if (!outputs_ || outputs_.use_count() > 1) outputs_ = std::make_shared<std::vector<float>>();
  floats_ = 0;
  going_.resize(requests.size());
  std::iota(going_.begin(), going_.end(), 0u);
}

void RayMarcher::begin_march(const CompiledScene& world, const MarchRequest& request, ThreadContext& thread) {
  March& m = *request.out;
  m.ray = request.ray;
  m.channels = world.features.chromatic ? 3 : 1;
  m.extinction_channels = world.features.chromatic_extinction ? 3 : 1;
  m.marched.clear();
  m.blocks.clear();
  m.progress.blocks = 0;
  if (world.features.volumes) intervals_.find(world, m.ray, request.kind, thread.skips_empty, m.marched);
  m.progress.before_roulette = segments_before_roulette(world, m.marched);
  lay_segments(world, m, thread.statistics);
  begin_sums(m);
}

void RayMarcher::march(const CompiledScene& world, std::span<const MarchRequest> requests,
                       ThreadContext& thread) {
  start(requests);
  for (const MarchRequest& request : requests) begin_march(world, request, thread);
  for (std::uint32_t round = 0; !going_.empty(); ++round) {
    for (const std::uint32_t i : going_) {
      March& m = *requests[i].out;
      m.progress.round_end = requests[i].may_end_by_roulette
                                 ? segments_until(m.progress.before_roulette, round, m.progress.laid)
                                 : m.progress.laid;
      lay_blocks(world, m.count, m.progress.round_end, m);
    }
    evaluate(world, requests, Places::in_segments, thread);
    std::erase_if(going_, [&](std::uint32_t i) {
      March& m = *requests[i].out;
      add_coefficients(world, outputs_->data(), m.progress.round_end, m);
      add_segments(world, m.progress.round_end, integrals_, m);
      return m.count == m.progress.laid || !survives_roulette(requests[i].seed, round, m);
    });
  }
  for (const MarchRequest& request : requests) {
    March& m = *request.out;
    m.outputs = outputs_;
    finish_sums(m);
    note_scattering_intervals(m);
    thread.statistics.marches += m.count > 0;
    thread.statistics.segments += m.count;
  }
}

void RayMarcher::evaluate_points(const CompiledScene& world, std::span<const MarchRequest> requests,
                                 ThreadContext& thread) {
  start(requests);
  for (const MarchRequest& request : requests) lay_points(world, *request.out);
  evaluate(world, requests, Places::at_starts, thread);
  for (const MarchRequest& request : requests) {
    March& m = *request.out;
    const auto count = static_cast<std::uint32_t>(m.t0.size());
    m.outputs = outputs_;
    add_coefficients(world, outputs_->data(), count, m);
    m.count = count;
    thread.statistics.segments += count;
  }
}

}  // namespace tyndall::render
