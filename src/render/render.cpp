#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>

#include "base/check.h"
#include "base/parallel.h"
#include "render/path.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;
using Clock = std::chrono::steady_clock;

constexpr int tile_size = 16;

struct Tile {
  int x0, y0, x1, y1;
};

std::vector<Tile> tiles_of(const RenderOptions::Crop& crop) {
  std::vector<Tile> tiles;
  for (int y = crop.y0; y < crop.y1; y += tile_size)
    for (int x = crop.x0; x < crop.x1; x += tile_size)
      tiles.push_back({x, y, std::min(x + tile_size, crop.x1), std::min(y + tile_size, crop.y1)});
  return tiles;
}

// Samples of the pass that starts at `done`: 1, 1, 2, 4, 8, then 16 each, so that a stopped render is whole
// to within a pass.
int pass_length(int done, int rest) { return std::min({done == 0 ? 1 : done, 16, rest}); }

// Adds what a worker counted.
void sum_into(Statistics& total, const Worker& worker) {
  const Statistics& s = worker.statistics;
  total.samples += s.samples;
  total.rays += s.rays;
  total.shadow_rays += s.shadow_rays;
  total.marches += s.marches;
  total.segments += s.segments;
  total.widened_marches += s.widened_marches;
  total.cut_paths += s.cut_paths;
  total.cut_throughput += s.cut_throughput;
  total.bad_samples += s.bad_samples;
  total.vm_runs += worker.machine.counters().runs;
  total.lanes_issued += worker.machine.counters().lanes_issued;
  total.lanes_used += worker.machine.counters().lanes_used;
  total.vm_instructions += worker.machine.counters().instructions;
  const auto& bad = s.first_bad_sample;
  if (bad && (!total.first_bad_sample || *bad < *total.first_bad_sample)) total.first_bad_sample = bad;
}

// One render's shared state.
class Render {
 public:
  Render(const CompiledScene& world, const RenderOptions& options)
      : world_(world),
        options_(options),
        settings_(path_settings(world, options)),
        camera_(world),
        film_(world.scene.settings.width, world.scene.settings.height) {
    for (int i = 0; i < worker_count(options.threads); ++i) workers_.push_back(std::make_unique<Worker>());
  }

  RenderResult run(const Progress& progress) {
    const RenderOptions::Crop crop =
        options_.crop.value_or(RenderOptions::Crop{0, 0, film_.width(), film_.height()});
    CHECK_LE(0, crop.x0);
    CHECK_LE(0, crop.y0);
    CHECK_LE(crop.x1, film_.width());
    CHECK_LE(crop.y1, film_.height());
    const std::vector<Tile> tiles = tiles_of(crop);
    const int count = options_.sample_count.value_or(world_.scene.settings.samples);
    const std::uint64_t total =
        std::uint64_t(std::max(0, crop.x1 - crop.x0)) * std::uint64_t(std::max(0, crop.y1 - crop.y0)) * count;

    for (int done = 0; done < count && !stopped();) {
      const int length = pass_length(done, count - done);
      parallel_for(tiles.size(), options_.threads, [&](std::size_t i, int worker) {
        if (stopped()) return;
        render_tile(tiles[i], options_.first_sample + done, length, *workers_[worker]);
        const std::uint64_t tile_samples =
            std::uint64_t(tiles[i].x1 - tiles[i].x0) * std::uint64_t(tiles[i].y1 - tiles[i].y0) * length;
        report(progress, samples_done_.fetch_add(tile_samples) + tile_samples, total);
      });
      done += length;
    }
    return finish();
  }

 private:
  bool stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

  void render_tile(const Tile& tile, int first_sample, int length, Worker& worker) {
    std::vector<CameraSample>& samples = worker.tile_samples;
    samples.clear();
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        for (int s = first_sample; s < first_sample + length; ++s)
          samples.push_back({x, y, static_cast<std::uint64_t>(s)});
    worker.tile_radiance.resize(samples.size());
    trace_paths(world_, camera_, settings_, samples, worker, worker.tile_radiance);
    for (std::size_t i = 0; i < samples.size(); ++i) add(samples[i], worker.tile_radiance[i], worker);
  }

  void add(const CameraSample& s, const Rgb& radiance, Worker& worker) {
    if (all_finite(radiance)) {
      film_.add(s.x, s.y, radiance);
      return;
    }
    film_.add(s.x, s.y, {});
    ++worker.statistics.bad_samples;
    const Statistics::BadSample bad{s.sample, s.y, s.x};
    auto& first = worker.statistics.first_bad_sample;
    if (!first || bad < *first) first = bad;
  }

  void report(const Progress& progress, std::uint64_t done, std::uint64_t total) {
    if (!progress.report) return;
    const std::unique_lock lock(report_mutex_, std::try_to_lock);
    if (!lock) return;
    const Clock::time_point now = Clock::now();
    if (now - last_report_ < std::chrono::milliseconds(200)) return;
    last_report_ = now;
    progress.report(static_cast<double>(done) / static_cast<double>(total),
                    static_cast<double>(done) / seconds());
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  RenderResult finish() {
    Statistics total;
    BadValueCounts bad_values;
    for (const auto& worker : workers_) {
      sum_into(total, *worker);
      bad_values.add_all(worker->bad_values);
    }
    if (total.samples > 0) total.cut_throughput /= static_cast<double>(total.samples);
    total.bad_values = bad_values.list(world_.scene);
    total.seconds = seconds();
    total.stopped = stopped();
    return {std::move(film_), std::move(total)};
  }

  const CompiledScene& world_;
  const RenderOptions& options_;
  PathSettings settings_;
  CameraRays camera_;
  Film film_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::atomic<std::uint64_t> samples_done_{0};
  std::mutex report_mutex_;
  Clock::time_point start_ = Clock::now(), last_report_ = start_;
};

}  // namespace

RenderResult render(const CompiledScene& world, const RenderOptions& options, const Progress& progress) {
  return Render(world, options).run(progress);
}

Replay replay(const CompiledScene& world, const RenderOptions& options, int x, int y, std::uint64_t sample) {
  const CameraRays camera(world);
  Worker worker;
  Replay out;
  const CameraSample camera_sample{x, y, sample};
  trace_paths(world, camera, path_settings(world, options), std::span(&camera_sample, 1), worker,
              std::span(&out.radiance, 1), &out.trace);
  return out;
}

}  // namespace tyndall::render
