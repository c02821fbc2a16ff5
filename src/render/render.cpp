#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <set>

#include "base/check.h"
#include "base/parallel.h"
#include "render/adaptive.h"
#include "render/deadline.h"
#include "render/path.h"
#include "render/worker.h"

namespace tyndall::render {

namespace {

using compile::CompiledScene;
using Clock = Deadline::Clock;

constexpr int tile_size = 16;

std::vector<Tile> tiles_of(const PixelWindow& crop) {
  std::vector<Tile> tiles;
  for (int y = crop.y0; y < crop.y1; y += tile_size)
    for (int x = crop.x0; x < crop.x1; x += tile_size)
      tiles.push_back({x, y, std::min(x + tile_size, crop.x1), std::min(y + tile_size, crop.y1)});
  return tiles;
}

// Samples of the pass that starts at `done`: 1, 1, 2, 4, 8, then 16 each, so that a stopped render is whole
// to within a pass.
int pass_length(int done, int rest) { return std::min({done == 0 ? 1 : done, 16, rest}); }

// Adds what a worker's machine ran of each shader.
void sum_lanes(Statistics& total, const Worker& worker, const scene::Scene& scene) {
  total.medium_lanes.resize(2 * scene.media.size());
  total.material_lanes.resize(scene.materials.size());
  std::set<std::uint64_t> seen;
  const auto add = [&](std::vector<std::uint64_t>& sum, const vm::Program& program) {
    sum.resize(program.lane_code.size());
    if (!seen.insert(program.fingerprint).second) return;
    const std::vector<std::uint64_t> lanes = worker.machine.lanes_run(program);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += lanes[i];
  };
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    add(total.medium_lanes[2 * i], scene.media[i].full);
    add(total.medium_lanes[2 * i + 1], scene.media[i].extinction);
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    add(total.material_lanes[i], scene.materials[i].program);
}

// Adds what a worker counted.
void sum_into(Statistics& total, const Worker& worker) {
  const Statistics& s = worker.statistics;
  total.samples += s.samples;
  total.rays += s.rays;
  total.shadow_rays += s.shadow_rays;
  total.marches += s.marches;
  total.segments += s.segments;
  total.cut_majorants += s.cut_majorants;
  total.widened_steps.add_all(s.widened_steps);
  total.missed_tolerances.add_all(s.missed_tolerances);
  total.cut_paths += s.cut_paths;
  total.cut_throughput += s.cut_throughput;
  total.bad_samples += s.bad_samples;
  total.clipped_samples += s.clipped_samples;
  total.light += s.light;
  total.lost_light += s.lost_light;
  total.vm_runs += worker.machine.counters().runs;
  total.lanes_issued += worker.machine.counters().lanes_issued;
  total.lanes_used += worker.machine.counters().lanes_used;
  total.vm_instructions += worker.machine.counters().instructions;
  const auto& bad = s.first_bad_sample;
  if (bad && (!total.first_bad_sample || *bad < *total.first_bad_sample)) total.first_bad_sample = bad;
}

// Indices of refraction are found out when the scene is compiled.
void note_bad_iors(const CompiledScene& world, BadValueCounts& counts) {
  for (std::uint32_t i = 0; i < world.materials.size(); ++i)
    if (const auto ior = world.materials[i].bad_ior)
      counts.add_material(i, *world.scene.materials[i].ior,
                          std::isnan(*ior) ? BadValue::Kind::undefined
                          : *ior < 1       ? BadValue::Kind::below
                                           : BadValue::Kind::above);
}

// What the film's range loses of a sample.
void note_film_range(const Rgb& radiance, Statistics& statistics) {
  const Vec3d light(radiance);
  statistics.light += std::abs(light.x) + std::abs(light.y) + std::abs(light.z);
  const double most = std::max({std::abs(light.x), std::abs(light.y), std::abs(light.z)});
  if (most <= FixedSum::largest_addend && (most == 0 || most >= FixedSum::fine_addend)) return;
  statistics.clipped_samples += most > FixedSum::largest_addend;
  for (std::size_t c = 0; c < 3; ++c) {
    FixedSum kept;
    kept.add(light[c]);
    statistics.lost_light += std::abs(light[c] - kept.value());
  }
}

// Most samples a pixel when only an error or a time says when to end.
constexpr int most_samples_for_a_goal = 1 << 16;

int most_samples(const CompiledScene& world, const RenderOptions& options) {
  if (options.sample_count) return *options.sample_count;
  return options.error || options.time_limit ? most_samples_for_a_goal : world.scene.settings.samples;
}

// One render's shared state.
class Render {
 public:
  Render(const CompiledScene& world, const RenderOptions& options, const Progress& progress)
      : world_(world),
        options_(options),
        progress_(progress),
        settings_(path_settings(world, options)),
        camera_(world),
        film_(world.scene.settings.width, world.scene.settings.height, settings_.groups, options.aovs,
              options.crop),
        tiles_(tiles_of(film_.window())),
        most_samples_(most_samples(world, options)) {
    deadline_.stop = options.stop;
    // A limit that the clock cannot hold is none.
    constexpr double longest = 1e9;
    if (options.time_limit && *options.time_limit < longest)
      deadline_.end = start_ + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(*options.time_limit));
    for (int i = 0; i < loop_workers(tiles_.size(), options.threads); ++i) {
      workers_.push_back(std::make_unique<Worker>());
      workers_.back()->skips_empty = options.skip_empty;
      workers_.back()->machine.observe(options.shader_observer);
    }
    for (const Tile& tile : tiles_) {
      pixels_ += static_cast<std::uint64_t>(tile.pixels());
    }
  }

  RenderResult run() {
    if (options_.error)
      run_adaptive();
    else
      run_uniform();
    Statistics total = statistics();  // which looks at the film
    return {std::move(film_), std::move(total)};
  }

 private:
  bool stopped() const { return deadline_.stopped(); }

  // Passes over the whole picture, the same samples for every pixel.
  void run_uniform() {
    fraction_scale_ = 1 / (static_cast<double>(pixels_) * most_samples_);
    for (int done = 0; done < most_samples_ && !stopped();) {
      const int length = affordable(pass_length(done, most_samples_ - done));
      if (length == 0) break;
      const auto first = static_cast<std::uint64_t>(options_.first_sample + done);
      render_pass([&](std::size_t i, std::vector<CameraSample>& samples) {
        add_samples(tiles_[i], samples, length, [&](int k) { return first + static_cast<std::uint64_t>(k); });
      });
      if (uneven_) break;
      done += length;
      if (done < most_samples_) end_pass();
    }
  }

  // As many samples as a pass can take within the time limit, judged by the passes before; at least one in
  // all.
  int affordable(int length) {
    const std::uint64_t done = samples_done_.load();
    if (!options_.time_limit || done == 0) return length;
    const double left = *options_.time_limit - seconds();
    const double one = seconds() / static_cast<double>(done) * static_cast<double>(pixels_);
    const int affordable = static_cast<int>(std::clamp(left / one, 0.0, static_cast<double>(length)));
    out_of_time_ = affordable < length;
    return affordable;
  }

  // Passes in which each half of each tile takes as many samples as the plan says.
  void run_adaptive() {
    AdaptivePlan plan(tiles_.size(), *options_.error, most_samples_);
    while (!plan.done() && !stopped()) {
      out_of_time_ = options_.time_limit && seconds() >= *options_.time_limit;
      if (out_of_time_) break;
      render_pass([&](std::size_t i, std::vector<CameraSample>& samples) {
        for (int half = 0; half < 2; ++half) {
          const SampleRun run = plan.run(i, half);
          add_samples(tiles_[i], samples, run.count,
                      [&](int k) { return sample_of_half(half, run.first + k); });
        }
      });
      if (uneven_) break;
      plan.finish_pass(film_, tiles_);
      estimated_error_ = plan.estimated_error();
      outlier_share_ = plan.outlier_share();
      fraction_scale_ = plan.fraction_done() / static_cast<double>(samples_done_.load());
      if (!plan.done()) end_pass();
    }
  }

  template <class SampleNumber>
  static void add_samples(const Tile& tile, std::vector<CameraSample>& samples, int count,
                          SampleNumber&& number) {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        for (int k = 0; k < count; ++k) samples.push_back({x, y, number(k)});
  }

  // Renders what list(tile, samples) asks for.
  template <class List>
  void render_pass(List&& list) {
    const int threads = parallel_for(tiles_.size(), options_.threads, [&](std::size_t i, int w) {
      Worker& worker = *workers_[w];
      worker.tile_samples.clear();
      list(i, worker.tile_samples);
      if (worker.tile_samples.empty()) return;
      if (deadline_.passed() || !render_samples(worker))
        uneven_ = true;
      else
        report(samples_done_.fetch_add(worker.tile_samples.size()) + worker.tile_samples.size());
    });
    threads_ = std::max(threads_, threads);
    threads_missed_ = std::max(threads_missed_, loop_workers(tiles_.size(), options_.threads) - threads);
    out_of_time_ |= uneven_ && !stopped();
  }

  // False when the deadline passed before all paths ended: none of them is counted.
  bool render_samples(Worker& worker) {
    const std::vector<CameraSample>& samples = worker.tile_samples;
    const std::uint64_t samples_before = worker.statistics.samples;
    worker.tile_radiance.resize(samples.size());
    worker.tile_aovs.resize(options_.aovs.recorded() ? samples.size() : 0);
    if (!trace_paths(world_, camera_, settings_, samples, worker,
                     {worker.tile_radiance, worker.tile_aovs, nullptr, &deadline_})) {
      worker.statistics.samples = samples_before;
      return false;
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
      add(samples[i], worker.tile_radiance[i], worker);
      if (!worker.tile_aovs.empty()) film_.add(samples[i].x, samples[i].y, worker.tile_aovs[i]);
    }
    return true;
  }

  void add(const CameraSample& s, const Rgb& radiance, Worker& worker) {
    const int group = static_cast<int>(s.sample % static_cast<std::uint64_t>(settings_.groups));
    if (all_finite(radiance)) {
      film_.add(s.x, s.y, radiance, group);
      note_film_range(radiance, worker.statistics);
      return;
    }
    film_.add(s.x, s.y, Rgb{}, group);
    ++worker.statistics.bad_samples;
    const Statistics::BadSample bad{s.sample, s.y, s.x};
    auto& first = worker.statistics.first_bad_sample;
    if (!first || bad < *first) first = bad;
  }

  void end_pass() {
    if (progress_.pass && !stopped()) progress_.pass(film_, statistics());
  }

  void report(std::uint64_t done) {
    if (!progress_.report) return;
    const std::unique_lock lock(report_mutex_, std::try_to_lock);
    if (!lock) return;
    const Clock::time_point now = Clock::now();
    if (now - last_report_ < std::chrono::milliseconds(200)) return;
    last_report_ = now;
    double fraction = static_cast<double>(done) * fraction_scale_;
    if (options_.time_limit) fraction = std::max(fraction, seconds() / *options_.time_limit);
    progress_.report(std::min(fraction, 1.0), static_cast<double>(done) / seconds());
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Statistics statistics() const {
    Statistics total;
    BadValueCounts bad_values;
    for (const auto& worker : workers_) {
      sum_into(total, *worker);
      sum_lanes(total, *worker, world_.scene);
      bad_values.add_all(worker->bad_values);
    }
    if (total.samples > 0) total.cut_throughput /= static_cast<double>(total.samples);
    note_bad_iors(world_, bad_values);
    total.bad_values = bad_values.list(world_.scene);
    for (const compile::CoarseField& field : world_.coarse_fields)
      total.bad_values.push_back(
          {BadValue::Kind::coarse, field.span, field.shader, 0, field.name, 0, double{field.reach}});
    total.seconds = seconds();
    total.stopped = stopped();
    total.out_of_time = out_of_time_;
    total.uneven = uneven_;
    if (uneven_ || total.samples < pixels_) total.pixels_without_samples = film_.pixels_without_samples();
    total.threads = threads_;
    total.threads_missed = threads_missed_;
    total.estimated_error = estimated_error_;
    total.outlier_share = outlier_share_;
    return total;
  }

  const CompiledScene& world_;
  const RenderOptions& options_;
  const Progress& progress_;
  PathSettings settings_;
  CameraRays camera_;
  Film film_;
  std::vector<Tile> tiles_;
  int most_samples_;
  std::uint64_t pixels_ = 0;  // of the tiles
  std::vector<std::unique_ptr<Worker>> workers_;
  std::atomic<std::uint64_t> samples_done_{0};
  double fraction_scale_ = 0;  // of the work, per sample
  double estimated_error_ = 0, outlier_share_ = 0;
  bool out_of_time_ = false;
  std::atomic<bool> uneven_{false};
  int threads_ = 0, threads_missed_ = 0;  // most of a pass
  std::mutex report_mutex_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_report_ = start_;
  Deadline deadline_;
};

}  // namespace

RenderResult render(const CompiledScene& world, const RenderOptions& options, const Progress& progress) {
  return Render(world, options, progress).run();
}

Replay replay(const CompiledScene& world, const RenderOptions& options, int x, int y, std::uint64_t sample) {
  const CameraRays camera(world);
  Worker worker;
  worker.skips_empty = options.skip_empty;
  Replay out;
  const CameraSample camera_sample{x, y, sample};
  PathOutputs outputs{std::span(&out.radiance, 1)};
  outputs.trace = &out.trace;
  const bool whole = trace_paths(world, camera, path_settings(world, options), std::span(&camera_sample, 1),
                                 worker, outputs);
  CHECK(whole);
  return out;
}

}  // namespace tyndall::render
