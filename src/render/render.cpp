#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "render/context/deadline.h"
#include "render/film/adaptive_sampling.h"
#include "render/path/path_settings.h"
#include "render/run_counts.h"
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

// Most samples per pixel when only an error or a time says when to end.
constexpr int most_samples_for_a_goal = 1 << 16;

int most_samples(const CompiledScene& world, const RenderOptions& options) {
  if (options.sample_count) return *options.sample_count;
  return options.error || options.time_limit ? most_samples_for_a_goal : world.scene.settings.samples;
}

// One render's shared state.
class Render {
 public:
  Render(const CompiledScene& world, const RenderOptions& options, const Progress& progress,
         std::optional<Unfinished> from)
      : world_(world),
        options_(options),
        progress_(progress),
        settings_(path_settings(world, options)),
        camera_(world),
        film_(from ? std::move(from->film)
                   : Film(world.scene.settings.resolution.width, world.scene.settings.resolution.height,
                          settings_.groups, options.aovs, options.crop)),
        tiles_(tiles_of(film_.window())),
        most_samples_(most_samples(world, options)) {
    if (from) {
      rest_ = std::move(from->rest);
      ByteReader in(rest_);
      CHECK(before_.restore(in, world));
      samples_done_ = before_.sums.samples;
    }
    deadline_.stop = options.stop;
    // A limit that the clock cannot hold is none.
    constexpr double longest = 1e9;
    if (options.time_limit && *options.time_limit < longest)
      deadline_.end = start_ + std::chrono::duration_cast<Clock::duration>(
                                   std::chrono::duration<double>(*options.time_limit - before_.sums.seconds));
    for (int i = 0; i < loop_workers(tiles_.size(), options.threads); ++i) {
      workers_.push_back(std::make_unique<Worker>(world, camera_, settings_));
      workers_.back()->thread.skips_empty = options.skip_empty;
      workers_.back()->thread.machine.observe(options.shader_observer);
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
    std::string rest = this->rest();
    return {std::move(film_), std::move(total), std::move(rest)};
  }

 private:
  bool stopped() const { return deadline_.stopped(); }

  // Passes over the whole picture, the same samples for every pixel.
  void run_uniform() {
    fraction_scale_ = 1 / (static_cast<double>(pixels_) * most_samples_);
    for (int done = samples_of_all(); done < most_samples_ && !stopped();) {
      const int length = affordable(pass_length(done, most_samples_ - done));
      if (length == 0) break;
      render_pass([&](std::size_t i, std::vector<CameraSample>& samples) {
        // A pass that was broken off has been through some tiles.
        const int taken = samples_of(tiles_[i]);
        const auto first =
            static_cast<std::uint64_t>(options_.first_sample) + static_cast<std::uint64_t>(taken);
        add_samples(tiles_[i], samples, done + length - taken,
                    [&](int k) { return first + static_cast<std::uint64_t>(k); });
      });
      if (uneven_) break;
      done += length;
      if (done < most_samples_) end_pass();
    }
  }

  // Samples of each pixel of a tile, and of each pixel at least.
  int samples_of(const Tile& tile) const { return static_cast<int>(film_.samples(tile.x0, tile.y0)); }
  int samples_of_all() const {
    int least = most_samples_;
    for (const Tile& tile : tiles_) least = std::min(least, samples_of(tile));
    return least;
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
    AdaptivePlan& plan = plan_.emplace(tiles_, *options_.error, most_samples_);
    restore_plan();
    while (!plan.done() && !stopped()) {
      out_of_time_ = options_.time_limit && seconds() >= *options_.time_limit;
      if (out_of_time_) break;
      render_pass([&](std::size_t i, std::vector<CameraSample>& samples) {
        // A pass that was broken off has been through some tiles.
        if (film_.samples(tiles_[i].x0, tiles_[i].y0) == plan.taken_after(i)) return;
        for (int half = 0; half < 2; ++half) {
          const SampleRun run = plan.run(i, half);
          add_samples(tiles_[i], samples, run.count,
                      [&](int k) { return sample_of_half(half, run.first + k); });
        }
      });
      if (uneven_) break;
      plan.finish_pass(film_, tiles_);
      fraction_scale_ = plan.fraction_done() / static_cast<double>(samples_done_.load());
      if (!plan.done()) end_pass();
    }
  }

  // What the passes of earlier runs decided.
  void restore_plan() {
    if (rest_.empty()) return;
    ByteReader in(rest_);
    RunCounts counts_before_it;
    CHECK(counts_before_it.restore(in, world_));
    CHECK(plan_->restore(in));
    fraction_scale_ =
        plan_->fraction_done() / static_cast<double>(std::max(samples_done_.load(), std::uint64_t{1}));
  }

  template <class SampleNumber>
  static void add_samples(const Tile& tile, std::vector<CameraSample>& samples, int count,
                          SampleNumber&& number) {
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        for (int k = 0; k < count; ++k) samples.push_back({x, y, number(k)});
  }

  // Renders what list(tile, samples) asks for; of a tile that has it nothing.
  template <class List>
  void render_pass(List&& list) {
    for (bool whole = false; !whole;) {
      std::atomic<bool> paused{false}, worked{false};
      const int threads = parallel_for(tiles_.size(), options_.threads, [&](std::size_t i, int w) {
        if (paused) return;
        Worker& worker = *workers_[w];
        worker.samples.clear();
        list(i, worker.samples);
        if (worker.samples.empty()) return;
        if (deadline_.passed())
          uneven_ = true;
        else if (worked && wants_pause())
          paused = true;
        else if (!render_samples(worker))
          uneven_ = true;
        else
          report(samples_done_.fetch_add(worker.samples.size()) + worker.samples.size());
        worked = true;  // or the next pause could come before anything is done
      });
      threads_ = std::max(threads_, threads);
      threads_missed_ = std::max(threads_missed_, loop_workers(tiles_.size(), options_.threads) - threads);
      whole = !paused || uneven_;
      if (!whole) pause();
    }
    out_of_time_ |= uneven_ && !stopped();
  }

  bool wants_pause() const { return progress_.wants_pause && progress_.wants_pause(seconds()); }
  // Within a pass, while no thread is at work.
  void pause() {
    uneven_ = true;
    end_pass();
    uneven_ = false;
  }

  // False when the deadline passed before all paths ended: none of them is counted.
  bool render_samples(Worker& worker) {
    const std::vector<CameraSample>& samples = worker.samples;
    const std::uint64_t samples_before = worker.thread.statistics.samples;
    worker.radiance.resize(samples.size());
    worker.aovs.resize(options_.aovs.recorded() ? samples.size() : 0);
    if (!worker.tracer.trace(samples, {worker.radiance, worker.aovs, nullptr, &deadline_}, worker.thread)) {
      worker.thread.statistics.samples = samples_before;
      return false;
    }
    for (std::size_t i = 0; i < samples.size(); ++i) {
      add(samples[i], worker.radiance[i], worker);
      if (!worker.aovs.empty())
        film_.add(samples[i].x, samples[i].y, worker.aovs[i], group_of(samples[i].sample));
    }
    return true;
  }

  int group_of(std::uint64_t sample) const {
    return static_cast<int>(sample % static_cast<std::uint64_t>(settings_.groups));
  }

  void add(const CameraSample& s, const Rgb& radiance, Worker& worker) {
    const int group = group_of(s.sample);
    if (all_finite(radiance)) {
      film_.add(s.x, s.y, radiance, group);
      note_film_range(radiance, worker.thread.statistics);
      return;
    }
    film_.add(s.x, s.y, Rgb{}, group);
    ++worker.thread.statistics.bad_samples;
    const Statistics::BadSample bad{s.sample, s.y, s.x};
    auto& first = worker.thread.statistics.first_bad_sample;
    if (!first || bad < *first) first = bad;
  }

  void end_pass() {
    if (progress_.pass && !stopped()) progress_.pass(film_, statistics(), rest());
  }

  // What an Unfinished has beside the film: what was counted, and what was decided of the samples to come.
  std::string rest() const {
    ByteWriter out;
    counts().save(out);
    if (plan_) plan_->save(out);
    return out.bytes();
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

  // Of all runs.
  double seconds() const {
    return before_.sums.seconds + std::chrono::duration<double>(Clock::now() - start_).count();
  }

  RunCounts counts() const {
    RunCounts all = before_;
    for (const auto& worker : workers_) all.add(worker->thread, world_);
    all.sums.seconds = seconds();
    return all;
  }

  Statistics statistics() const {
    Statistics total = counts().finished(world_);
    total.stopped = stopped();
    total.out_of_time = out_of_time_;
    total.uneven = uneven_;
    if (uneven_ || total.samples < pixels_) total.pixels_without_samples = film_.pixels_without_samples();
    total.threads = threads_;
    total.threads_missed = threads_missed_;
    if (plan_) {
      total.estimated_error = plan_->estimated_error();
      total.outlier_share = plan_->outlier_share();
    }
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
  std::optional<AdaptivePlan> plan_;
  RunCounts before_;  // of earlier runs
  std::string rest_;  // of the Unfinished that they left
  bool out_of_time_ = false;
  std::atomic<bool> uneven_{false};
  int threads_ = 0, threads_missed_ = 0;  // most of a pass
  std::mutex report_mutex_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point last_report_ = start_;
  Deadline deadline_;
};

}  // namespace

RenderResult render(const CompiledScene& world, const RenderOptions& options, const Progress& progress,
                    std::optional<Unfinished> from) {
  return Render(world, options, progress, std::move(from)).run();
}

bool fits(const CompiledScene& world, const RenderOptions& options, const Unfinished& from) {
  const auto [width, height] = world.scene.settings.resolution;
  const Film& film = from.film;
  const PixelWindow window = options.crop.value_or(PixelWindow{0, 0, width, height});
  if (film.width() != width || film.height() != height || film.window() != window ||
      film.groups() != sample_groups(options) || film.aovs().bits() != options.aovs.bits())
    return false;
  ByteReader in(from.rest);
  RunCounts counts;
  if (!counts.restore(in, world)) return false;
  if (options.error) {
    AdaptivePlan plan(tiles_of(window), *options.error, most_samples(world, options));
    if (!plan.restore(in)) return false;
  }
  return in.done();
}

Replay replay(const CompiledScene& world, const RenderOptions& options, int x, int y, std::uint64_t sample) {
  const CameraRays camera(world);
  const PathSettings settings = path_settings(world, options);
  Worker worker(world, camera, settings);
  worker.thread.skips_empty = options.skip_empty;
  Replay out;
  const CameraSample camera_sample{x, y, sample};
  PathOutputs outputs{std::span(&out.radiance, 1)};
  outputs.trace = &out.trace;
  const bool whole = worker.tracer.trace(std::span(&camera_sample, 1), outputs, worker.thread);
  CHECK(whole);
  return out;
}

}  // namespace tyndall::render
